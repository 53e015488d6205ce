// PresentationRun.h - the presentation that the control loop carries out: when it begins, what is due next, what was
// delivered, and how it ended. The loop has every train judged and posts it, and hands over the reports.
//
//   waiting (for `notBefore`, and for a check pulse where the reading of |Z| would be too old by the first onset)
//   → trains at their onsets → the time that is left → complete; anything else ends it before.
//
// Thread-safety: expect(), result() and beganAt() any thread; the rest has one caller, the control loop. Allocates at
// the end of a presentation alone.
#pragma once

#include <mutex>
#include <optional>
#include <string_view>
#include <variant>

#include "core/bench/delivery/Presentation.h"
#include "core/bench/delivery/TrainPlanner.h"
#include "core/bench/delivery/TrainReport.h"
#include "core/safety/Interlock.h"

namespace tacto {

/// A vibration of a presentation.
struct PlannedVibration {
    ApprovedBurst approved;
    Instant onset;
    Seconds interval;
};
using PlannedStimulus = std::variant<PlannedLevel, PlannedVibration>;

class PresentationRun {
public:
    /// The check pulse comes at most that long before the first onset (choice).
    static constexpr Instant kCheckAhead = std::chrono::seconds(1);

    /// What the loop sees when it asks what to do.
    struct Sight {
        Instant now{0};
        InterlockState state = InterlockState::Armed;
        std::string_view reason{};            ///< the interlock's reason
        bool stopped = false;                 ///< a stop has come since the order
        bool paused = false;                  ///< a pause has come since the presentation was asked for
        bool idle = true;                     ///< no train is being written or read
        std::optional<Instant> readingUntil;  ///< when the reading of |Z| grows old; nothing where none is taken
    };
    enum class Due { Nothing, Check, Train };

    /// Another presentation is asked for, which has no result yet.
    void expect();
    /// Nothing while it is going on. Taken once.
    [[nodiscard]] std::optional<Presented> result();
    /// When the trains of the last presentation asked for begin to pass, even if all are empty; known a moment before.
    /// Nothing while it waits.
    [[nodiscard]] std::optional<Instant> beganAt();

    /// `presentation` has passed validate(). `planner` says how its times are kept, for now.
    void begin(Presentation presentation, const TrainPlanner& planner);
    [[nodiscard]] bool active() const noexcept { return what_.has_value(); }
    /// The next step. Begins and completes the presentation when it is time.
    [[nodiscard]] Due next(const Sight& sight) noexcept;
    /// Whether its trains have begun to pass, even if all are empty.
    [[nodiscard]] bool begun() const noexcept { return began_.has_value(); }
    /// Has the train judged that is due: next() said Train. A refusal ends the presentation. Errors: as
    /// TrainPlanner::planLevel() and SafetyGate::approve().
    [[nodiscard]] Result<PlannedStimulus> plan(TrainPlanner& planner, SafetyGate& gate, Instant now);
    /// The train was handed over.
    void posted() noexcept {
        ++next_;
        ++awaited_;
    }
    /// Takes the outcome of a train or of a check pulse.
    void read(const TrainReport& report) noexcept;
    /// Ends it. `reason`: one sentence. Does nothing when none is active.
    void end(Instant now, PresentationEnd end, std::string_view reason) noexcept;

private:
    struct Timed {
        std::vector<StimulusLevel> levels;  // each train's level; empty in an empty presentation
        Seconds interval;                   // the interval that was asked for
        std::vector<Instant> onsets;        // onsets from the beginning, to be kept
        Instant duration, notBefore;
    };
    [[nodiscard]] Instant onset() const noexcept { return *began_ + what_->onsets[next_]; }
    void endIfHindered(const Sight& sight) noexcept;
    [[nodiscard]] Due beforeBegin(const Sight& sight) noexcept;

    std::optional<Timed> what_;
    std::optional<Instant> began_;
    std::size_t next_ = 0;
    std::size_t awaited_ = 0;  // posted trains whose report has not come
    bool lost_ = false;        // a train was taken back before it was written
    Presented made_;

    std::mutex mutex_;
    std::optional<Presented> result_;  // guarded by mutex_
    std::optional<Instant> beganAt_;   // guarded by mutex_
};

}  // namespace tacto
