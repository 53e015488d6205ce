// main() of every gui test: offscreen unless said otherwise, with the user's folders in a place of its own. A crash
// says where it was.
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
    std::raise(signal);  // ends as if there were no handler
}

/// A test leaves theme and text as it likes: they are set again once its windows are gone, which takes no time then.
struct OwnLook final : testing::EmptyTestEventListener {
    OwnLook() { set(); }
    void OnTestEnd(const testing::TestInfo&) override { set(); }

private:
    static void set() {
        tacto::gui::applyTheme(tacto::gui::Theme::Light);
        tacto::gui::applyTextSize(100);  // the program's own font, as its window begins
    }
};

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    std::array<void*, 1> loaded{};
    backtrace(loaded.data(), 1);  // the first call allocates
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
