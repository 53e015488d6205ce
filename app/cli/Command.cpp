#include "app/cli/Command.h"

#include <QCoreApplication>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/ProgramVersion.h"
#include "core/base/TypedNumber.h"
#include "core/base/WholeFile.h"

namespace tacto::cli {

int exitFor(const Error& error) noexcept {
    switch (error.code) {
        case ErrorCode::InvalidArgument:
            return kUsage;
        case ErrorCode::LimitExceeded:
        case ErrorCode::NotArmed:
        case ErrorCode::Stopped:
            return kStopped;
        case ErrorCode::ParseError:
        case ErrorCode::NotFound:
        case ErrorCode::Io:
        case ErrorCode::Device:
        case ErrorCode::Timeout:
        case ErrorCode::Unsupported:
            break;
    }
    return kCouldNotRun;
}

int failWith(const Error& error) {
    say(stderr, "tactoscope-cli: {}\n", lines(error.message));
    return exitFor(error);
}

int couldNotRun(const Error& error) {
    say(stderr, "tactoscope-cli: {}\n", lines(error.message));
    return kCouldNotRun;
}

int usage(const std::string& sentence) {
    say(stderr, "tactoscope-cli: {}\n", lines(sentence));
    return kUsage;
}

void printFatalOnly() {
    qInstallMessageHandler([](QtMsgType type, const QMessageLogContext&, const QString& text) {
        if (type == QtFatalMsg || type == QtCriticalMsg) say(stderr, "{}\n", lines(text.toStdString()));
    });
}

std::string howToCall(const Command& command, std::string_view program) {
    const std::string_view arguments = command.arguments;
    const auto end = arguments.starts_with('{') ? arguments.find('}') : std::string_view::npos;
    if (end == std::string_view::npos) return fmt::format("{} {} {}\n", program, command.name, arguments);
    std::string all;
    for (auto rest = arguments.substr(1, end - 1); !rest.empty();) {
        const auto bar = std::min(rest.find(" | "), rest.size());
        all += fmt::format("{} {} {}{}\n", program, command.name, rest.substr(0, bar), arguments.substr(end + 1));
        rest.remove_prefix(std::min(bar + 3, rest.size()));
    }
    return all;
}

int runCommand(const Command& command, const QStringList& words) {
    QCoreApplication::setApplicationName("tactoscope");
    QCoreApplication::setApplicationVersion(programVersion().version);

    QCommandLineParser parser;
    parser.setSingleDashWordOptionMode(QCommandLineParser::ParseAsLongOptions);
    parser.setOptionsAfterPositionalArgumentsMode(QCommandLineParser::ParseAsOptions);
    parser.setApplicationDescription(command.summary);
    parser.addOption({{"h", "help"}, "Shows this."});
    command.declare(parser);
    if (!parser.parse(words)) {
        const bool hasForms = std::string_view(command.arguments).starts_with('{');
        return usage(fmt::format("{}: {} (tactoscope-cli {} {})", command.name, parser.errorText().toStdString(),
                                 command.name, hasForms ? "--help" : command.arguments));
    }
    if (parser.isSet("help")) {
        say("{}", lines(howToCall(command, "tactoscope-cli")));
        say("{}\n", lines(parser.helpText().section('\n', 1).toStdString()));
        return kDone;
    }
    try {
        return flushed(command.name, command.run(parser));
    } catch (const std::exception& surprise) {
        // Thrown by a library: this program's own code does not throw. Devices were switched off when their bench was
        // destroyed.
        say(stderr, "tactoscope-cli: {}: unexpected error: {}\n", command.name, surprise.what());
        return kCouldNotRun;
    }
}

int flushed(const char* command, int code) {
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    say(stderr, "tactoscope-cli: {}: the output could not be written: {}\n", command, std::strerror(errno));
    return code == kDone ? kCouldNotRun : code;
}

Result<std::string> onlyArgument(const QCommandLineParser& parser, const char* what) {
    const auto given = parser.positionalArguments();
    if (given.size() == 1) return given.front().toStdString();
    if (given.isEmpty()) return fail(ErrorCode::InvalidArgument, "{} is missing", what);
    return fail(ErrorCode::InvalidArgument, "one {} is expected, and \"{}\" is a second one", what,
                given.at(1).toStdString());
}

Result<double> numberOption(const QCommandLineParser& parser, const char* name) {
    if (!parser.isSet(name)) return fail(ErrorCode::InvalidArgument, "--{} is missing", name);
    const auto text = parser.value(name).toStdString();
    const auto number = typedNumber(text);
    if (!number || !std::isfinite(*number)) {
        return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a number is expected{}", name, text,
                    typedTrouble(text));
    }
    return *number;
}

void printJson(const nlohmann::json& value) {
    auto text = dumpJson(value, 2);
    // Characters that a terminal would act on are written as JSON escapes, which keeps the value the same.
    if (printable(text, Newlines::Keep) != text) text = dumpJson(value, 2, true);
    say("{}\n", lines(text));
    std::fflush(stdout);
}

Result<void> writeFile(const std::string& path, const std::string& content) {
    return namedAs(path, writeWholeFile(path, content));
}

}  // namespace tacto::cli
