// TrainSeries.h - plans successive trains toward the wanted command: the next train's command, and when it is due.
//
// Used by the live loop (core/bench/TrainPlanner), the computed sweep (Transitions) and the designed step
// (StepResponse). A train is limited relative to the previous train as delivered. If the finger pressed after the new
// interval had already passed, the train came later than its interval and was felt at the time that passed. A silence
// of more than twice the longest interval ends the series (choice), because no train is left for comparison; the next
// train starts at the wanted command. The limits come from the profile; 0 = none.
//
// Thread-safety: none; use only in the owner's thread. Never allocates.
#pragma once

#include <optional>

#include "core/base/Units.h"
#include "core/encoding/Encoder.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto {

// Decides when the next train is due.
//
// Trains follow each other at the onset-to-onset interval T. If T shrinks, the pending train moves forward to max(now,
// last onset + T), so that a press is felt at once. If T grows, the train moves back. No train is due earlier than the
// last onset plus T.

class TrainScheduler {
public:
    /// Starts the output: the first train is due at `now`, or later if the last onset was less than an interval ago.
    /// Here and below, an interval outside 0 < T ≤ 1e6 s is ignored.
    void start(Instant now, Seconds interval) noexcept;

    /// Changes T and moves the pending train. Before start() it has no effect.
    void setInterval(Seconds interval, Instant now) noexcept;

    /// Stops: no train is due until start(). The last onset is kept.
    void off() noexcept { running_ = false; }

    /// Time at which the next train is due; empty while off.
    [[nodiscard]] std::optional<Instant> due() const noexcept { return running_ ? std::optional(due_) : std::nullopt; }

    /// Reports that a train began at `onset`, or was refused and skipped; the next is due one interval later. If the
    /// train was in time, pass its due time, because otherwise the loop's delays add up.
    void trainAt(Instant onset) noexcept;

private:
    void reschedule(Instant notBefore) noexcept;

    bool running_ = false;
    Seconds interval_{0};
    std::optional<Instant> last_;
    Instant due_{0};
};

class TrainSeries {
public:
    /// `profile` must have passed validate(). With a `calibration` the schedule uses the intervals at which the
    /// stimulator delivers the commanded ones.
    explicit TrainSeries(const EncodingProfile& profile, const KnownLines& calibration = {});

    [[nodiscard]] const Encoder& encoder() const noexcept { return encoder_; }

    /// Sets the wanted command from `now` on. Moves the pending train, or starts the series.
    void want(const Command& wanted, Instant now) noexcept;
    /// Stops trains until the next want(). The last train is kept: the next train rises from it within the limits but
    /// falls at once, so that nothing begins stronger or faster than wanted (hazard H6).
    void wantNothing() noexcept;

    /// Time at which the next train is due; empty while no train is wanted.
    [[nodiscard]] std::optional<Instant> due() const noexcept { return scheduler_.due(); }
    /// The command of the next train; empty while no train is wanted.
    [[nodiscard]] const std::optional<Command>& command() const noexcept { return command_; }

    /// Begins a train of another encoder, which also says when: nothing is due by itself. False, and nothing begins,
    /// where it is stronger or sooner after the last delivered train than the profile permits (hazard H6), within
    /// 0.1 % and 2 ms for clocks and single precision. It may be weaker or later at once.
    [[nodiscard]] bool follow(const Command& made, Instant onset) noexcept;
    /// Returns the command of the train that begins at `onset`; want() must come before. The next train is due one
    /// interval later, whether or not this one is delivered.
    [[nodiscard]] Command begin(Instant onset) noexcept;
    /// Reports that the begun train was delivered; it limits the next one. Not called for a refused train.
    void delivered() noexcept;
    /// The last delivered train, with the interval at which it was felt.
    [[nodiscard]] std::optional<Command> last() const noexcept {
        return last_ ? std::optional(last_->command) : std::nullopt;
    }

private:
    [[nodiscard]] bool goesOn(Instant onset) const noexcept;
    [[nodiscard]] Command limited(Instant onset) const noexcept;
    void begun(const Command& command, Instant onset) noexcept;

    const Encoder encoder_;
    const KnownLines calibration_;
    TrainScheduler scheduler_;
    std::optional<Command> wanted_;
    std::optional<Command> command_;  // wanted_ within the limits
    struct Train {
        Command command;
        Instant onset{0};
    };
    std::optional<Train> last_;   // delivered; its interval is as felt
    std::optional<Train> begun_;  // by begin(), not yet delivered
    bool startsAgain_ = false;    // true if wantNothing() was called after the last train
};

}  // namespace tacto
