// tactoscope - the window.
#include <QApplication>
#include <QSettings>
#include <algorithm>
#include <cstdio>

#include "app/gui/theme/Theme.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/SignalClose.h"
#include "app/gui/window/StartedWith.h"
#include "app/run/AllDrivers.h"
#include "app/run/SignalStop.h"
#include "core/base/StandardStreams.h"

namespace {

int answer(const tacto::gui::StartedWith::Answer& answer) {
    std::fprintf(answer.exitCode == 0 ? stdout : stderr, "%s\n", qUtf8Printable(answer.text));
    return answer.exitCode;
}

/// Qt would end the program with a core dump.
bool hasDisplay(const QStringList& arguments) {
    if (arguments.contains("-platform") || arguments.contains("--platform")) return true;
    const char* variables[] = {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"};
    return std::ranges::any_of(variables, [](const char* name) { return !qEnvironmentVariableIsEmpty(name); });
}

}  // namespace

int main(int argc, char** argv) {
    using tacto::gui::StartedWith;
    tacto::holdStandardStreams();
    const QStringList arguments(argv, argv + argc);
    const auto asked = StartedWith::read(arguments).answer;
    if (asked && asked->exitCode == 0) return answer(*asked);
    if (!hasDisplay(arguments))
        return answer({"tactoscope: no display: DISPLAY and WAYLAND_DISPLAY are empty; tactoscope-cli needs none", 3});
    tacto::SignalStop stops;  // before any other thread
    QApplication application(argc, argv);
    QApplication::setApplicationName("tactoscope");
    QApplication::setOrganizationName("tactoscope");
    QApplication::setApplicationDisplayName("Tactoscope");
    QApplication::setApplicationVersion(TACTOSCOPE_VERSION);
    QApplication::setDesktopFileName("io.github.tactoscope.Tactoscope");
    const auto started = StartedWith::read(QApplication::arguments());
    if (started.answer) return answer(*started.answer);
    using tacto::gui::MainWindow;
    MainWindow window(tacto::allDrivers());
    const tacto::gui::SignalClose closesAtSignals(stops, window);
    window.show();
    const bool opens = !started.file.isEmpty();
    if (opens) window.openFile(started.file);
    if (QSettings().value("tourDone").toBool())
        window.askForDay(true);
    else if (!opens)
        window.beginTour();
    return QApplication::exec();
}
