// tactoscope - the window.
#include <QApplication>
#include <QLocale>
#include <QSettings>
#include <cstdio>
#include <optional>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/DisplayWatch.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/SignalClose.h"
#include "app/gui/window/StartedWith.h"
#include "app/run/AllDrivers.h"
#include "app/run/SignalStop.h"
#include "core/base/ProgramStart.h"
#include "core/base/ProgramVersion.h"

namespace {

int answer(const tacto::gui::StartedWith::Answer& answer) {
    std::fputs(qUtf8Printable(answer.text + '\n'), answer.exitCode == 0 ? stdout : stderr);
    return answer.exitCode;
}

}  // namespace

int main(int argc, char** argv) {
    using tacto::gui::StartedWith;
    tacto::holdStandardStreams();
    const QStringList arguments(argv, argv + argc);
    const auto asked = StartedWith::read(arguments).answer;
    if (asked && asked->exitCode == 0) return answer(*asked);
    if (const auto refused = tacto::refusedStart(argc, argv))
        return answer({"tactoscope: " + tacto::gui::qtext(*refused), 3});
    if (const auto none = tacto::gui::DisplayWatch::noneIsNamed(arguments)) return answer({*none, 3});
    QLocale::setDefault(QLocale::c());  // numbers are written the same way in every country
    tacto::SignalStop stops;            // created before any other thread
    std::optional<tacto::gui::DisplayWatch> watch(std::in_place);
    QApplication application(argc, argv);
    watch.reset();
    QApplication::setApplicationName("tactoscope");
    QApplication::setOrganizationName("tactoscope");
    QApplication::setApplicationDisplayName("Tactoscope");
    QApplication::setApplicationVersion(tacto::programVersion().version);
    QApplication::setDesktopFileName("io.github.tactoscope.Tactoscope");
    const auto started = StartedWith::read(QApplication::arguments());
    if (started.answer) return answer(*started.answer);
    using tacto::gui::MainWindow;
    MainWindow window(tacto::allDrivers());
    const tacto::gui::SignalClose closesAtSignals(stops, window);
    window.show();
    const bool opens = !started.file.isEmpty();
    if (opens) window.openFile(started.file);
    if (opens || QSettings().value("tourDone").toBool())
        window.askForDay(true);
    else
        window.beginTour();  // which asks when it ends
    return QApplication::exec();
}
