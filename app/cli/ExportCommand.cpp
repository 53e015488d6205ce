// export: a session or a study as files for others to read; a study without codes and dates.
#include <algorithm>

#include "app/cli/Command.h"
#include "app/cli/ProgressBar.h"
#include "app/cli/StudyPassphrase.h"
#include "app/run/RunFiles.h"
#include "app/run/SignalStop.h"
#include "core/base/ProgramVersion.h"
#include "core/calibration/CalibrationStore.h"
#include "core/exchange/Export.h"
#include "core/session/SessionReader.h"
#include "core/sharing/results/StudyResults.h"
#include "core/study/StudyFiles.h"

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
                                 "; dcc of a stimulator's calibration, as digital certificate. Of a study: bids, a "
                                 "dataset of behavioural files."),
          "FORMAT"},
         {"out", "A new file or folder; of a study, a new or empty folder outside it.", "PATH"},
         {"json", "Prints one JSON value."},
         {"with",
          "What else is exported of a participant: age (as a range), sex, handedness; commas between. Withheld where "
          "fewer than three people share it.",
          "LIST"}});
    declarePassphrase(parser);
}

/// The study that a session file belongs to, given without links; empty if it belongs to none.
std::filesystem::path studyOf(const std::filesystem::path& session) {
    const auto folder = session.parent_path().parent_path();
    return Study::isThere(folder) ? folder : std::filesystem::path();
}

struct OpenedSeal {
    std::shared_ptr<const RowSeal> seal;
    std::string code;
};
/// Opens the seal of a study's session, and notes in the ledger that it leaves the study. Errors: as openStudy() and
/// Study::part(); InvalidArgument for a place inside the study; Unsupported for data that may not leave it.
Result<OpenedSeal> sealFor(const QCommandLineParser& parser, const std::filesystem::path& given,
                           const std::filesystem::path& out) {
    std::error_code error;
    auto session = std::filesystem::weakly_canonical(given, error);
    if (error) session = std::filesystem::absolute(given);
    const auto folder = studyOf(session);
    if (folder.empty()) return OpenedSeal{};
    const auto place = std::filesystem::absolute(out);
    if (liesInside(place, folder))
        return invalid("{} lies inside the study folder; an export there would stand unsealed beside what is sealed",
                       out.string());
    auto study = openStudy(parser, folder, Study::Access::Change);
    if (!study) return failure(study);
    const auto file = session.stem().string();
    auto seal = study->sealOf(file);
    if (!seal) return failure(seal);
    std::string code;
    if (const auto whole = study->part(file); !whole) return failure(whole);
    for (const auto& each : study->sessions()) {
        if (std::ranges::find(each.parts, file, &StudyPart::file) == each.parts.end()) continue;
        if (each.state == StudySessionState::Unfinished)
            return fail(ErrorCode::Unsupported, "session {} may still go on; one that has ended is expected", file);
        code = each.code;
        for (const auto& participant : study->participants()) {
            if (participant.id == each.participant && !mayBeShared(participant, true))
                return fail(ErrorCode::Unsupported, "the participant of session {} did not consent, or withdrew", file);
        }
    }
    if (const auto noted = study->exported(place, "session"); !noted) return failure(noted);
    return OpenedSeal{std::move(*seal), std::move(code)};
}

int exportOne(const QCommandLineParser& parser, const std::string& session) {
    const auto name = parser.value("format").toStdString();
    const auto* format = exportFormat(name);
    if (format == nullptr)
        return usage(
            fmt::format("export: --format is \"{}\"; {} are accepted, and dcc of a calibration", name, formatNames()));
    if (parser.isSet("with")) return usage("export: --with is for a study; " + session + " is none");
    const std::filesystem::path out = parser.value("out").toStdString();
    {
        SignalStop interrupts;  // only while the place is tried: a passphrase may be asked for next
        if (const auto free = ExportTarget::begin(out, format->kind()); !free) return couldNotRun(free.error());
        if (interrupts.signalled()) return failWith({ErrorCode::Stopped, "cancelled; nothing was written"});
    }
    auto seal = sealFor(parser, session, out);
    if (!seal) return couldNotRun(seal.error());
    SignalStop interrupts;
    const auto done = [&] {
        ProgressBar bar("exporting");
        return exportSession(
            session, *format, out, programVersion().version,
            {.stopped = [&] { return interrupts.signalled(); }, .progress = [&](double share) { bar.show(share); }},
            seal->seal, seal->code);
    }();
    if (!done) return done.error().code == ErrorCode::Stopped ? failWith(done.error()) : couldNotRun(done.error());
    if (parser.isSet("json"))
        printJson(toJson(*done));
    else
        say("{}\n", done->out.string());
    for (const auto& each : done->leftOut) say(stderr, "tactoscope-cli: left out: {}: {}\n", each.what, each.why);
    if (!done->damaged) return kDone;
    const auto& first = done->problems.front();
    say(stderr,
        "tactoscope-cli: DAMAGED: {} is not what was recorded, and its export says so: {}; `verify` says more\n",
        session, first.substr(0, first.find('\n')));
    return kVerdictFailed;
}

/// The session with the readings of the newest calibration that is stored for a stimulator. Errors: as
/// CalibrationStore::open(); NotFound if none is stored, or the session is not where runs put theirs.
Result<std::string> sessionOfCalibration(const std::string& serial) {
    const auto store = CalibrationStore::open(calibrationFile());
    if (!store) return failure(store);
    const StoredCalibration* newest = nullptr;
    for (const auto& each : store->all())
        if (each.serial == serial && (newest == nullptr || each.made >= newest->made)) newest = &each;
    if (newest == nullptr)
        return fail(ErrorCode::NotFound, "there is no session {}, and no calibration of a stimulator {} is stored",
                    serial, serial);
    const auto path = userSessionsFolder() / newest->session;
    if (std::error_code error; !std::filesystem::exists(path, error))
        return fail(ErrorCode::NotFound,
                    "the calibration of {} of {} is in the session {}, which is not in {}; its path is expected",
                    serial, dateText(newest->made), newest->session, userSessionsFolder().string());
    return path.string();
}

int runExport(const QCommandLineParser& parser) {
    auto folder = onlyArgument(parser, "SESSION or STUDY");
    if (!folder) return usage(fmt::format("export: {}", folder.error().message));
    if (!parser.isSet("out")) return usage("export: --out is missing");
    if (std::error_code error; !std::filesystem::exists(*folder, error)) {
        if (parser.value("format") != QLatin1String("dcc"))
            return couldNotRun({ErrorCode::NotFound, fmt::format("there is no session and no study {}", *folder)});
        folder = sessionOfCalibration(*folder);
        if (!folder) return couldNotRun(folder.error());
    }
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

const Command kExport{
    "export",
    "{SESSION --format FORMAT --out PATH [--passphrase-file F] [--json] | "
    "SESSION --format dcc --out FILE [--json] | "
    "SERIAL --format dcc --out FILE [--json] | "
    "STUDY --format bids --out DIR [--with LIST] [--passphrase-file F]}",
    "A session as files for other programs, a calibration as digital certificate; a study's results as BIDS",
    declareExport, runExport};

}  // namespace tacto::cli
