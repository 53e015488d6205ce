// tactoscope-cli - all functions of Tactoscope without a window; `tactoscope-cli help` describes them.
#include <QCoreApplication>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "app/cli/Command.h"
#include "app/cli/ReportProgram.h"
#include "app/scripting/engine/ScriptRun.h"
#include "core/base/ProgramStart.h"
#include "core/base/ProgramVersion.h"

namespace tacto::cli {

namespace {

constexpr const char* kNotice =
    "Tactoscope is a research bench, not a medical device. Simulated devices are marked as simulated.";
constexpr const char* kLicence = "GPL-3.0-or-later";

/// Returns the commands in the order of the help.
const std::vector<Command>& commands() {
    // A separate program makes reports (ReportProgram.h).
    static const Command report{"report", kReportArguments, kReportSummary, nullptr, nullptr};
    static const std::vector<Command> all{
        kRun,    kProtocols, kDevices, kRoughness,   kEncode, kMeasure,     kConvert, kAnalyze, report,
        kVerify, kCompare,   kHid,     kScienceMode, kSensor, kCertificate, kStudy,   kExport,  kFirmwareProfile};
    return all;
}

void printHelp(std::FILE* to) {
    say(to, "tactoscope-cli {} - tactile-feedback stimulation, from fingertip to judged pulse train\n\n",
        programVersion().version);
    for (const auto& command : commands()) {
        say(to, "{}        {}\n", lines(howToCall(command, "  tactoscope-cli")), command.summary);
    }
    say(to,
        "\nExit codes: 0 done and passed, 1 a verdict failed, 2 usage, 3 could not run (device, file),\n"
        "4 stopped by safety or by the operator, 5 indeterminate. --json prints one JSON value on stdout.\n"
        "{}\n",
        kNotice);
}

int printVersion(std::span<char*> words) {
    const bool asJson = words.size() == 1 && std::strcmp(words.front(), "--json") == 0;
    if (!asJson && !words.empty())
        return usage(fmt::format("--version: \"{}\" is given; --json or nothing is expected", words.back()));
    const auto& built = programVersion();
    const bool known = *built.date != '\0';
    if (asJson) {
        auto libraries = nlohmann::json::object();
        for (const auto& library : built.libraries) libraries[library.name] = library.version;
        printJson({{"version", built.version},
                   {"commit", built.commit},
                   {"dirty", known ? nlohmann::json(built.dirty) : nlohmann::json()},
                   {"date", known ? nlohmann::json(built.date) : nlohmann::json()},
                   {"compiler", built.compiler},
                   {"libraries", std::move(libraries)},
                   {"licence", kLicence}});
    } else {
        std::string libraries;
        for (const auto& library : built.libraries)
            libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", library.name, library.version);
        say("tactoscope-cli {}\ncommit {}{}{}{}\ncompiler {}\nlibraries {}\nlicence {}\n", built.version, built.commit,
            known ? " of " : "", built.date, built.dirty ? ", with changes that are in no commit" : "", built.compiler,
            libraries, kLicence);
    }
    return flushed("--version", kDone);
}

int runNamed(const Command& command, int argc, char** argv) {
    if (const auto refused = refusedStart(argc, argv)) return couldNotRun({ErrorCode::Io, *refused});
    if (command.run == nullptr) return becomeReportProgram(argv);
    printFatalOnly();
    const QCoreApplication application(argc, argv);
    auto words = QCoreApplication::arguments();
    words.removeAt(1);  // the command's name
    return runCommand(command, words);
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
        return flushed("help", kDone);
    }
    if (std::strcmp(name, "--version") == 0) return printVersion({argv + 2, argv + argc});
    std::string known;
    for (const auto& command : commands()) {
        if (std::strcmp(name, command.name) == 0) return runNamed(command, argc, argv);
        known += fmt::format("{}{}", known.empty() ? "" : ", ", command.name);
    }
    return usage(fmt::format("there is no command \"{}\"; the commands are {}", name, known));
}
