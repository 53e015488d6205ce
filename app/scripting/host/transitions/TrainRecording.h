// TrainRecording.h - one oscilloscope record of every train, taken and measured while the bench runs.
//
// Thread-safety: as Bench; use on the script's thread.
#pragma once

#include <algorithm>
#include <vector>

#include "core/bench/Bench.h"
#include "core/encoding/Encoder.h"

namespace tacto::host::transitions {

/// A train as measured by the oscilloscope. NaN: the record could not be measured.
struct SeenTrain {
    double onset_s = 0;
    double onsetUncertainty_s = 0;  ///< standard, against onsets in other records; NaN: unknown
    double amplitude_v = 0;
    double amplitudeUncertainty_v = 0;  ///< standard, without errors that all trains share; NaN: unknown
    Capture capture;
};

/// Returns settings for short records in one range for both commands: their errors are then the same.
[[nodiscard]] ScopeSettings trainSettings(Bench& bench, double rate_hz, const Command& a, const Command& b);

/// Records from begin() until it is destroyed.
class TrainRecording {
public:
    TrainRecording(Bench& bench, const ScopeSettings& settings) : bench_(bench), settings_(settings) {}
    ~TrainRecording() { bench_.cancelCaptures(); }
    TrainRecording(const TrainRecording&) = delete;
    TrainRecording& operator=(const TrainRecording&) = delete;

    /// Errors of the functions below: of the oscilloscope, and of a stopped run.
    [[nodiscard]] Result<void> begin();
    /// Adds the records that have come since to seen().
    [[nodiscard]] Result<void> take();
    /// Takes records until `enough()`, or returns false after `limit`.
    template <class Enough>
    [[nodiscard]] Result<bool> watch(Seconds limit, const Enough& enough);

    [[nodiscard]] std::vector<SeenTrain>& seen() noexcept { return seen_; }

    /// How often the bench is polled.
    static constexpr Seconds kPollInterval{0.02};

private:
    Bench& bench_;
    const ScopeSettings settings_;
    std::size_t left_ = 0;  // records that were requested and are still to come
    std::vector<SeenTrain> seen_;
};

/// Lets trains run until the encoder's command is `wanted`, despite limits on a step, and a train with it has gone out.
/// Errors: Timeout, naming `function`, if that takes an hour.
[[nodiscard]] Result<void> settleAt(Bench& bench, const Command& wanted, std::string_view function);

template <class Enough>
Result<bool> TrainRecording::watch(Seconds limit, const Enough& enough) {
    const Instant until = bench_.clock().now() + toInstant(limit);
    for (;;) {
        if (auto taken = take(); !taken) return failure(taken);
        if (enough()) return true;
        const Instant now = bench_.clock().now();
        if (now >= until) return false;
        if (auto waited = bench_.wait(Seconds(std::min(toInstant(kPollInterval), until - now))); !waited)
            return failure(waited);
    }
}

}  // namespace tacto::host::transitions
