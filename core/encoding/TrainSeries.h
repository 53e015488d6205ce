// TrainSeries.h - successive trains on their way to what is wanted: the command of the next one, and when it is due.
//
// The one mechanism of the live loop (core/bench/TrainPlanner), of the computed sweep (Transitions) and of the designed
// step (StepResponse). A train is limited against the train before it as it was delivered: a train that came later than
// its interval, because the finger pressed when more than the new interval had already passed, was felt at the interval
// that passed. A silence of more than twice the longest interval ends the series (choice): nothing is left to compare
// the next train with, and it starts over at what is wanted. Limits are the profile's, 0 = none.
//
// Thread-safety: none; its owner's thread. Never allocates.
#pragma once

#include <optional>

#include "core/base/Units.h"
#include "core/encoding/Encoder.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto {

// When the next train is due.
//
// Trains follow each other by the onset-to-onset interval T. When T shrinks, the pending train is pulled forward to
// max(now, last onset + T), so that a press is felt at once; when T grows it moves back. No train is ever due
// earlier than the last onset plus T.

class TrainScheduler {
public:
    /// Output begins: the first train is due at `now` (later if the last onset was less than an interval ago). An
    /// interval outside 0 < T ≤ 1e6 s is ignored here and below.
    void start(Instant now, Seconds interval) noexcept;

    /// T changed. Moves the pending train; before start() it does nothing.
    void setInterval(Seconds interval, Instant now) noexcept;

    /// No train is due until start(). The last onset is remembered.
    void off() noexcept { running_ = false; }

    /// When the next train is due; nothing while off.
    [[nodiscard]] std::optional<Instant> due() const noexcept { return running_ ? std::optional(due_) : std::nullopt; }

    /// A train began, or was refused and skipped, at `onset`: the next is due an interval later. Pass the moment it was
    /// due if it went out in time, or the loop's steps add up to a drift.
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
    /// `profile` has passed validate(). With a `calibration` the schedule keeps the intervals that make the stimulator
    /// deliver the commands'.
    explicit TrainSeries(const EncodingProfile& profile, const KnownLines& calibration = {});

    [[nodiscard]] const Encoder& encoder() const noexcept { return encoder_; }

    /// What is wanted from `now` on. Moves the pending train, or starts the series.
    void want(const Command& wanted, Instant now) noexcept;
    /// Wants no train until the next want(). The last train is remembered: the next one steps up from it within the
    /// limits, and down at once, so that nothing begins stronger or more often than it is wanted (hazard H6).
    void wantNothing() noexcept;

    /// When the next train is due; nothing while none is wanted.
    [[nodiscard]] std::optional<Instant> due() const noexcept { return scheduler_.due(); }
    /// The command of the next train; nothing while none is wanted.
    [[nodiscard]] const std::optional<Command>& command() const noexcept { return command_; }

    /// The command of the train that begins at `onset`, wanted before. The next is due an interval later, whether this
    /// one is delivered or not.
    [[nodiscard]] Command begin(Instant onset) noexcept;
    /// The train that begin() began goes out: the next is limited against it. Not called for a train that was refused.
    void delivered() noexcept;
    /// The last train that went out, with the interval that it was felt at.
    [[nodiscard]] std::optional<Command> last() const noexcept {
        return last_ ? std::optional(last_->command) : std::nullopt;
    }

private:
    [[nodiscard]] bool goesOn(Instant onset) const noexcept;
    [[nodiscard]] Command limited(Instant onset) const noexcept;

    const Encoder encoder_;
    const KnownLines calibration_;
    TrainScheduler scheduler_;
    std::optional<Command> wanted_;
    std::optional<Command> command_;  // wanted_ under the limits
    struct Train {
        Command command;
        Instant onset{0};
    };
    std::optional<Train> last_;   // delivered; its interval is the one that was felt
    std::optional<Train> begun_;  // by begin()
    bool startsAgain_ = false;    // nothing has been wanted since the last train
};

}  // namespace tacto
