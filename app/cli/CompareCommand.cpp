#include <array>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/Verdicts.h"
#include "app/report/CompareSessions.h"
#include "core/session/SessionReader.h"

namespace tacto::cli {

namespace {

void declareCompare(QCommandLineParser& parser) { parser.addOption({"json", "Prints one JSON value."}); }

int runCompare(const QCommandLineParser& parser) {
    const auto paths = parser.positionalArguments();
    if (paths.size() != 2)
        return usage(fmt::format("compare: two sessions were expected, A and B; given: {}", paths.size()));
    std::array<ComparedSession, 2> both;
    for (std::size_t s = 0; s < 2; ++s) {
        const auto reader = SessionReader::open(paths[qsizetype(s)].toStdString());
        if (!reader) return couldNotRun(reader.error());
        auto read = readForComparison(*reader);
        if (!read) return couldNotRun(read.error());
        both[s] = std::move(*read);
    }
    const auto compared = toJson(compareTwo(both[0], both[1]));
    if (parser.isSet("json")) {
        printJson(compared);
    } else {
        say("A: {}\nB: {}\n", paths[0].toStdString(), paths[1].toStdString());
        printTables("comparison", compared);
    }
    return kDone;
}

}  // namespace

const Command kCompare{"compare", "SESSION SESSION [--json]",
                       "How two sessions differ: settings, then quantities with the uncertainty of their difference",
                       declareCompare, runCompare};

}  // namespace tacto::cli
