// Command.h - what every command of tactoscope-cli is made of: options read once, one JSON value on stdout,
// everything else on stderr, and the exit codes of the contract.
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

/// Exit codes: part of the contract.
enum Exit : int {
    kDone = 0,           ///< done and passed
    kVerdictFailed = 1,  ///< a verdict failed
    kUsage = 2,          ///< the command line is wrong
    kCouldNotRun = 3,    ///< a device or file is not usable
    kStopped = 4,        ///< stopped by safety or by the operator
    kIndeterminate = 5,  ///< neither pass nor fail
};

/// The exit code that an error asks for.
[[nodiscard]] int exitFor(const Error& error) noexcept;

/// Prints the error's sentence on stderr and returns its exit code.
[[nodiscard]] int failWith(const Error& error);
/// Does what refused() does, where a file or device is at fault: exit code 3, even where the sentence is about a value.
[[nodiscard]] int couldNotRun(const Error& error);
/// Refuses a wrong command line: exit code 2.
[[nodiscard]] int usage(const std::string& sentence);

/// One command: its words, its options, what it does.
struct Command {
    const char* name;
    const char* arguments;  ///< as shown in the usage line: "RECORDING [--profile F]"
    const char* summary;
    /// Declares options, then gets the parsed command line.
    void (*declare)(QCommandLineParser& parser);
    int (*run)(const QCommandLineParser& parser);  ///< null: another program does it (ReportProgram.h)
};

/// Qt's own warnings are for developers: from here on its fatal errors alone are printed.
void printFatalOnly();
/// "PROGRAM NAME ARGUMENTS"; a line for each of {these | and these} arguments.
[[nodiscard]] std::string howToCall(const Command& command, std::string_view program);
/// Parses `words`, the program's name first, and runs the command. A QCoreApplication is there.
[[nodiscard]] int runCommand(const Command& command, const QStringList& words);

/// The one positional argument. Errors: InvalidArgument naming what is missing or too much.
[[nodiscard]] Result<std::string> onlyArgument(const QCommandLineParser& parser, const char* what);
/// A number option. Errors: InvalidArgument naming option and text; missing without a default.
[[nodiscard]] Result<double> numberOption(const QCommandLineParser& parser, const char* name);

/// Prints one JSON value on stdout.
void printJson(const nlohmann::json& value);
/// Writes a whole file or none. Errors: Io.
[[nodiscard]] Result<void> writeFile(const std::string& path, const std::string& content);

// Defined one per file, in app/cli/<Name>Command.cpp.
extern const Command kDevices, kProtocols, kRun, kRoughness, kEncode, kMeasure, kConvert, kAnalyze, kVerify, kHid,
    kScienceMode, kSensor, kCertificate, kStudy, kExport;
// The words of the program tactoscope-report, which stand in the help of tactoscope-cli.
extern const Command kReport;
inline constexpr const char* kReportArguments =
    "{SESSION|STUDY} --out report.pdf [--participant CODE | --for READER] [--noted] [--passphrase-file F]";
inline constexpr const char* kReportSummary = "The report of a session or of a study, as PDF or HTML";

}  // namespace tacto::cli
