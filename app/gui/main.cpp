// tactoscope - the window.
#include <QApplication>
#include <QSettings>

#include "app/gui/look/Look.h"
#include "app/gui/window/MainWindow.h"
#include "drivers/replay/ReplayDrivers.h"
#include "drivers/simulated/SimulatedDriver.h"

namespace {

// The only place that names concrete drivers.
tacto::Registry makeRegistry() {
    std::vector<std::unique_ptr<tacto::Driver>> drivers;
    drivers.push_back(tacto::makeSimulatedDriver());
    drivers.push_back(tacto::makeRecordingDriver());
    drivers.push_back(tacto::makeCaptureDriver());
    return tacto::Registry(std::move(drivers));
}

}  // namespace

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    QApplication::setApplicationName("tactoscope");
    QApplication::setOrganizationName("tactoscope");
    QApplication::setApplicationDisplayName("Tactoscope");
    QApplication::setApplicationVersion(TACTOSCOPE_VERSION);
    QApplication::setDesktopFileName("io.github.tactoscope.Tactoscope");
    tacto::gui::MainWindow window(makeRegistry);
    window.show();
    if (!QSettings().value("tourDone").toBool()) window.beginTour();
    return QApplication::exec();
}
