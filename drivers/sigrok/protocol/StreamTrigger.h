// StreamTrigger.h - makes a streaming device an oscilloscope: holds the newest stretch of its samples and cuts a record
// out of it at each crossing of the trigger level, or where one is asked for without a trigger.
//
// Records do not overlap. Only as much is held as the largest record plus one packet needs.
//
// Thread-safety: the instrument's thread.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/sigrok/protocol/RawRecord.h"

namespace tacto::sigrok_driver {

class StreamTrigger {
public:
    StreamTrigger(const RecordPlan& plan, const Wiring& wiring) : plan_(plan), wiring_(wiring) {}

    /// More samples of a channel (index as in Wiring), which came at `now_s`. Other channels are passed over.
    void add(std::size_t channel, std::span<const float> samples, double resolution, double now_s);
    /// Asks for one record without a trigger, as soon as it is complete; a trigger that comes before makes a triggered
    /// one instead.
    void force() noexcept { forced_ = true; }
    /// The next record that is complete. Errors: as cut().
    [[nodiscard]] Result<std::optional<Capture>> next();

private:
    [[nodiscard]] std::size_t ready() const noexcept;
    [[nodiscard]] Result<Capture> cutAt(double at, bool untriggered);
    void dropTo(std::size_t index);

    const RecordPlan plan_;
    const Wiring wiring_;
    std::vector<float> voltage_, current_;
    double resolution_ = 0;
    std::uint64_t dropped_ = 0;          // samples before voltage_[0] since the stream began
    std::optional<double> beginning_s_;  // when the stream's first sample was taken, at the earliest by any packet
    std::size_t searched_ = 0;           // up to here no trigger begins
    std::size_t free_ = 0;               // records begin here at the earliest: none overlaps the one before
    double lastEnd_s_ = 0;               // when the record before ended
    bool forced_ = false;
};

}  // namespace tacto::sigrok_driver
