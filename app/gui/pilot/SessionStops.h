// SessionStops.h - what a press of STOP is in a session of a person: a stop, the test of one, or one that is heard
// again. StopKeys hears one press several times, and a contact bounces.
//
// Thread-safety: any thread.
#pragma once

#include <atomic>
#include <optional>

#include "app/gui/controller/BenchController.h"
#include "app/gui/pilot/ParticipantDesk.h"

namespace tacto::gui {

struct HeardStop {
    bool heard = false;   ///< by a session
    bool tested = false;  ///< their STOP, or the operator's: no stop of the session
};

class SessionStops {
public:
    /// Both outlive it.
    SessionStops(ParticipantDesk& desk, BenchController& controller) : desk_(desk), controller_(controller) {}

    void begin();
    /// Switches off and says what it was; nothing where one press is heard again.
    [[nodiscard]] std::optional<HeardStop> participantPressed(const char* by);
    /// Not the one before, heard again. Nothing can be on again so soon: that takes their "go on".
    [[nodiscard]] bool isAnotherPress(const char* by);
    /// By then a press is over; what is repainted after it may have taken longer than it does.
    void shown() { stoppedAt_ = std::chrono::steady_clock::now(); }
    /// Whether a stop from elsewhere, the operator's, is the test of one: then the output is off, and that is all.
    [[nodiscard]] bool isTested(const char* by);
    /// The operator answered: a key that is still held by now stops what comes next.
    void answered() { heldTested_ = false; }

private:
    ParticipantDesk& desk_;
    BenchController& controller_;
    std::atomic<SteadyTime> stoppedAt_{};  ///< by the participant
    std::atomic<SteadyTime> testedAt_{};   ///< the operator's STOP
    std::atomic<bool> heldTested_{false};  ///< by a key of theirs that may be held still
};

}  // namespace tacto::gui
