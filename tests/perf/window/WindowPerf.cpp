// perf_window - the cost and response time of the window; each value has a goal and a baseline from the same run. Uses
// the offscreen platform unless QT_QPA_PLATFORM is set, and keeps out of the user's folders.
//
//   perf_window PATH-OF-tactoscope-cli [redraw] [stalls] [stop]
#include "tests/perf/window/WindowPerf.h"

#include <QApplication>
#include <QTemporaryDir>
#include <chrono>
#include <cstdio>
#include <set>

#include "app/gui/theme/Theme.h"
#include "tests/gui/OffscreenScreen.h"
#include "tests/gui/window/StallWatch.h"

namespace tacto::perf {

namespace {

bool everything = true;

/// Drops a message that the offscreen platform prints for every window, in the middle of the tables.
void withoutSizeHints(QtMsgType, const QMessageLogContext&, const QString& text) {
    if (!text.contains("propagateSizeHints")) std::fprintf(stderr, "%s\n", qPrintable(text));
}

}  // namespace

void heading(const char* what, const char* columns) { std::printf("\n%-46s %s\n", what, columns); }

void line(const std::string& what, const std::string& figures, const std::string& remark) {
    std::printf("  %-44s %s%s%s\n", what.c_str(), figures.c_str(), remark.empty() ? "" : "  ", remark.c_str());
    std::fflush(stdout);
}

void notMeasured(const std::string& what, const std::string& why) {
    everything = false;
    line(what, "not measured: " + why);
}

bool everythingWasMeasured() noexcept { return everything; }

double secondsOf(clockid_t clock) noexcept {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

bool comes(const std::function<bool()>& isSo, int limit_ms) {
    return test::stallsWhile([] {}, isSo, limit_ms).has_value();
}

void pass(int ms) {
    QEventLoop loop;
    QTimer::singleShot(ms, &loop, &QEventLoop::quit);
    loop.exec();
}

bool openBench(gui::BenchController& controller, double speed) {
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller.profile();
    order.speed = speed;
    controller.openLive(order);
    return comes([&] { return controller.activity() == gui::Activity::Live; });
}

bool deliver(gui::BenchController& controller) {
    const auto state = [&] { return controller.telemetry().state; };
    ArmRequest request;
    request.operatorConfirmed = true;
    controller.arm(request);
    if (!comes([&] { return state() == InterlockState::Armed; })) return false;
    controller.drive(DriveSource::Manual, 0.5, 1);
    return comes([&] { return state() == InterlockState::Delivering; });
}

}  // namespace tacto::perf

int main(int argc, char** argv) {
    const QTemporaryDir home;
    for (const auto* name : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
        qputenv(name, home.path().toUtf8());
    tacto::test::useOffscreenScreen(home);
    qInstallMessageHandler(tacto::perf::withoutSizeHints);
    QApplication application(argc, argv);
    QApplication::setApplicationName("tactoscope");
    QApplication::setOrganizationName("tactoscope");
    QApplication::setQuitOnLastWindowClosed(false);
    if (argc < 2) {
        std::fprintf(stderr, "usage: perf_window PATH-OF-tactoscope-cli [redraw] [stalls] [stop]\n");
        return 2;
    }
    tacto::gui::applyTheme(tacto::gui::Theme::Light);
    const std::set<std::string> parts(argv + 2, argv + argc);
    const auto wanted = [&](const char* part) { return parts.empty() || parts.contains(part); };
    if (wanted("redraw")) tacto::perf::measureRedraw();
    if (wanted("stalls")) tacto::perf::measureStalls(argv[1]);
    if (wanted("stop")) tacto::perf::measureStop();
    return tacto::perf::everythingWasMeasured() ? 0 : 1;
}
