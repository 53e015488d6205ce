#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/Verdicts.h"
#include "core/analysis/ResultJson.h"
#include "core/analysis/TrialFile.h"

namespace tacto::cli {

namespace {

void declare(QCommandLineParser& parser) { parser.addOption({"json", "Prints one JSON value."}); }

int run(const QCommandLineParser& parser) {
    const auto given = parser.positionalArguments();
    if (given.size() != 2)
        return usage("analyze: a kind and a CSV file are expected, as in analyze separability trials.csv");
    const auto kind = given.front().toStdString();
    if (kind != "separability") {
        return usage(fmt::format("analyze: \"{}\" cannot be analysed by this version; separability can", kind));
    }
    const auto trials = readSeparabilityTrials(given.at(1).toStdString());
    if (!trials) return couldNotRun(trials.error());
    const auto found = judgeSeparability(*trials);
    if (!found) return couldNotRun(found.error());
    const auto result = toJson(*found);
    if (parser.isSet("json")) {
        printJson(result);
    } else {
        printSeparability(result);
        printVerdict(nameOf(found->verdict), found->reasons);
    }
    return exitForVerdict(nameOf(found->verdict));
}

}  // namespace

const Command kAnalyze{"analyze",
                       "separability FILE.csv [--json]",
                       "Whether measured trials (condition,amplitude,interval) can be told apart",
                       false,
                       declare,
                       run};

}  // namespace tacto::cli
