#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/cli/CaptureOptions.h"
#include "app/cli/Command.h"
#include "app/cli/TextTable.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/QuantityText.h"
#include "core/dsp/RoughnessAnalysis.h"
#include "core/exchange/recordings/OpenRecording.h"

namespace tacto::cli {

namespace {

void declareRoughness(QCommandLineParser& parser) {
    parser.addOption({"profile", "Profile to use instead of the shipped one.", "F"});
    parser.addOption({"out", "Writes one row per frame to this CSV file.", "frames.csv"});
    parser.addOption({"json", "Prints one JSON value."});
    parser.addOption({"template", "Prints a recording.json to fill in."});
}

void addRow(TextTable& table, const char* name, const Statistics& s) {
    std::vector<std::string> cells{name};
    if (s.n == 0) cells.emplace_back("–");
    for (const double value : {s.mean, s.sd, s.min, s.max}) {
        if (s.n != 0) cells.push_back(fmt::format("{:.4g}", value));
    }
    if (s.n != 0) cells.push_back(fmt::format("{}", s.n));
    table.add(std::move(cells));
}

/// True if `out` is one of the recording's own files.
bool isOf(const Recording& recording, const std::filesystem::path& out) {
    std::error_code absent;
    if (std::filesystem::equivalent(recording.path, out, absent)) return true;
    return std::any_of(recording.streams.begin(), recording.streams.end(), [&](const RecordedStream& stream) {
        return std::filesystem::equivalent(stream.file, out, absent);
    });
}

/// Returns the expanded uncertainty of roughness R for the whole recording as one slide; NaN: not known.
double expandedR(const RoughnessSettings& settings, const RoughnessSummary& summary) {
    const bool calibrated =
        std::ranges::find(summary.flags, nameOf(RoughnessFlag::UncalibratedR)) == summary.flags.end();
    return calibrated && settings.uncertainty ? settings.uncertainty->expanded(summary.slideR) : std::nan("");
}

/// Prints only a recording.json for the table on stdout; says on stderr what must still be filled in.
int describeTable(const std::filesystem::path& table) {
    const auto draft = draftAnyRecording(table);
    if (!draft) return couldNotRun(draft.error());
    say("{}", lines(draft->json));
    say(stderr, "{} has no recording.json that names it; this one fits it.\n", table.string());
    for (const auto& taken : draft->taken) say(stderr, "  {}\n", taken);
    for (const auto& open : draft->open) say(stderr, "  to fill in: {}\n", open);
    say(stderr, "  {}saved as recording.json in its folder, it opens with \"tactoscope-cli roughness {}\"\n",
        draft->open.empty() ? "" : "filled in and ", table.string());
    return kDone;
}

int runRoughness(const QCommandLineParser& parser) {
    if (parser.isSet("template")) {
        say("{}", lines(recordingTemplate()));
        return kDone;
    }
    const auto path = onlyArgument(parser, "RECORDING");
    if (!path) return usage(fmt::format("roughness: {}", path.error().message));
    const auto recording = openRecording(*path);
    std::error_code absent;
    if (!recording && recording.error().code == ErrorCode::NotFound &&
        std::filesystem::is_regular_file(*path, absent) && std::filesystem::path(*path).extension() != ".json" &&
        descriptionBeside(*path).empty())
        return describeTable(*path);
    if (!recording) return couldNotRun(recording.error());
    for (const auto& warning : recording->warnings) say(stderr, "{}\n", warning);
    const auto profile = profileOption(parser);
    if (!profile) return couldNotRun(profile.error());
    const auto out = parser.value("out").toStdString();
    if (!out.empty() && isOf(*recording, out)) {
        return usage(fmt::format("roughness: --out {} is a file of the recording itself; another is expected", out));
    }
    const auto found = analyseRoughness(recording->infos(), recording->blocks(), profile->roughness,
                                        recording->declared, recording->fingertip);
    if (!found) return couldNotRun(found.error());
    const auto& summary = found->summary;
    const double uncertainty = expandedR(profile->roughness, summary);
    if (parser.isSet("out")) {
        if (const auto written = writeFile(out, framesCsv(found->frames)); !written) {
            return failWith(written.error());
        }
    }
    if (parser.isSet("json")) {
        printJson({{"frames", summary.frames},
                   {"contact_frames", summary.contactFrames},
                   {"rate_hz", numberOrNull(summary.rate_hz)},
                   {"flags", summary.flags},
                   {"simulated", recording->simulated ? nlohmann::json(*recording->simulated) : nlohmann::json()},
                   {"known_limit", kKnownLimitOfR},
                   {"h", toJson(summary.h)},
                   {"v", toJson(summary.v)},
                   {"R", toJson(summary.R)},
                   {"R_slide", numberOrNull(summary.slideR)},
                   {"R_expanded_uncertainty", numberOrNull(uncertainty)},
                   {"pressure_pa", toJson(summary.pressure_pa)},
                   {"P", toJson(summary.P)}});
        return kDone;
    }
    if (recording->simulated.value_or(false)) say("SIMULATED: no number here was measured on hardware.\n");
    say("{}\n{} frames, {} in contact, at {:.6g} Hz\n", recording->title, summary.frames, summary.contactFrames,
        summary.rate_hz);
    TextTable table({"", ">mean", ">sd", ">min", ">max", ">n", ""});
    addRow(table, "h", summary.h);
    addRow(table, "v", summary.v);
    addRow(table, "R", summary.R);
    if (std::isfinite(summary.slideR)) {
        const bool known = std::isfinite(uncertainty);
        table.add({"R of the slide", measuredText(summary.slideR, known ? uncertainty : 0, ""), "", "", "", "",
                   known ? "95 %, of the features' means" : "of the features' means; U not known"});
    }
    addRow(table, "pressure Pa", summary.pressure_pa);
    addRow(table, "P", summary.P);
    table.print();
    if (!summary.flags.empty()) {
        say("\n");
        for (const auto& flag : summary.flags) say("{}\n", flagSentence(flag));
    }
    say("\n{}\n", kKnownLimitOfR);
    return kDone;
}

}  // namespace

const Command kRoughness{"roughness", "{RECORDING [--profile F] [--out frames.csv] [--json] | TABLE | --template}",
                         "Roughness R and pressure P of a fingertip recording; a recording.json for a table",
                         declareRoughness, runRoughness};

}  // namespace tacto::cli
