// TrainRecording.h - one oscilloscope record of every train, taken and measured while the bench runs.
//
// Thread-safety: as Bench; the script's thread.
#pragma once

#include <algorithm>
#include <vector>

#include "core/bench/Bench.h"
#include "core/encoding/Encoder.h"

namespace tacto::host::transitions {

/// A train as measured by the oscilloscope. NaN where the record could not be measured.
struct SeenTrain {
    double onset_s = 0;
    double onsetUncertainty_s = 0;  ///< standard, against the onsets of other records; NaN = unknown
    double amplitude_v = 0;
    double amplitudeUncertainty_v = 0;  ///< standard, but for what all trains share; NaN = unknown
    Capture capture;
};

/// Short records in one range for both commands: errors are then the same for both.
[[nodiscard]] ScopeSettings trainSettings(Bench& bench, double rate_hz, const Command& a, const Command& b);

/// Records from begin() to the end of its life.
class TrainRecording {
public:
    TrainRecording(Bench& bench, const ScopeSettings& settings) : bench_(bench), settings_(settings) {}
    ~TrainRecording() { bench_.cancelCaptures(); }
    TrainRecording(const TrainRecording&) = delete;
    TrainRecording& operator=(const TrainRecording&) = delete;

    /// Errors here and below: of the oscilloscope, and of a run that was stopped.
    [[nodiscard]] Result<void> begin();
    /// Adds what has come since to seen().
    [[nodiscard]] Result<void> take();
    /// Takes until `enough()` or `limit` has passed. False then.
    template <class Enough>
    [[nodiscard]] Result<bool> watch(Seconds limit, const Enough& enough);

    [[nodiscard]] std::vector<SeenTrain>& seen() noexcept { return seen_; }

    /// How often the bench is looked at.
    static constexpr Seconds kPollInterval{0.02};

private:
    Bench& bench_;
    const ScopeSettings settings_;
    std::size_t left_ = 0;  // records that were asked for and are still to come
    std::vector<SeenTrain> seen_;
};

/// Lets trains run until the encoder's command is `wanted`, limits on a step and all, and a train with it has gone out.
/// Errors: Timeout, named after `function`, when that takes an hour.
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
