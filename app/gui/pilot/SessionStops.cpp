#include "app/gui/pilot/SessionStops.h"

#include <string_view>

namespace tacto::gui {

namespace {

constexpr std::chrono::milliseconds kOnePress{100};

/// An operator who aborts or closes the window, or a screen that goes, has tested no STOP.
bool isPressOfStop(std::string_view by) {
    return by.starts_with("operator (") && by != kOperatorAborts && by != "operator (signal)";
}

}  // namespace

void SessionStops::begin() {
    stoppedAt_ = testedAt_ = SteadyTime();
    heldTested_ = false;
}

bool SessionStops::isAnotherPress(const char* by) {
    auto last = stoppedAt_.load();
    const auto now = std::chrono::steady_clock::now();
    if (now - last >= kOnePress && stoppedAt_.compare_exchange_strong(last, now)) return true;
    if (std::string_view(by) != kParticipantLetGo) desk_.notePressed();
    return false;
}

std::optional<HeardStop> SessionStops::participantPressed(const char* by) {
    if (!isAnotherPress(by)) return {};
    HeardStop stop;
    stop.tested = desk_.testsStopOf(PromptTo::Participant) || desk_.testsStopOf(PromptTo::Operator);
    stop.heard = desk_.stopBy(by);
    if (!stop.heard) controller_.stop(by);  // the session has not begun, or is over
    return stop;
}

bool SessionStops::isTested(const char* by) {
    if (std::string_view(by).ends_with(kStillHeld)) return heldTested_.load();
    if (!isPressOfStop(by)) return false;
    // What the press tested is off already, and a question comes next.
    if (std::chrono::steady_clock::now() - testedAt_.load() < kOnePress) return true;
    // In the test of the participant's it is a press of the wrong one: asked again, and no stop of the session.
    const bool tests = desk_.testsStopOf(PromptTo::Operator) || desk_.testsStopOf(PromptTo::Participant);
    heldTested_ = tests && desk_.stopBy(by);
    if (heldTested_) testedAt_ = std::chrono::steady_clock::now();
    return heldTested_.load();
}

}  // namespace tacto::gui
