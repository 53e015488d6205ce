// Command.h - the parts of every command of tactoscope-cli: options that are read once, one JSON value on stdout,
// everything else on stderr, and fixed exit codes.
#pragma once

#include <QCommandLineParser>
#include <QStringList>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "app/cli/Say.h"
#include "core/base/Result.h"

namespace tacto::cli {

/// Exit codes: scripts may rely on them.
enum Exit : int {
    kDone = 0,           ///< done and passed
    kVerdictFailed = 1,  ///< a verdict is fail
    kUsage = 2,          ///< the command line is wrong
    kCouldNotRun = 3,    ///< a device or file cannot be used
    kStopped = 4,        ///< stopped by safety or by a person
    kIndeterminate = 5,  ///< neither pass nor fail
};

/// Returns the exit code for an error.
[[nodiscard]] int exitFor(const Error& error) noexcept;

/// Prints the error's sentence on stderr and returns its exit code.
[[nodiscard]] int failWith(const Error& error);
/// Like failWith(), but for an error in a file or device: always exit code 3, even if the sentence is about a value.
[[nodiscard]] int couldNotRun(const Error& error);
/// Reports a wrong command line: exit code 2.
[[nodiscard]] int usage(const std::string& sentence);

/// A command: its words, its options, and its function.
struct Command {
    const char* name;
    const char* arguments;  ///< as shown in the usage line: "RECORDING [--profile F]"
    const char* summary;
    /// Declares the options; run() then gets the parsed command line.
    void (*declare)(QCommandLineParser& parser);
    int (*run)(const QCommandLineParser& parser);  ///< null: another program runs the command (ReportProgram.h)
};

/// Suppresses Qt's warnings, which are for developers; only Qt's fatal errors are printed from here on.
void printFatalOnly();
/// Returns "PROGRAM NAME ARGUMENTS"; one line for each alternative in {these | and these}.
[[nodiscard]] std::string howToCall(const Command& command, std::string_view program);
/// Parses `words`, which begin with the program's name, and runs the command. Needs a QCoreApplication.
[[nodiscard]] int runCommand(const Command& command, const QStringList& words);
/// Returns `code`. If stdout could not be written, says so, and returns 3 in place of 0.
[[nodiscard]] int flushed(const char* command, int code);

/// Returns the only positional argument. Errors: InvalidArgument naming a missing or surplus argument.
[[nodiscard]] Result<std::string> onlyArgument(const QCommandLineParser& parser, const char* what);
/// Returns a number option. Errors: InvalidArgument naming option and text; missing without a default.
[[nodiscard]] Result<double> numberOption(const QCommandLineParser& parser, const char* name);

/// Prints one JSON value on stdout.
void printJson(const nlohmann::json& value);
/// Writes a complete file or none. Errors: Io.
[[nodiscard]] Result<void> writeFile(const std::string& path, const std::string& content);

// Each is defined in app/cli/<Name>Command.cpp.
extern const Command kDevices, kProtocols, kRun, kRoughness, kEncode, kMeasure, kConvert, kAnalyze, kVerify, kCompare,
    kHid, kScienceMode, kSensor, kCertificate, kStudy, kExport, kFirmwareProfile;
// The usage text of the program tactoscope-report, for the help of tactoscope-cli.
extern const Command kReport;
inline constexpr const char* kReportArguments =
    "{SESSION|STUDY} {--out report.pdf [--participant CODE | --for READER] | --figures DIR} [--noted] "
    "[--passphrase-file F]";
inline constexpr const char* kReportSummary = "The report of a session or of a study, as PDF or HTML";

}  // namespace tacto::cli
