// TrainScheduler.h - when the next train is due.
//
// Trains follow each other by the onset-to-onset interval T. When T shrinks, the pending train is pulled forward to
// max(now, last onset + T), so that a press is felt at once; when T grows it moves back. No train is ever due
// earlier than the last onset plus T.
//
// Thread-safety: none; the control loop owns it. Never allocates.
#pragma once

#include <optional>

#include "core/base/Units.h"

namespace tacto {

class TrainScheduler {
public:
    /// Output begins: the first train is due at `now` (later if the last onset was less than an interval ago). An
    /// interval outside 0 < T ≤ 1e6 s is ignored here and below.
    void start(Instant now, Seconds interval) noexcept;

    /// T changed. Moves the pending train; before start() it does nothing.
    void setInterval(Seconds interval, Instant now) noexcept;

    /// No train is due until resume() or start().
    void pause() noexcept;
    /// The pending train is due at max(now, last onset + T). Does nothing unless paused.
    void resume(Instant now) noexcept;
    /// No train is due until start(). The last onset is remembered.
    void off() noexcept;

    /// When the next train is due; nothing while off or paused.
    [[nodiscard]] std::optional<Instant> due() const noexcept;
    [[nodiscard]] bool isDue(Instant now) const noexcept;

    /// A train began, or was refused and skipped, at `onset`: the next is due an interval later. Pass the moment it was
    /// due if it went out in time, or the loop's steps add up to a drift.
    void trainAt(Instant onset) noexcept;

    [[nodiscard]] std::optional<Instant> lastOnset() const noexcept { return last_; }
    [[nodiscard]] Seconds interval() const noexcept { return interval_; }

private:
    enum class Mode { Off, Paused, Running };
    void reschedule(Instant notBefore) noexcept;

    Mode mode_ = Mode::Off;
    Seconds interval_{0};
    std::optional<Instant> last_;
    Instant due_{0};
};

}  // namespace tacto
