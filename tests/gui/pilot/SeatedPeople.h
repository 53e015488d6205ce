// SeatedPeople.h - a participant's window, with a session behind it that asks what the test wants.
//
// Thread-safety: the GUI thread. ask() asks on another thread, as a session does.
#pragma once

#include <QTest>
#include <functional>
#include <future>
#include <gtest/gtest.h>

#include "app/gui/pilot/ParticipantDesk.h"
#include "app/gui/pilot/ParticipantField.h"
#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/window/StopKeys.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {

inline const std::vector<std::string> kFour{"smooth-high", "rough-high", "smooth-low", "rough-low"};

inline PilotScreen testScreen(ScreenState state, int trial = 27) {
    PilotScreen screen;
    screen.state = state;
    screen.phase = "test";
    screen.block = (trial - 1) / 18 + 1;
    screen.blocks = 5;
    screen.trial = trial;
    screen.trials = 90;
    return screen;
}

class Seated : public testing::Test {
protected:
    Seated() {
        desk.stop = [this](const char* by) {
            if (stops.empty()) stoppedAt = std::chrono::steady_clock::now();
            stops.emplace_back(by);
        };
        desk.begin(nullptr);
        desk.show(testScreen(ScreenState::Rest));
        window.resize(1440, 900);
        window.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&window));
        window.activateWindow();
        window.setFocus();
        EXPECT_IN_TIME(QTest::qWaitForWindowActive(&window));
    }
    ~Seated() override {
        desk.leave();
        if (answer.valid()) answer.wait();
        window.hide();
    }
    /// Asks on another thread, as a session does; returns when the targets are shown.
    void ask(const PilotPrompt& prompt) {
        answer = std::async(std::launch::async, [this, prompt] { return desk.ask(prompt); });
        ASSERT_IN_TIME(comesTrue([this] { return window.asking(); }));
    }
    [[nodiscard]] bool isAnswered() { return answer.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    [[nodiscard]] Result<PilotAnswer> answered() {
        EXPECT_IN_TIME(comesTrue([this] { return isAnswered(); }, 2000));
        return answer.get();
    }
    void key(Qt::Key key) { QTest::keyClick(window.windowHandle(), key); }
    [[nodiscard]] gui::AnswerTarget& target(const char* name) {
        auto* found = window.findChild<gui::AnswerTarget*>(name);
        EXPECT_NE(found, nullptr) << name;
        return *found;
    }
    void press(const char* by) {
        const auto now = std::chrono::steady_clock::now();
        if (now - std::exchange(lastPress, now) >= onePress) static_cast<void>(desk.stopBy(by));
    }

    gui::ParticipantDesk desk;
    std::vector<std::string> stops;
    std::chrono::steady_clock::time_point stoppedAt;
    std::chrono::milliseconds onePress{0};  ///< the time in which stops count as one press
    std::chrono::steady_clock::time_point lastPress;
    gui::ParticipantWindow window{desk, [this](const char* by) { press(by); }};
    gui::StopKeys keys{[this](const char* by) {
                           press(by);
                           window.noteStop();
                       },
                       nullptr};
    std::future<Result<PilotAnswer>> answer;
};

}  // namespace tacto::test
