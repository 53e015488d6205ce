#include "app/cli/Command.h"

#include <cmath>
#include <cstdio>

#include "app/report/WholeFile.h"
#include "core/base/JsonText.h"
#include "core/base/Text.h"

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

const std::vector<Command>& commands() {
    static const std::vector<Command> all{kRun,     kProtocols,   kDevices, kRoughness, kEncode, kMeasure,
                                          kConvert, kAnalyze,     kReport,  kVerify,    kHid,    kScienceMode,
                                          kSensor,  kCertificate, kStudy,   kExport};
    return all;
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
    const auto number = parseNumber(text);
    if (!number || !std::isfinite(*number)) {
        return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a number is expected", name, text);
    }
    return *number;
}

Result<Profile> profileOption(const QCommandLineParser& parser) {
    return parser.isSet("profile") ? loadProfile(parser.value("profile").toStdString()) : shippedProfile();
}

void printJson(const nlohmann::json& value) {
    auto text = dumpJson(value, 2);
    // What a terminal would act on is written with JSON's own escapes, so that the value stays the same.
    if (printable(text, Newlines::Keep) != text) text = dumpJson(value, 2, true);
    say("{}\n", lines(text));
    std::fflush(stdout);
}

Result<void> writeFile(const std::string& path, const std::string& content) {
    if (const auto written = writeWholeFile(QString::fromStdString(path), QByteArray::fromStdString(content));
        !written) {
        return fail(ErrorCode::Io, "cannot write {}: {}", path, written.error().message);
    }
    return {};
}

}  // namespace tacto::cli
