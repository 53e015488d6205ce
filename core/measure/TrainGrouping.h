// TrainGrouping.h - which pulses form a train, and the trains' means. Private to core/measure.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/measure/PulseMeasurement.h"

namespace tacto {

class TrainGrouping {
public:
    /// Pulses whose onsets are at most `gap` apart form one train. `breaks`, ascending: pulses before which an unknown
    /// time has passed; must outlive this. `pulses`: how many will be added.
    TrainGrouping(double gap, std::span<const std::size_t> breaks, std::size_t pulses);

    /// The next pulse in time.
    void add(const PulseMeasurement& pulse);
    /// No pulse follows. To be called once, after the last.
    [[nodiscard]] std::vector<TrainMeasurement> finish();

private:
    void begin(const PulseMeasurement& pulse, bool afterBreak);
    void end();

    double gap_;
    std::span<const std::size_t> breaks_;  ///< those still to come
    std::size_t added_ = 0;
    double lastOnset_s_ = 0;
    std::vector<TrainMeasurement> trains_;  ///< the last one holds sums until it ends
};

}  // namespace tacto
