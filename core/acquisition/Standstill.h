// Standstill.h - whether the values of a stream stand still although its stamps go on: a sensor that hangs, behind
// electronics that repeat the last it said (hazard H7).
//
// How often a value repeats to the last bit by itself, from noise and coarse steps, is learnt from the stream: it
// stands still once so many repeats in a row would come by chance once in 10^9 times, and for longer than samples may
// be old.
//
// Thread-safety: none; one owner. Does not allocate after construction.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/NaN.h"
#include "core/base/Stream.h"

namespace tacto {

class Standstill {
public:
    explicit Standstill(std::size_t channels) : last_(channels, kNaN) {}

    /// All samples of `block`, in order.
    void feed(const SampleBlock& block) noexcept;
    /// The stamp since which nothing has changed in any channel; nothing while it may be chance.
    [[nodiscard]] std::optional<double> since() const noexcept;

private:
    std::vector<double> last_;
    double since_s_ = 0, newest_s_ = 0;
    std::size_t repeats_ = 0;                 // of the run that goes on
    std::size_t repeated_ = 0, changed_ = 0;  // before it
};

}  // namespace tacto
