#include <algorithm>
#include <filesystem>

#include "app/cli/Command.h"
#include "app/cli/StudyPassphrase.h"
#include "app/report/PilotFigures.h"
#include "app/report/Report.h"
#include "app/report/StudyReport.h"
#include "core/pilot/StudyWords.h"
#include "core/study/StudyFiles.h"

namespace tacto::cli {

namespace {

void declareReport(QCommandLineParser& parser) {
    parser.addOptions(
        {{"out", "The report to write; its ending says which kind: .pdf or .html. For a session also several times.",
          "report.pdf"},
         {"figures", "For a study: each figure as an SVG file in this new or empty folder, in place of a report.",
          "DIR"},
         {"participant", "For a study: one page in plain words for the participant with that code.", "CODE"},
         {"for", "For a study: study (the default; names codes) or committee (names none).", "READER"},
         {"noted", "For a study: the program that has it open noted the report in its ledger."}});
    declarePassphrase(parser);
}

Result<ReportContent> contentFor(const QCommandLineParser& parser, const std::string& folder,
                                 const StudyRecord& record) {
    if (parser.isSet("participant")) return participantReport(record, parser.value("participant").toStdString());
    if (parser.value("for") == "committee") return committeeReport(record, languagesOf(folder));
    return studyReport(record);
}

/// Returns the ledger's name for a report that names participants; null for the committee's report, which names none.
const char* namedReport(const QCommandLineParser& parser) {
    if (parser.isSet("figures")) return "figures";
    if (parser.isSet("participant")) return "participant report";
    return parser.value("for") == "committee" ? nullptr : "study report";
}

/// Results are sealed, so a reader must give the passphrase like a writer.
Result<Study> openSealed(const QCommandLineParser& parser, const std::string& folder, bool notes) {
    if (notes) return openStudy(parser, folder, Study::Access::Change);
    auto study = openStudy(parser, folder, Study::Access::Read);
    if (!study || study->hasKey()) return study;
    const auto passphrase = passphraseFor(parser, folder);
    if (!passphrase) return failure(passphrase);
    return Study::open(folder, &*passphrase, Study::Access::Read);
}

bool isNoted(const Study& study, const std::filesystem::path& place, std::string_view what) {
    return std::ranges::any_of(
        study.exports(), [&](const StudyExport& each) { return each.place == place.string() && each.what == what; });
}

int reportStudy(const QCommandLineParser& parser, const std::string& folder) {
    const auto reader = parser.value("for").toStdString();
    if (!reader.empty() && reader != "study" && reader != "committee")
        return usage(fmt::format("report: --for is \"{}\"; study or committee is accepted", reader));
    if (!reader.empty() && parser.isSet("participant"))
        return usage("report: --for and --participant name two reports; one of them is accepted");
    const bool figures = parser.isSet("figures");
    if (parser.values("out").size() > 1)
        return usage("report: --out is given more than once; a study's report is one file");
    if (figures && (parser.isSet("out") || parser.isSet("participant") || !reader.empty()))
        return usage(
            "report: --figures writes figures in place of a report; no --out, --for or --participant is "
            "accepted beside it");
    const auto out = parser.value(figures ? "figures" : "out").toStdString();
    if (liesInside(out, folder)) {
        return couldNotRun(Error{ErrorCode::InvalidArgument,
                                 fmt::format("{} lies inside the study folder; a report there would stand unsealed "
                                             "beside what is sealed",
                                             out)});
    }
    const auto* const what = namedReport(parser);
    const bool notes = what != nullptr && !parser.isSet("noted");
    const auto place = std::filesystem::absolute(out);
    std::error_code error;
    if (figures) {
        if (const auto free = checkBidsFolder(place); !free) return couldNotRun(free.error());
    }
    if (notes && !figures && !std::filesystem::is_directory(place.parent_path(), error)) {
        return couldNotRun(Error{ErrorCode::NotFound, fmt::format("{} is not a folder that a report can be written to",
                                                                  place.parent_path().string())});
    }
    auto study = openSealed(parser, folder, notes);
    if (!study) return couldNotRun(study.error());
    if (what != nullptr && !notes && !isNoted(*study, place, what)) {
        return usage(
            fmt::format("report: --noted, and the study notes no {} in {}; leave --noted out", what, place.string()));
    }
    auto record = readStudyRecord(*study);
    if (!record) return couldNotRun(record.error());
    if (figures) leaveOutUnfinished(*record);
    const auto drawn = figures ? pilotFigures(*record) : Result<std::vector<PilotFigure>>();
    if (!drawn) return couldNotRun(drawn.error());
    const auto content = figures ? Result<ReportContent>() : contentFor(parser, folder, *record);
    if (!content) return couldNotRun(content.error());
    if (notes) {
        const auto noted = study->exported(place, what);
        if (!noted) return couldNotRun(noted.error());
    }
    const auto written = figures ? writeFigures(*drawn, place) : writeContent(*content, parser.value("out"));
    if (!written) return couldNotRun(written.error());
    say("{}\n", out);
    return kDone;
}

int runReport(const QCommandLineParser& parser) {
    const auto session = onlyArgument(parser, "SESSION");
    if (!session) return usage(fmt::format("report: {}", session.error().message));
    if (parser.isSet("figures") && !Study::isThere(*session))
        return usage("report: --figures is for a study; " + *session + " is none");
    if (!parser.isSet("figures")) {
        if (!parser.isSet("out")) return usage("report: --out is missing");
        for (const auto& out : parser.values("out"))
            if (const auto format = reportFormat(out); !format) return usage("report: " + format.error().message);
    }
    if (Study::isThere(*session)) return reportStudy(parser, *session);
    const auto made = writeSessionReport(QString::fromStdString(*session), parser.values("out"));
    if (!made) {
        auto error = made.error();
        // Error messages of the database do not name the file.
        const auto names = [&](const QString& file) {
            return error.message.find(file.toStdString()) != std::string::npos;
        };
        if (!names(QString::fromStdString(*session)) && std::ranges::none_of(parser.values("out"), names)) {
            error.message = fmt::format("{}: {}", *session, error.message);
        }
        return couldNotRun(error);
    }
    for (const auto& out : parser.values("out")) say("{}\n", out.toStdString());
    if (made->isEmpty()) return kDone;
    say(stderr, "tactoscope-cli: DAMAGED: {} is not what was recorded, and every page of its report says so: {}\n",
        *session, made->join("; ").toStdString());
    return kVerdictFailed;
}

}  // namespace

const Command kReport{"report", kReportArguments, kReportSummary, declareReport, runReport};

}  // namespace tacto::cli
