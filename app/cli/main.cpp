// tactoscope-cli - all of Tactoscope without a window. `tactoscope-cli help` is the contract.
#include <QApplication>
#include <QCoreApplication>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <string_view>

#include "app/cli/Command.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/base/StandardStreams.h"

namespace tacto::cli {

namespace {

constexpr const char* kNotice =
    "Tactoscope is a research bench, not a medical device. Simulated devices are marked as simulated.";

/// "tactoscope-cli NAME ARGUMENTS"; a line for each of {these | and these} arguments.
std::string howToCall(const Command& command, std::string_view indent) {
    const std::string_view arguments = command.arguments;
    const auto end = arguments.starts_with('{') ? arguments.find('}') : std::string_view::npos;
    if (end == std::string_view::npos) return fmt::format("{}tactoscope-cli {} {}\n", indent, command.name, arguments);
    std::string all;
    for (auto rest = arguments.substr(1, end - 1); !rest.empty();) {
        const auto bar = std::min(rest.find(" | "), rest.size());
        all += fmt::format("{}tactoscope-cli {} {}{}\n", indent, command.name, rest.substr(0, bar),
                           arguments.substr(end + 1));
        rest.remove_prefix(std::min(bar + 3, rest.size()));
    }
    return all;
}

void printHelp(std::FILE* to) {
    say(to, "tactoscope-cli {} - tactile-feedback stimulation, from fingertip to judged pulse train\n\n",
        TACTOSCOPE_VERSION);
    for (const auto& command : commands()) {
        say(to, "{}        {}\n", lines(howToCall(command, "  ")), command.summary);
    }
    say(to,
        "\nExit codes: 0 done and passed, 1 a verdict failed, 2 usage, 3 could not run (device, file),\n"
        "4 stopped by safety or by the operator, 5 indeterminate. --json prints one JSON value on stdout.\n"
        "{}\n",
        kNotice);
}

/// Qt's own warnings are for developers; its fatal errors are for everybody.
void quietly(QtMsgType type, const QMessageLogContext&, const QString& text) {
    if (type == QtFatalMsg || type == QtCriticalMsg) say(stderr, "{}\n", lines(text.toStdString()));
}

int runCommand(const Command& command, int argc, char** argv) {
    if (command.draws) {
        // Drawing needs fonts and a QApplication but no display, and no word about a missing session of a desktop.
        if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
        qInstallMessageHandler(quietly);
    }
    std::unique_ptr<QCoreApplication> application;
    if (command.draws)
        application = std::make_unique<QApplication>(argc, argv);
    else
        application = std::make_unique<QCoreApplication>(argc, argv);
    QCoreApplication::setApplicationName("tactoscope");
    QCoreApplication::setApplicationVersion(TACTOSCOPE_VERSION);

    QCommandLineParser parser;
    parser.setSingleDashWordOptionMode(QCommandLineParser::ParseAsLongOptions);
    parser.setOptionsAfterPositionalArgumentsMode(QCommandLineParser::ParseAsOptions);
    parser.setApplicationDescription(command.summary);
    parser.addOption({{"h", "help"}, "Shows this."});
    command.declare(parser);

    auto words = QCoreApplication::arguments();
    words.removeAt(1);  // the command's name
    if (!parser.parse(words)) {
        const bool hasForms = std::string_view(command.arguments).starts_with('{');
        return usage(fmt::format("{}: {} (tactoscope-cli {} {})", command.name, parser.errorText().toStdString(),
                                 command.name, hasForms ? "--help" : command.arguments));
    }
    if (parser.isSet("help")) {
        say("{}", lines(howToCall(command, "")));
        say("{}\n", lines(parser.helpText().section('\n', 1).toStdString()));
        return kDone;
    }
    try {
        int code = command.run(parser);
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            say(stderr, "tactoscope-cli: {}: the output could not be written: {}\n", command.name,
                std::strerror(errno));
            if (code == kDone) code = kCouldNotRun;
        }
        if (ScriptRun::abandonedRunning() == 0) return code;
        std::fflush(nullptr);
        std::_Exit(code);  // a script that does not end would run on among what is taken down
    } catch (const std::exception& surprise) {
        // From a library: this program's own code does not throw. Devices were switched off when their bench was
        // unwound.
        say(stderr, "tactoscope-cli: {}: unexpected error: {}\n", command.name, surprise.what());
        return kCouldNotRun;
    }
}

}  // namespace
}  // namespace tacto::cli

int main(int argc, char** argv) {
    using namespace tacto::cli;
    tacto::holdStandardStreams();
    const char* name = argc > 1 ? argv[1] : nullptr;
    if (name == nullptr) {
        printHelp(stderr);
        return kUsage;
    }
    if (std::strcmp(name, "help") == 0 || std::strcmp(name, "--help") == 0 || std::strcmp(name, "-h") == 0) {
        printHelp(stdout);
        return kDone;
    }
    if (std::strcmp(name, "--version") == 0) {
        say("tactoscope-cli {}\n", TACTOSCOPE_VERSION);
        return kDone;
    }
    std::string known;
    for (const auto& command : commands()) {
        if (std::strcmp(name, command.name) == 0) return runCommand(command, argc, argv);
        known += fmt::format("{}{}", known.empty() ? "" : ", ", command.name);
    }
    return usage(fmt::format("there is no command \"{}\"; the commands are {}", name, known));
}
