// export: a study as files for others to read, without codes and dates.
#include "app/cli/Command.h"
#include "app/cli/StudyPassphrase.h"
#include "core/sharing/results/StudyResults.h"

namespace tacto::cli {

namespace {

void declareExport(QCommandLineParser& parser) {
    parser.addOptions(
        {{"format", "bids: a BIDS dataset of behavioural files.", "bids"},
         {"out", "A new or empty folder outside the study.", "DIR"},
         {"with",
          "What else is exported of a participant: age (as a range), sex, handedness; commas between. Withheld where "
          "fewer than three people share it.",
          "LIST"}});
    declarePassphrase(parser);
}

int runExport(const QCommandLineParser& parser) {
    const auto folder = onlyArgument(parser, "STUDY");
    if (!folder) return usage(fmt::format("export: {}", folder.error().message));
    if (!parser.isSet("out")) return usage("export: --out is missing");
    if (const auto format = parser.value("format").toStdString(); format != "bids")
        return usage(fmt::format("export: --format is \"{}\"; bids is accepted", format));
    BidsWith with;
    if (parser.isSet("with")) {
        const auto named = bidsWithFrom(parser.value("with").toStdString());
        if (!named) return usage(fmt::format("export: --with: {}", named.error().message));
        with = *named;
    }
    const std::filesystem::path out = parser.value("out").toStdString();
    auto study = openStudy(parser, *folder, Study::Access::Change);
    if (!study) return couldNotRun(study.error());
    if (const auto done = exportBids(*study, with, out, TACTOSCOPE_VERSION); !done) return couldNotRun(done.error());
    if (const auto about = sharedAbout(*study, with); !about.withheld.empty()) say(stderr, "{}.\n", about.withheld);
    say("{}\n", out.string());
    return kDone;
}

}  // namespace

const Command kExport{"export", "STUDY --format bids --out DIR [--with LIST] [--passphrase-file F]",
                      "The results of a study without codes and dates, as a BIDS dataset", declareExport, runExport};

}  // namespace tacto::cli
