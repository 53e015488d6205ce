// export: a session or a study as files for others to read; a study without codes and dates.
#include <algorithm>

#include "app/cli/Command.h"
#include "app/cli/ProgressBar.h"
#include "app/cli/StudyPassphrase.h"
#include "app/run/SignalStop.h"
#include "core/base/ProgramVersion.h"
#include "core/exchange/Export.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto::cli {

namespace {

std::string formatNames() {
    std::string names;
    for (const auto* format : exportFormats()) names += fmt::format("{}{}", names.empty() ? "" : ", ", format->name);
    return names;
}

void declareExport(QCommandLineParser& parser) {
    parser.addOptions(
        {{"format",
          QString::fromStdString("Of a session: " + formatNames() +
                                 ". Of a study: bids, a dataset of behavioural files."),
          "FORMAT"},
         {"out", "A new file or folder; of a study, a new or empty folder outside it.", "PATH"},
         {"json", "Prints one JSON value."},
         {"with",
          "What else is exported of a participant: age (as a range), sex, handedness; commas between. Withheld where "
          "fewer than three people share it.",
          "LIST"}});
    declarePassphrase(parser);
}

int exportOne(const QCommandLineParser& parser, const std::string& session) {
    const auto name = parser.value("format").toStdString();
    const auto* format = exportFormat(name);
    if (format == nullptr)
        return usage(fmt::format("export: --format is \"{}\"; {} are accepted", name, formatNames()));
    if (parser.isSet("with")) return usage("export: --with is for a study; " + session + " is none");
    SignalStop interrupts;
    const auto done = [&] {
        ProgressBar bar("exporting");
        return exportSession(
            session, *format, parser.value("out").toStdString(), TACTOSCOPE_VERSION,
            {.stopped = [&] { return interrupts.signalled(); }, .progress = [&](double share) { bar.show(share); }});
    }();
    if (!done) return done.error().code == ErrorCode::Stopped ? failWith(done.error()) : couldNotRun(done.error());
    if (parser.isSet("json"))
        printJson(toJson(*done));
    else
        say("{}\n", done->out.string());
    for (const auto& each : done->leftOut) say(stderr, "tactoscope-cli: left out: {}: {}\n", each.what, each.why);
    if (!done->damaged) return kDone;
    say(stderr, "tactoscope-cli: DAMAGED: {} is not what was recorded, and its export says so: {}\n", session,
        fmt::join(done->problems, "; "));
    return kVerdictFailed;
}

int runExport(const QCommandLineParser& parser) {
    const auto folder = onlyArgument(parser, "SESSION or STUDY");
    if (!folder) return usage(fmt::format("export: {}", folder.error().message));
    if (!parser.isSet("out")) return usage("export: --out is missing");
    if (std::error_code error; !std::filesystem::exists(*folder, error))
        return couldNotRun({ErrorCode::NotFound, fmt::format("there is no session and no study {}", *folder)});
    if (!Study::isThere(*folder)) return exportOne(parser, *folder);
    if (const auto format = parser.value("format").toStdString(); !format.empty() && format != "bids")
        return usage(fmt::format("export: --format is \"{}\"; of a study, bids is accepted", format));
    if (parser.isSet("json")) return usage("export: --json is for a session; " + *folder + " is a study");
    BidsWith with;
    if (parser.isSet("with")) {
        const auto named = bidsWithFrom(parser.value("with").toStdString());
        if (!named) return usage(fmt::format("export: --with: {}", named.error().message));
        with = *named;
    }
    const std::filesystem::path out = parser.value("out").toStdString();
    auto study = openStudy(parser, *folder, Study::Access::Change);
    if (!study) return couldNotRun(study.error());
    if (const auto done = exportBids(*study, with, out, programVersion().version); !done)
        return couldNotRun(done.error());
    if (const auto about = sharedAbout(*study, with); !about.withheld.empty()) say(stderr, "{}.\n", about.withheld);
    say("{}\n", out.string());
    return kDone;
}

}  // namespace

const Command kExport{"export",
                      "{SESSION --format FORMAT --out PATH [--json] | "
                      "STUDY --format bids --out DIR [--with LIST] [--passphrase-file F]}",
                      "A session as files for other programs; a study's results without codes and dates, as BIDS",
                      declareExport, runExport};

}  // namespace tacto::cli
