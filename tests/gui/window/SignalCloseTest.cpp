// Tests Ctrl+C in the terminal and similar signals, in a separate process, because signals reach the whole process.
#include <QProcess>
#include <csignal>
#include <fstream>
#include <iostream>

#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/window/SignalClose.h"
#include "app/run/SignalStop.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

constexpr const char* kPart = "TACTO_SIGNALLED_WINDOW";

/// The window of main() while it delivers.
class SignalledWindow : public Window {
public:
    void beginDelivery() {
        open();
        arm();
        deliver();
        // Leaves a script unsaved: a signal must not ask about it.
        visit(6);
        QPushButton* button = nullptr;
        ASSERT_IN_TIME(comesTrue([&] { return (button = find<QPushButton>(window, "New…")) != nullptr; }));
        click(*button);
        auto* editor = window.findChild<gui::ScriptEditor*>();
        ASSERT_NE(editor, nullptr);
        QTest::keyClicks(&editor->code(), "//mine");
        ASSERT_TRUE(editor->unsaved());
    }
    void TestBody() override {}
    using Window::state;
    using Window::window;
};

void block(int how) {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&set, signal);
    pthread_sigmask(how, &set, nullptr);
}

/// Runs in the process whose window gets the signal.
void deliverUntilSignalled() {
    std::string session;
    {
        SignalStop stops;
        SignalledWindow app;
        app.beginDelivery();
        session = app.window.controller().open()->session.string();
        {
            const gui::SignalClose closes(stops, app.window);
            std::cout << "delivering" << std::endl;
            EXPECT_EQ(QApplication::exec(), 0);
        }
        EXPECT_EQ(app.state(), InterlockState::Disarmed);
        // The reason comes with the next step of the control loop.
        EXPECT_IN_TIME(comesTrue([&] {
            return std::string_view(app.window.controller().telemetry().reason.c_str()) == "operator (signal)";
        })) << app.window.controller().telemetry().reason.c_str();
        EXPECT_FALSE(app.window.isVisible());
    }
    QProcess verify;
    verify.start(QCoreApplication::applicationDirPath() + "/tactoscope-cli",
                 {"verify", QString::fromStdString(session), "--json"});
    ASSERT_TRUE(verify.waitForFinished());
    EXPECT_EQ(verify.exitCode(), 0);
    const auto said = verify.readAllStandardOutput();
    EXPECT_TRUE(said.contains("\"recovered\": false")) << said.toStdString();
}

TEST(SignalClose, ASignalEndsTheOutputAndClosesTheWindowAndItsSession) {
    RecordProperty("hazard", "H2");
    if (qEnvironmentVariableIsSet(kPart)) return deliverUntilSignalled();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        QProcess other;
        auto environment = QProcessEnvironment::systemEnvironment();
        environment.insert(kPart, "1");
        for (const auto* gtest : {"GTEST_OUTPUT", "GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX", "GTEST_SHARD_STATUS_FILE"})
            environment.remove(gtest);
        other.setProcessEnvironment(environment);
        other.setProcessChannelMode(QProcess::MergedChannels);
        other.setChildProcessModifier([] { block(SIG_BLOCK); });  // as main() blocks them before its first thread
        other.start(QCoreApplication::applicationFilePath(),
                    {"--gtest_filter=SignalClose.ASignalEndsTheOutputAndClosesTheWindowAndItsSession"});
        ASSERT_TRUE(other.waitForStarted());
        QByteArray said;
        ASSERT_IN_TIME(comesTrue([&] { return (said += other.readAll()).contains("delivering"); }, 30'000))
            << said.toStdString();
        kill(static_cast<pid_t>(other.processId()), signal);
        ASSERT_TRUE(other.waitForFinished(20'000)) << "signal " << signal;
        said += other.readAll();
        EXPECT_EQ(other.exitStatus(), QProcess::NormalExit) << "signal " << signal;
        EXPECT_EQ(other.exitCode(), 0) << said.toStdString();
    }
}

TEST(SignalClose, WhatTheWindowOpensTakesSignalsAsUsual) {
    const SignalStop stops;
    const ScratchDir scratch;
    const auto path = scratch.path() / "mask";
    ASSERT_TRUE(QProcess::startDetached(
        "/bin/sh", {"-c", QString("grep SigBlk /proc/self/status > %1.part; mv %1.part %1").arg(path.c_str())}));
    ASSERT_IN_TIME(comesTrue([&] { return std::filesystem::exists(path); }));
    block(SIG_UNBLOCK);  // restores this thread for later tests
    std::ifstream stream(path);
    std::string name;
    std::uint64_t mask = 0;
    stream >> name >> std::hex >> mask;
    EXPECT_EQ(name, "SigBlk:");
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) EXPECT_EQ(mask >> (signal - 1) & 1, 0U) << signal;
}

}  // namespace
}  // namespace tacto::test
