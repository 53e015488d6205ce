// PresentationRun.h - the presentation that the control loop carries out: when it begins, what is due next, what was
// delivered, and how it ended. The loop has every train judged, posts it, and hands over the reports.
//
//   waiting (for `notBefore`, and for a check pulse if the reading of |Z| would be too old by the first onset)
//   → trains at their onsets → the remaining time → complete; any hindrance ends the presentation early.
//
// Thread-safety: expect(), result() and beganAt() any thread; the rest has one caller, the control loop. Allocates only
// at the end of a presentation.
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

/// A planned vibration in a presentation.
struct PlannedVibration {
    ApprovedBurst approved;
    Instant onset;
    Seconds interval;
};
using PlannedStimulus = std::variant<PlannedLevel, PlannedVibration>;

class PresentationRun {
public:
    /// The check pulse comes at most this long before the beginning (choice).
    static constexpr Instant kCheckAhead = std::chrono::seconds(1);

    /// The state that the loop passes to next().
    struct Sight {
        Instant now{0};
        InterlockState state = InterlockState::Armed;
        std::string_view reason{};            ///< the reason that the interlock gives
        bool stopped = false;                 ///< a stop has come since the order
        bool paused = false;                  ///< a pause has come since the presentation was requested
        bool idle = true;                     ///< no train is being written or read
        std::optional<Instant> readingUntil;  ///< when the reading of |Z| becomes too old; nothing if none is taken
    };
    enum class Due { Nothing, Check, Train };

    /// Announces a new presentation, which has no result yet.
    void expect();
    /// Returns nothing while the presentation continues. Can be taken once.
    [[nodiscard]] std::optional<Presented> result();
    /// Returns when the trains of the last requested presentation begin to pass, even if all are empty; known shortly
    /// before. Returns nothing while it waits.
    [[nodiscard]] std::optional<Instant> beganAt();

    /// `presentation` has passed validate(). `planner`, used only in this call, corrects its times.
    void begin(Presentation presentation, const TrainPlanner& planner);
    [[nodiscard]] bool active() const noexcept { return what_.has_value(); }
    /// Returns what is due now. Begins and completes the presentation in time.
    [[nodiscard]] Due next(const Sight& sight) noexcept;
    /// True once the onsets of the presentation have begun to pass, even if all trains are empty.
    [[nodiscard]] bool begun() const noexcept { return began_.has_value(); }
    /// Has the due train judged; call it after next() returned Train. A refusal ends the presentation. Errors: as
    /// TrainPlanner::planLevel() and SafetyGate::approve().
    [[nodiscard]] Result<PlannedStimulus> plan(TrainPlanner& planner, SafetyGate& gate, Instant now);
    /// Notes that the train was handed over.
    void posted() noexcept {
        ++next_;
        ++awaited_;
    }
    /// Takes the report on a train or a check pulse.
    void read(const TrainReport& report) noexcept;
    /// Ends the presentation. `reason`: one sentence. Does nothing if none is active.
    void end(Instant now, PresentationEnd end, std::string_view reason) noexcept;

private:
    struct Timed {
        std::vector<StimulusLevel> levels;  // level of each train; all 0 in an empty presentation
        Seconds interval;                   // the interval as requested
        std::vector<Instant> onsets;        // times from the beginning, corrected by the calibration
        Instant duration, notBefore;
    };
    [[nodiscard]] Instant onset() const noexcept { return *began_ + what_->onsets[next_]; }
    void endIfHindered(const Sight& sight) noexcept;
    [[nodiscard]] Due beforeBegin(const Sight& sight) noexcept;

    std::optional<Timed> what_;
    std::optional<Instant> began_;
    std::size_t next_ = 0;
    std::size_t awaited_ = 0;  // posted trains that were not reported yet
    bool lost_ = false;        // true if a train was taken back before it was written
    Presented made_;

    std::mutex mutex_;
    std::optional<Presented> result_;  // guarded by mutex_
    std::optional<Instant> beganAt_;   // guarded by mutex_
};

}  // namespace tacto
