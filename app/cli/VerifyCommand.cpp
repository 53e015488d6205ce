#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "core/session/SessionVerify.h"
#include "core/study/StudyVerify.h"

namespace tacto::cli {

namespace {

void declareVerify(QCommandLineParser& parser) { parser.addOption({"json", "Prints one JSON value."}); }

nlohmann::json toJson(const VerifyReport& report) {
    auto signatures = nlohmann::json::array();
    for (const auto& [signature, state] : report.signatures)
        signatures.push_back({{"by", signature.by},
                              {"wall", signature.wall},
                              {"report", signature.report},
                              {"sha256", signature.sha256},
                              {"state", nameOf(state)}});
    return {{"status", nameOf(report.status)},
            {"closed", report.closed},
            {"recovered", report.recovered},
            {"notes", report.notes},
            {"problems", report.problems},
            {"head", report.head},
            {"rows", report.rows},
            {"events", report.events},
            {"trials", report.trials},
            {"captures", report.captures},
            {"verdicts", report.verdicts},
            {"chunks", report.chunks},
            {"samples", report.samples},
            {"signatures", std::move(signatures)}};
}

int verifyWholeStudy(const QCommandLineParser& parser, const std::string& folder) {
    const auto report = verifyStudy(folder);
    if (!report) return couldNotRun(report.error());
    if (parser.isSet("json")) {
        auto sessions = nlohmann::json::array();
        for (const auto& session : report->sessions) {
            sessions.push_back(toJson(session.report));
            sessions.back()["file"] = session.file;
        }
        printJson({{"status", nameOf(report->status)},
                   {"notes", report->notes},
                   {"problems", report->problems},
                   {"ledger", toJson(report->ledger)},
                   {"sessions", std::move(sessions)}});
    } else {
        say("{}: {}\n", folder, nameOf(report->status));
        for (const auto& note : report->notes) say("  {}\n", note);
        for (const auto& problem : report->problems) say("  {}\n", problem);
        for (const auto& session : report->sessions) {
            say("  session {}: {}, {} rows\n", session.file, nameOf(session.report.status), session.report.rows);
            for (const auto& problem : session.report.problems) say("    {}\n", problem);
        }
        say("  ledger: {} rows, chain head {}\n", report->ledger.rows, report->ledger.head);
    }
    return report->status == SessionStatus::Intact ? kDone : kVerdictFailed;
}

int runVerify(const QCommandLineParser& parser) {
    const auto path = onlyArgument(parser, "SESSION");
    if (!path) return usage(fmt::format("verify: {}", path.error().message));
    if (std::error_code error; std::filesystem::is_directory(*path, error)) return verifyWholeStudy(parser, *path);
    const auto report = verifySession(*path);
    if (!report) return couldNotRun(report.error());
    if (report->status == SessionStatus::NotASession) {
        return couldNotRun(Error{ErrorCode::ParseError, report->problems.empty()
                                                            ? fmt::format("{} is not a Tactoscope session", *path)
                                                            : report->problems.front()});
    }
    if (parser.isSet("json")) {
        printJson(toJson(*report));
    } else {
        say("{}: {}\n", *path, nameOf(report->status));
        for (const auto& note : report->notes) say("  {}\n", note);
        for (const auto& problem : report->problems) say("  {}\n", problem);
        say("  {} rows, {} trials, {} captures, {} samples\n  chain head {}\n", report->rows, report->trials,
            report->captures, report->samples, report->head);
    }
    return report->status == SessionStatus::Intact && !reportChanged(*report) ? kDone : kVerdictFailed;
}

}  // namespace

const Command kVerify{"verify", "{SESSION | STUDY} [--json]",
                      "Whether a session or study is what was recorded: integrity and hash chains", declareVerify,
                      runVerify};

}  // namespace tacto::cli
