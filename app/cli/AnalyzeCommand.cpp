#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "core/analysis/calibration/CalibrationFile.h"
#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/separability/SeparabilityJson.h"
#include "core/analysis/separability/TrialFile.h"

namespace tacto::cli {

namespace {

void declareAnalyze(QCommandLineParser& parser) { parser.addOption({"json", "Prints one JSON value."}); }

int separability(const std::string& file, bool asJson) {
    const auto trials = readSeparabilityTrials(file);
    if (!trials) return couldNotRun(trials.error());
    const auto found = judgeSeparability(*trials);
    if (!found) return couldNotRun(found.error());
    const auto result = toJson(*found);
    if (asJson) {
        printJson(result);
    } else {
        printSeparability(result);
        printVerdict(nameOf(found->verdict), found->reasons);
    }
    return exitForVerdict(nameOf(found->verdict));
}

/// Neither a tolerance nor what the instrument may contribute was stated, so nothing is judged.
int calibration(const std::string& file, bool asJson) {
    const auto readings = readCalibrationReadings(file);
    if (!readings) return couldNotRun(readings.error());
    const auto found = fitCalibration(*readings);
    if (!found) return couldNotRun(Error{found.error().code, fmt::format("{}: {}", file, found.error().message)});
    if (asJson) {
        printJson(toJson(*found));
        return kDone;
    }
    TextTable table({">commanded", ">n", ">mean", ">residual", ">down - up"});
    for (const auto& level : found->levels) {
        const double turned = level.meanDown - level.meanUp;
        table.add({fmt::format("{:.6g}", level.commanded), fmt::to_string(level.n), fmt::format("{:.6g}", level.mean),
                   fmt::format("{:.3g}", level.residual), std::isnan(turned) ? "–" : fmt::format("{:.3g}", turned)});
    }
    table.print();
    const auto percent = [](double value) { return std::isnan(value) ? "not known" : fmt::format("{:.4g} %", value); };
    say("\n  gain              {:.7g} ± {:.2g} (standard error{})\n", found->gain, found->gainStandardError,
        found->weighted ? ", weighted fit" : "");
    say("  offset            {:.5g} ± {:.2g}\n", found->offset, found->offsetStandardError);
    say("  in % of the largest command, {:.6g}:\n", found->fullScale);
    say("  largest residual  {}\n", percent(found->residualMax_pct));
    say("  repeatability     {}\n", percent(found->repeatability_pct));
    say("  hysteresis        {}\n", percent(found->hysteresis_pct));
    for (const auto& warning : found->warnings) say("  note: {}\n", warning);
    return kDone;
}

int runAnalyze(const QCommandLineParser& parser) {
    const auto given = parser.positionalArguments();
    if (given.size() != 2)
        return usage("analyze: a kind and a CSV file are expected, as in analyze separability trials.csv");
    const auto kind = given.front().toStdString();
    const auto file = given.at(1).toStdString();
    if (kind == "calibration") return calibration(file, parser.isSet("json"));
    if (kind == "separability") return separability(file, parser.isSet("json"));
    return usage(
        fmt::format("analyze: \"{}\" cannot be analysed by this version; calibration and separability can", kind));
}

}  // namespace

const Command kAnalyze{"analyze",
                       "{calibration|separability} FILE.csv [--json]",
                       "Commanded against measured values, or whether measured trials can be told apart",
                       false,
                       declareAnalyze,
                       runAnalyze};

}  // namespace tacto::cli
