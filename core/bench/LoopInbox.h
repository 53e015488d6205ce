// LoopInbox.h - what other threads hand to the control loop: the newest of each kind takes effect in the next step.
//
// Thread-safety: take() has one caller, the control loop, which never waits; the rest any thread.
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

/// The meaning that R had before another profile takes over.
enum class RBefore {
    Shown,     ///< allowed: the session is marked as not calibrated
    Measuring  ///< allowed only for measuring the references and scales of the new profile
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
        std::optional<SeenAmplitude> unasked;  ///< seen, though no command asked for it
    };

    void arm(ArmCommand command);
    void drive(const DriveCommand& command);
    void present(Presentation presentation);
    /// If two arrive in one step, the first is dropped; the R before it counts.
    void finger(NextFinger next);
    void planner(std::unique_ptr<TrainPlanner> next);
    void confirm(const Result<Ohms>& seen);
    void load(const SeenLoad& seen);
    /// If several arrive in one step, the one furthest off counts; of those of no one command the largest.
    void amplitude(const SeenAmplitude& seen);

    /// All that came since the last call. Nothing when there is nothing, or while another thread hands something in:
    /// that is there in the next step.
    [[nodiscard]] std::optional<Settings> take() noexcept;
    /// The finger alone, for when no step runs any more; waits for a thread that hands something in.
    [[nodiscard]] std::optional<NextFinger> takeFinger() noexcept;

private:
    template <class Put>
    void put(Put into);

    std::mutex mutex_;  // held to move a setting in or out
    Settings settings_;
    std::atomic<bool> full_{false};
};

// Carries a participant's word on levels from the bench's caller to the gate, which has the control loop for its only
// caller, and back.

struct LevelRequest {
    enum class What { Accept, Discomfort, BeginAscending, EndAscending, Ceiling };
    What what = What::Ceiling;
    PulseTrain train;                    ///< the study's kind of train: the level to accept, or any; none of a massager
    StimulusLevel level = Milliamps(0);  ///< the level that was accepted or uncomfortable; an intensity is a massager's
};

class LevelRequests {
public:
    void ask(const LevelRequest& request);
    /// Nothing until it was served; then the ceiling that holds afterwards, or why it was refused. Taken once.
    [[nodiscard]] std::optional<Result<StimulusLevel>> answer();

    void serve(SafetyGate& gate) noexcept;

private:
    std::mutex mutex_;  // guards the two below; held for a call of the gate at most
    std::optional<LevelRequest> request_;
    std::optional<Result<StimulusLevel>> answer_;
    std::atomic<bool> asked_{false};
};

}  // namespace tacto
