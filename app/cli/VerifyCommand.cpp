#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "core/session/SessionVerify.h"

namespace tacto::cli {

namespace {

void declareVerify(QCommandLineParser& parser) { parser.addOption({"json", "Prints one JSON value."}); }

int runVerify(const QCommandLineParser& parser) {
    const auto path = onlyArgument(parser, "SESSION");
    if (!path) return usage(fmt::format("verify: {}", path.error().message));
    const auto report = verifySession(*path);
    if (!report) return couldNotRun(report.error());
    if (report->status == SessionStatus::NotASession) {
        return couldNotRun(Error{ErrorCode::ParseError, report->problems.empty()
                                                            ? fmt::format("{} is not a Tactoscope session", *path)
                                                            : report->problems.front()});
    }
    if (parser.isSet("json")) {
        printJson({{"status", nameOf(report->status)},
                   {"closed", report->closed},
                   {"recovered", report->recovered},
                   {"notes", report->notes},
                   {"problems", report->problems},
                   {"head", report->head},
                   {"rows", report->rows},
                   {"events", report->events},
                   {"trials", report->trials},
                   {"captures", report->captures},
                   {"verdicts", report->verdicts},
                   {"chunks", report->chunks},
                   {"samples", report->samples}});
    } else {
        say("{}: {}\n", *path, nameOf(report->status));
        for (const auto& note : report->notes) say("  {}\n", note);
        for (const auto& problem : report->problems) say("  {}\n", problem);
        say("  {} rows, {} trials, {} captures, {} samples\n  chain head {}\n", report->rows, report->trials,
            report->captures, report->samples, report->head);
    }
    return report->status == SessionStatus::Intact ? kDone : kVerdictFailed;
}

}  // namespace

const Command kVerify{"verify", "SESSION [--json]", "Whether a session is what was recorded: integrity and hash chain",
                      false,    declareVerify,      runVerify};

}  // namespace tacto::cli
