#include "app/cli/Command.h"
#include "app/report/Report.h"

namespace tacto::cli {

namespace {

void declareReport(QCommandLineParser& parser) {
    parser.addOption({"out", "The report to write; its ending says which kind: .pdf or .html.", "report.pdf"});
}

int runReport(const QCommandLineParser& parser) {
    const auto session = onlyArgument(parser, "SESSION");
    if (!session) return usage(fmt::format("report: {}", session.error().message));
    if (!parser.isSet("out")) return usage("report: --out is missing");
    const auto format = reportFormat(parser.value("out"));
    if (!format) return usage("report: " + format.error().message);
    const auto made = writeSessionReport(QString::fromStdString(*session), parser.value("out"));
    if (!made) {
        auto error = made.error();
        // The database's own words name no file.
        if (error.message.find(*session) == std::string::npos &&
            error.message.find(parser.value("out").toStdString()) == std::string::npos) {
            error.message = fmt::format("{}: {}", *session, error.message);
        }
        return couldNotRun(error);
    }
    say("{}\n", parser.value("out").toStdString());
    if (made->isEmpty()) return kDone;
    say(stderr, "tactoscope-cli: DAMAGED: {} is not what was recorded, and every page of its report says so: {}\n",
        *session, made->join("; ").toStdString());
    return kVerdictFailed;
}

}  // namespace

const Command kReport{
    "report", "SESSION --out report.pdf", "The report of a session, as PDF or HTML", true, declareReport, runReport};

}  // namespace tacto::cli
