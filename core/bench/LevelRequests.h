// LevelRequests.h - what a participant says about levels, on its way from the bench's caller to the gate, which has the
// control loop for its only caller, and back.
//
// Thread-safety: ask() and answer() have one caller, the bench's; serve() has one, the control loop, which never waits.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>

#include "core/bench/delivery/Presentation.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

struct LevelRequest {
    enum class What { Accept, Discomfort, BeginAscending, EndAscending, Ceiling };
    What what = What::Ceiling;
    PulseTrain train;                    ///< of the study's kind: the level to accept, else any; none of a massager
    StimulusLevel level = Milliamps(0);  ///< that was accepted or uncomfortable; an intensity is a massager's
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
