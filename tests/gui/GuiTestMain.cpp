// The main() of every gui test: offscreen unless the environment says otherwise, and with separate user folders. After
// a crash it prints where the crash happened.
#include <QApplication>
#include <QTemporaryDir>
#include <array>
#include <csignal>
#include <execinfo.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "app/gui/theme/Theme.h"
#include "tests/gui/OffscreenScreen.h"
#include "tests/support/Support.h"

namespace {

void sayWhere(int signal) {
    std::array<void*, 64> frames{};
    backtrace_symbols_fd(frames.data(), backtrace(frames.data(), int(frames.size())), STDERR_FILENO);
    std::raise(signal);  // ends the program as if there were no handler
}

/// Restores theme and text size after each test. By then the test's windows are gone, so this is quick.
struct OwnLook final : testing::EmptyTestEventListener {
    OwnLook() { set(); }
    void OnTestEnd(const testing::TestInfo&) override { set(); }

private:
    static void set() {
        tacto::gui::applyTheme(tacto::gui::Theme::Light);
        tacto::gui::applyTextSize(100);  // the program's own font, as at its start
    }
};

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    std::array<void*, 1> loaded{};
    backtrace(loaded.data(), 1);  // the first call allocates memory, which a handler must not
    struct sigaction crash {};
    crash.sa_handler = sayWhere;
    crash.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS}) sigaction(signal, &crash, nullptr);
    const QTemporaryDir home;
    for (const auto* name : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
        qputenv(name, home.path().toUtf8());
    tacto::test::useOffscreenScreen(home);
    QApplication application(argc, argv);
    QApplication::setApplicationName("tactoscope");
    QApplication::setOrganizationName("tactoscope");
    QApplication::setQuitOnLastWindowClosed(false);
    testing::UnitTest::GetInstance()->listeners().Append(new OwnLook);
    return RUN_ALL_TESTS();
}
