// Standstill.h - whether the values of a stream stand still although its stamps go on: a sensor that hangs, behind
// electronics that repeat the last it said, or the last of its blocks over and over (hazard H7).
//
// How often a value repeats to the last bit by itself, from noise and coarse steps, is learnt from the stream: it
// stands still once so many repeats in a row would come by chance once in 10^9 times, and for longer than samples may
// be old. A value that moves more often than not cannot repeat with a period of several samples either, nor can one
// axis stand still while others move.
//
// Thread-safety: none; one owner. Does not allocate after construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/Stream.h"

namespace tacto {

class Standstill {
public:
    /// The longest block, in samples, whose repetition is found.
    static constexpr std::size_t kPeriods = 64;

    /// `eachChannel`: repeatsSince() is about each channel by itself, else about all of them at once.
    explicit Standstill(std::size_t channels, bool eachChannel = false);

    /// All samples of `block`, in order.
    void feed(const SampleBlock& block) noexcept;
    /// The stamp since which nothing has changed in any channel; nothing while it may be chance.
    [[nodiscard]] std::optional<double> since() const noexcept;
    /// The stamp since which a channel that moves by itself stands still or repeats the same values.
    [[nodiscard]] std::optional<double> repeatsSince() const noexcept;

private:
    /// One channel, or all at once, beside itself some samples before.
    struct Repeats {
        double since_s = 0;                       // of the last that was another, while it goes on
        std::uint64_t run = 0;                    // goes on
        std::uint64_t matched = 0, repeated = 0;  // before it: all, and those that its noise may have made
    };
    void compare(const double* values) noexcept;
    void count(Repeats& one, std::size_t period, bool same) const noexcept;
    [[nodiscard]] std::uint64_t changes(const Repeats& one, std::size_t period) const noexcept;
    [[nodiscard]] bool moves(const Repeats& one, std::size_t period) const noexcept;
    [[nodiscard]] bool stands(const Repeats& one, std::size_t period) const noexcept;

    const std::size_t channels_;
    const bool eachChannel_;
    std::vector<std::uint64_t> before_;  // the bits of the last kPeriods samples, a ring
    std::uint64_t seen_ = 0;             // samples before this one
    std::vector<Repeats> all_;           // by period - 1
    std::vector<Repeats> each_;          // by period - 1, then by channel; empty unless eachChannel_
    double newest_s_ = 0, last_s_ = 0;   // of this sample and the one before
};

}  // namespace tacto
