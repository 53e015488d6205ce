#include "app/gui/window/StartedWith.h"

#include <QCommandLineParser>
#include <QFileInfo>

#include "core/base/ProgramVersion.h"

namespace tacto::gui {
namespace {

constexpr auto kHelp = R"(usage: tactoscope [FILE]

The window. tactoscope-cli is the same bench in a terminal.

  FILE           opened at once: a session (*.tacto), a recording (its folder, its recording.json, or an
                 EDF, BDF or XDF file) or an oscilloscope's capture
  -h, --help     prints this
  -v, --version  prints the version)";

StartedWith refused(const QString& sentence, int exitCode) {
    return {{}, StartedWith::Answer{"tactoscope: " + sentence, exitCode}};
}

}  // namespace

StartedWith StartedWith::read(const QStringList& arguments) {
    QCommandLineParser parser;
    // Reads options as Qt does, so that the h in "-stylesheet" does not mean "-h".
    parser.setSingleDashWordOptionMode(QCommandLineParser::ParseAsLongOptions);
    const auto help = parser.addHelpOption();
    const auto version = parser.addVersionOption();
    const bool understood = parser.parse(arguments);
    if (parser.isSet(help)) return {{}, Answer{kHelp}};
    if (parser.isSet(version)) return {{}, Answer{QString("tactoscope %1").arg(programVersion().version)}};
    if (!understood)
        return refused(QString("%1; --help, --version or a FILE is expected").arg(parser.errorText().chopped(1)), 2);
    const auto files = parser.positionalArguments();
    if (files.isEmpty()) return {};
    if (files.size() > 1) return refused(QString("%1 files are given; one FILE is expected").arg(files.size()), 2);
    if (!QFileInfo::exists(files.front())) return refused(QString("%1 does not exist").arg(files.front()), 3);
    return {files.front(), {}};
}

}  // namespace tacto::gui
