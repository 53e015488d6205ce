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

namespace tacto {

/// What R was for before another profile takes over.
enum class RBefore {
    Shown,     ///< that it was not calibrated is a mark of the session
    Measuring  ///< for the references and scales of the new profile alone
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
        std::optional<SeenAmplitude> unasked;  ///< of no one command
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

    /// All that came since the last time. Nothing when there is nothing, and while another thread hands something in:
    /// then it is there in the next step.
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

}  // namespace tacto
