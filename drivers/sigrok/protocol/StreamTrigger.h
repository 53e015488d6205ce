// StreamTrigger.h - makes an oscilloscope of a streaming device: keeps the newest samples and cuts out a record at each
// crossing of the trigger level, or when a record is forced without a trigger.
//
// Records do not overlap. Keeps only as many samples as the largest record plus one packet needs.
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

    /// Adds samples of a channel (index as in Wiring) that came at `now_s`. Ignores channels not in use.
    void add(std::size_t channel, std::span<const float> samples, double resolution, double now_s);
    /// Asks for one record without a trigger, as soon as enough samples are there; if a trigger comes first, the record
    /// is a triggered one instead.
    void force() noexcept { forced_ = true; }
    /// Returns the next complete record, if there is one. Errors: as cut().
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
    std::optional<double> beginning_s_;  // when the stream's first sample was taken: the earliest estimate so far
    std::size_t searched_ = 0;           // samples before this index contain no trigger
    std::size_t free_ = 0;               // the next record begins here at the earliest, as records must not overlap
    double lastEnd_s_ = 0;               // when the previous record ended
    bool forced_ = false;
};

}  // namespace tacto::sigrok_driver
