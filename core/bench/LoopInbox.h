// LoopInbox.h - settings from other threads for the control loop: the newest of each kind is used in the next step.
//
// Thread-safety: take() is called only by the control loop and never waits; the rest any thread.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "core/bench/Telemetry.h"
#include "core/bench/arming/ArmingSequence.h"
#include "core/bench/delivery/Presentation.h"
#include "core/bench/delivery/TrainPlanner.h"
#include "core/bench/sensing/CaptureLoad.h"
#include "core/bench/sensing/FingerInput.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

/// What R was used for before the next profile takes over.
enum class RBefore {
    Shown,     ///< R was shown: allowed, but the session is marked as not calibrated
    Measuring  ///< R was not shown: only references and scales for the new profile were measured
};

struct NextFinger {
    std::unique_ptr<FingerInput> finger;  ///< never null
    RBefore before = RBefore::Shown;
};

class LoopInbox {
public:
    struct Settings {
        std::optional<Presentation> presentation;
        std::optional<ArmCommand> arm;
        std::optional<DriveCommand> drive;
        std::optional<NextFinger> finger;
        std::unique_ptr<TrainPlanner> planner;
        std::optional<Result<Ohms>> confirmed;
        std::optional<SeenLoad> load;
        std::optional<SeenAmplitude> amplitude;
        std::optional<SeenAmplitude> unasked;  ///< seen in the output, although no command asked for it
    };

    void arm(ArmCommand command);
    void drive(const DriveCommand& command);
    void present(Presentation presentation);
    /// If two arrive in one step, the first is dropped, but its `before` still counts.
    void finger(NextFinger next);
    void planner(std::unique_ptr<TrainPlanner> next);
    void confirm(const Result<Ohms>& seen);
    void load(const SeenLoad& seen);
    /// If several arrive in one step, the one furthest from its command wins; without a command, the largest.
    void amplitude(const SeenAmplitude& seen);

    /// Returns all settings since the last call. Returns nothing if there are none, or while another thread hands one
    /// in: the next step then gets it.
    [[nodiscard]] std::optional<Settings> take() noexcept;
    /// Returns the finger alone, for use when no step runs any more; waits for a thread that is handing something in.
    [[nodiscard]] std::optional<NextFinger> takeFinger() noexcept;

private:
    template <class Put>
    void put(Put into);

    std::mutex mutex_;  // held to move a setting in or out
    Settings settings_;
    std::atomic<bool> full_{false};
};

// Carries a participant's statements about levels from the bench's caller to the gate, which only the control loop may
// call, and carries the answers back.

struct LevelRequest {
    enum class What { Accept, Discomfort, BeginAscending, EndAscending, Ceiling };
    What what = What::Ceiling;
    PulseTrain train;                    ///< the study's kind of train (accept: at that level); unused for a massager
    StimulusLevel level = Milliamps(0);  ///< the level that was accepted or uncomfortable; an intensity for a massager
};

class LevelRequests {
public:
    void ask(const LevelRequest& request);
    /// Returns nothing until served, then the ceiling that now holds or the reason for refusal. Can be taken once.
    [[nodiscard]] std::optional<Result<StimulusLevel>> answer();

    void serve(SafetyGate& gate) noexcept;

private:
    std::mutex mutex_;  // guards request_ and answer_; held at most for one call of the gate
    std::optional<LevelRequest> request_;
    std::optional<Result<StimulusLevel>> answer_;
    std::atomic<bool> asked_{false};
};

}  // namespace tacto
