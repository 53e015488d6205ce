// tactoscope - the window.
#include <QApplication>
#include <QSettings>

#include "app/gui/theme/Theme.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/SignalClose.h"
#include "app/run/AllDrivers.h"
#include "app/run/SignalStop.h"
#include "core/base/StandardStreams.h"

int main(int argc, char** argv) {
    tacto::holdStandardStreams();
    tacto::SignalStop stops;  // before any other thread
    QApplication application(argc, argv);
    QApplication::setApplicationName("tactoscope");
    QApplication::setOrganizationName("tactoscope");
    QApplication::setApplicationDisplayName("Tactoscope");
    QApplication::setApplicationVersion(TACTOSCOPE_VERSION);
    QApplication::setDesktopFileName("io.github.tactoscope.Tactoscope");
    using tacto::gui::MainWindow;
    MainWindow window(tacto::allDrivers(), MainWindow::Pages::AfterTheFirstPicture);
    const tacto::gui::SignalClose closesAtSignals(stops, window);
    window.show();
    if (QSettings().value("tourDone").toBool())
        window.askForDay(true);
    else
        window.beginTour();
    return QApplication::exec();
}
