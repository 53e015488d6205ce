// tactoscope-report SESSION --out FILE: runs `tactoscope-cli report` as a separate program (ReportProgram.h).
#include <QApplication>

#include "app/cli/Command.h"
#include "core/base/ProgramStart.h"

int main(int argc, char** argv) {
    tacto::holdStandardStreams();
    // Drawing needs fonts and a QApplication, but no display and no warning about a missing desktop session.
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    tacto::cli::printFatalOnly();
    const QApplication application(argc, argv);
    return tacto::cli::runCommand(tacto::cli::kReport, QCoreApplication::arguments());
}
