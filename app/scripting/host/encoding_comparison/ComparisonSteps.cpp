// The object "bench.encodingComparison", the steps of the encoding comparison: the functions for scripts and what each
// does.
#include <algorithm>
#include <cmath>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/analysis/RunAnalysis.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "core/analysis/encodings/ComparedEncodings.h"
#include "core/base/JsonText.h"

namespace tacto {

namespace host::encoding_comparison {

namespace {

using Json = nlohmann::json;

/// The state of a comparison. The first encoding is the default; the others are compared with it.
struct Comparison {
    double low = 0, high = 0, load_ohm = 0, load_pct = 0, traverse_s = 0;
    Json reference = {};
    std::vector<ComparedEncoding> encodings = {};
};

Json resultsOf(const Comparison& run, const ComparedEncodings& compared) {
    Json results = toJson(compared);
    results["reference"] = run.reference;
    return results;
}

std::vector<std::string> namesOf(const std::vector<ComparedPlace>& places) {
    std::vector<std::string> names;
    for (const auto& place : places) names.push_back(place.name);
    return names;
}

Json listOf(const std::vector<ComparedPlace>& places) {
    Json out = Json::array();
    for (const auto& [name, R, P] : places) out.push_back({{"name", name}, {"roughness", R}, {"pressure", P}});
    return out;
}

std::string shownText(const Comparison& run, double asymmetry) {
    return fmt::format(
        "Both assignments were measured along three curves, and differ by no more than {} JND. Below is the default, "
        "texture to amplitude and pressure to interval; swapped, it comes out the same. Amplitude and interval are the "
        "smallest distances of pairs that differ in them, the worst pair is the smaller of the two; levels are "
        "neighbours in between. Conditions at R and P of {} and {}; at 0 and 1 all curves meet. Levels at R and P of "
        "{}; "
        "a train, at most: the largest step from train to train when a finger crosses the plane in {} s, computed, "
        "without limits on a step.",
        std::isnan(asymmetry) ? "?" : fmt::format("{:.2f}", std::max(kComparedAtLeast_jnd, asymmetry)), run.low,
        run.high, fmt::join(kComparedLevels, ", "), run.traverse_s);
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    Comparison first{.low = arguments.number("settings.low"),
                     .high = arguments.number("settings.high"),
                     .load_ohm = arguments.number("settings.load"),
                     .load_pct = arguments.number("settings.load_tolerance_pct"),
                     .traverse_s = arguments.number("settings.traverse_s")};
    const auto run = session.begin(arguments.object(), std::move(first));
    if (!run) return failure(run);
    if (auto said = session.reportText(symmetryOfEncodings(kNaN) + "."); !said) return failure(said);
    return Json{{"conditions", listOf(comparedConditions((*run)->low, (*run)->high))},
                {"levels", listOf(comparedLevels())}};
}

Result<Json> knownLoad(ScriptSession& session, const Arguments& arguments) {
    const auto run = session.begun<Comparison>(arguments.object());
    if (!run) return failure(run);
    auto known = bench::knownLoad(session, (*run)->load_ohm, (*run)->load_pct);
    if (!known) return known;
    session.bench().disarm();
    (*run)->reference = std::move(*known);
    return (*run)->reference["passed"];
}

Result<Json> add(ScriptSession& session, const Arguments& arguments) {
    const auto run = session.begun<Comparison>(arguments.object());
    if (!run) return failure(run);
    const auto computed = analysis::computedTransitions(session, arguments, 11, (*run)->traverse_s, true);
    if (!computed) return failure(computed);
    auto conditions = analysis::separabilityOf(arguments, arguments.list("trials"), namesOf(comparedConditions(0, 1)));
    if (!conditions) return failure(conditions);
    auto levels = analysis::separabilityOf(arguments, arguments.list("between"), namesOf(comparedLevels()));
    if (!levels) return failure(levels);
    (*run)->encodings.push_back(comparedEncoding(
        {arguments.text("encoding.name"), arguments.text("encoding.assignment"), arguments.text("encoding.curve")},
        std::move(*conditions), std::move(*levels), computed->report.gradual.largest(),
        computed->report.abrupt.largest()));
    session.keepPartial(resultsOf(**run, compareEncodings((*run)->encodings)), Json::array());
    return Json();
}

Result<Json> conclude(ScriptSession& session, const Arguments& arguments) {
    const auto run = session.begun<Comparison>(arguments.object());
    if (!run) return failure(run);
    const Json& reference = (*run)->reference;
    if (reference.is_null())
        return fail(ErrorCode::InvalidArgument, "{0}.conclude: {0}.knownLoad() is expected first", arguments.object());
    if (reference["passed"] != true || (*run)->encodings.empty()) {
        const auto why = textOr(reference, "reason");
        return resultsOf(**run, {.missing = {why + (why.empty() ? "" : "; ") + "nothing was compared"}});
    }
    const auto compared = compareEncodings((*run)->encodings);
    if (auto said = session.reportText(shownText(**run, compared.asymmetry_jnd)); !said) return failure(said);
    if (auto said = session.reportText(sameForAllEncodings(compared)); !said) return failure(said);
    return resultsOf(**run, compared);
}

}  // namespace

}  // namespace host::encoding_comparison

std::vector<HostFunction> encodingComparisonFunctions() {
    using namespace takes;
    return {
        {.name = "begin",
         .parameters = {object("settings", "the parameters of the run"),
                        number("settings.low", "", "R or P of a smooth or low condition").range(0, 1),
                        number("settings.high", "", "R or P of a rough or high condition").range(0, 1),
                        number("settings.load", "ohm", "that is connected").range(1, 1e6),
                        number("settings.load_tolerance_pct", "%", "within which it must read").range(0, 100),
                        number("settings.traverse_s", "s", "in which a finger crosses the plane").range(0.1, 600)},
         .text = "Begins the comparison, and says in the report what it cannot decide.",
         .returns = "{ conditions, levels }: two lists of { name, roughness, pressure }, to be presented under each "
                    "encoding.",
         .call = host::encoding_comparison::begin},
        {.name = "knownLoad",
         .text = "As bench.readKnownLoad(), and disarms.",
         .returns = "Whether it passed.",
         .errors = "As bench.readKnownLoad().",
         .asks = {kConfirmArming},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::encoding_comparison::knownLoad},
        {.name = "add",
         .parameters = {object("encoding", "that is in force"), text("encoding.name", "in the results"),
                        text("encoding.assignment", "as in a profile").oneOf({"texture_to_amplitude", "swapped"}),
                        text("encoding.curve", "of amplitude and interval").oneOf({"linear", "logarithmic", "power"}),
                        list("trials", "of the conditions, as analysis.separability() takes them"),
                        list("between", "the same of the levels")},
         .text =
             "Judges what was measured under an encoding. The first is the default that the others are compared with. "
             "Kept, in case the run ends early.",
         .errors = "As analysis.separability().",
         .call = host::encoding_comparison::add},
        {.name = "conclude",
         .text =
             "Compares the encodings in just-noticeable differences, and says in the report what is the same for all.",
         .returns = "What verdict() takes: no verdict unless something was not measured.",
         .call = host::encoding_comparison::conclude},
    };
}

}  // namespace tacto
