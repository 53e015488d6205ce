// tactoscope-report SESSION --out FILE: `tactoscope-cli report`, in a program of its own (ReportProgram.h).
#include <QApplication>

#include "app/cli/Command.h"
#include "core/base/StandardStreams.h"

namespace {

/// Qt's own warnings are for developers; its fatal errors are for everybody.
void quietly(QtMsgType type, const QMessageLogContext&, const QString& text) {
    if (type == QtFatalMsg || type == QtCriticalMsg)
        tacto::cli::say(stderr, "{}\n", tacto::cli::lines(text.toStdString()));
}

}  // namespace

int main(int argc, char** argv) {
    tacto::holdStandardStreams();
    // Drawing needs fonts and a QApplication but no display, and no word about a missing session of a desktop.
    if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
    qInstallMessageHandler(quietly);
    const QApplication application(argc, argv);
    return tacto::cli::runCommand(tacto::cli::kReport, QCoreApplication::arguments());
}
