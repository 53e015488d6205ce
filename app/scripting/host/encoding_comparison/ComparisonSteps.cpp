// The object "bench.encodingComparison", the steps of the encoding comparison: the functions for scripts and what each
// does.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/analysis/RunAnalysis.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonText.h"
#include "core/base/JustNoticeable.h"

namespace tacto {

namespace host::encoding_comparison {

namespace {

using Json = nlohmann::json;

constexpr const char* kUsual = "texture_to_amplitude";
constexpr std::array kLevels{0.25, 0.5, 0.75};
constexpr double kAtLeast_jnd = 0.01;  // smaller differences are treated as none

struct Named {
    std::string name;
    double roughness, pressure;
};

/// The state of a comparison. The first encoding is the default; the others are compared with it.
struct Comparison {
    double low = 0, high = 0, load_ohm = 0, load_pct = 0, traverse_s = 0;
    Json reference = {};
    Json encodings = Json::array();
};

std::string levelName(double roughness, double pressure) { return fmt::format("R {} P {}", roughness, pressure); }

std::vector<Named> conditionsOf(double low, double high) {
    return {{"smooth-low", low, low}, {"smooth-high", low, high}, {"rough-low", high, low}, {"rough-high", high, high}};
}

std::vector<Named> levels() {
    std::vector<Named> out;
    for (const double roughness : kLevels) {
        for (const double pressure : kLevels) out.push_back({levelName(roughness, pressure), roughness, pressure});
    }
    return out;
}

std::vector<std::string> namesOf(const std::vector<Named>& places) {
    std::vector<std::string> names;
    for (const auto& place : places) names.push_back(place.name);
    return names;
}

Json listOf(const std::vector<Named>& places) {
    Json out = Json::array();
    for (const auto& [name, R, P] : places) out.push_back({{"name", name}, {"roughness", R}, {"pressure", P}});
    return out;
}

// NaN: a value was not measured, or does not exist.

double largest(const std::vector<double>& values) {
    double most = -std::numeric_limits<double>::infinity();
    for (const double value : values) {
        if (!std::isfinite(value)) return kNaN;
        most = std::max(most, value);
    }
    return std::isfinite(most) ? most : kNaN;
}

double smallest(std::vector<double> values) {
    for (double& value : values) value = -value;
    return -largest(values);
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return values.empty() ? kNaN : sum / static_cast<double>(values.size());
}

/// Returns the values of member `key` of all rows.
std::vector<double> columnOf(const Json& rows, const char* key) {
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(numberOr(row, key));
    return values;
}

double best(const Json& pair) { return largest({numberOr(pair, "amplitude_jnd"), numberOr(pair, "interval_jnd")}); }

/// Returns the smallest distance on one axis; pairs with the same level on it are left out.
double smallestApart(const Json& pairs, const char* key) {
    auto values = columnOf(pairs, key);
    std::erase_if(values, [](double value) { return value <= 1; });
    return smallest(values);
}

/// Neighbours differ by one level in roughness R or pressure P. Each pair counts on the axis that separates it best.
Json neighboursOf(const Json& pairs) {
    const auto between = [&pairs](const std::string& a, const std::string& b) {
        const auto pair = std::ranges::find_if(pairs, [&](const Json& row) {
            return (row["a"] == a && row["b"] == b) || (row["a"] == b && row["b"] == a);
        });
        return pair == pairs.end() ? kNaN : best(*pair);
    };
    std::vector<double> texture, pressure;
    for (std::size_t i = 0; i + 1 < kLevels.size(); ++i) {
        for (const double other : kLevels) {
            texture.push_back(between(levelName(kLevels[i], other), levelName(kLevels[i + 1], other)));
            pressure.push_back(between(levelName(other, kLevels[i]), levelName(other, kLevels[i + 1])));
        }
    }
    auto all = texture;
    all.insert(all.end(), pressure.begin(), pressure.end());
    return {{"texture_min_jnd", numberOrNull(smallest(texture))},
            {"texture_mean_jnd", numberOrNull(mean(texture))},
            {"pressure_min_jnd", numberOrNull(smallest(pressure))},
            {"pressure_mean_jnd", numberOrNull(mean(pressure))},
            {"min_jnd", numberOrNull(smallest(all))},
            {"mean_jnd", numberOrNull(mean(all))}};
}

/// Returns the difference of two values in just-noticeable differences; negative if the second is smaller.
double difference(const Json& from, const Json& to, const char* quantity) {
    const bool isAmplitude = std::string_view(quantity) == "amplitude";
    const char* key = isAmplitude ? "amplitude_v" : "interval_s";
    const double a = numberOr(from[key], "mean"), b = numberOr(to[key], "mean");
    const double size = justNoticeableDifferences(b, a, isAmplitude ? kAmplitudeWeberFraction : kIntervalWeberFraction);
    return b < a ? -size : size;
}

/// Returns the distances of a curve for one assignment. They are sorted by what a person feels (amplitude, interval),
/// not by the input that sets it.
std::array<double, 6> distancesOf(const Json& each) {
    const Json& n = each["neighbours"];
    const bool usual = each["assignment"] == kUsual;
    return {numberOr(each, "smallest_amplitude_jnd"),
            numberOr(each, "smallest_interval_jnd"),
            numberOr(each, "smallest_pair_jnd"),
            numberOr(n, usual ? "texture_min_jnd" : "pressure_min_jnd"),
            numberOr(n, usual ? "pressure_min_jnd" : "texture_min_jnd"),
            numberOr(each, "gradual_jnd")};
}

/// Returns how far the two assignments of a curve differ as measured, after smooth-high and rough-low are swapped: the
/// largest difference of all distances and conditions, in just-noticeable differences. NaN until both were measured.
double asymmetryOf(const Json& done) {
    std::vector<double> found;
    for (const auto& usual : done) {
        if (usual["assignment"] != kUsual) continue;
        const auto swapped = std::ranges::find_if(
            done, [&](const Json& each) { return each["assignment"] != kUsual && each["curve"] == usual["curve"]; });
        if (swapped == done.end()) continue;
        const auto a = distancesOf(usual), b = distancesOf(*swapped);
        for (std::size_t i = 0; i < a.size(); ++i) found.push_back(std::abs(a[i] - b[i]));
        constexpr std::array<std::size_t, 4> kThere{0, 2, 1, 3};
        for (std::size_t here = 0; here < kThere.size(); ++here) {
            for (const char* axis : {"amplitude", "interval"})
                found.push_back(
                    std::abs(difference(usual["conditions"][here], (*swapped)["conditions"][kThere[here]], axis)));
        }
    }
    return largest(found);
}

/// Compares with the default, signed: the changes of each condition's amplitude and interval, and of the distances.
Json differenceRow(const Json& each, const Json& base) {
    Json row = {{"encoding", each["name"]}};
    for (std::size_t i = 0; i < each["conditions"].size(); ++i) {
        const Json& condition = each["conditions"][i];
        for (const char* axis : {"amplitude", "interval"})
            row[fmt::format("{} {}_jnd", condition["name"].get<std::string>(), axis)] =
                numberOrNull(difference(base["conditions"][i], condition, axis));
    }
    const auto moved = [](const Json& to, const Json& from, const char* key) {
        return numberOrNull(numberOr(to, key) - numberOr(from, key));
    };
    row["pair_jnd"] = moved(each, base, "smallest_pair_jnd");
    row["neighbours_min_jnd"] = moved(each["neighbours"], base["neighbours"], "min_jnd");
    row["neighbours_mean_jnd"] = moved(each["neighbours"], base["neighbours"], "mean_jnd");
    row["per_train_jnd"] = moved(each, base, "gradual_jnd");
    return row;
}

/// Returns each condition under each encoding, with its change against the default.
Json conditionRows(const Json& done, const Json& differences) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < done.size(); ++i) {
        for (const auto& condition : done[i]["conditions"]) {
            Json row = {{"encoding", done[i]["name"]}};
            for (const char* key : {"amplitude_jnd", "interval_jnd"}) {
                if (i > 0)
                    row[key] = differences[i - 1][fmt::format("{} {}", condition["name"].get<std::string>(), key)];
            }
            row.update(condition);
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

/// Names all curves within a hundredth of the best, because a measurement cannot tell them apart.
template <class Key>
std::string bestOf(const std::vector<Json>& curves, const Key& key) {
    std::vector<double> values;
    for (const auto& each : curves) values.push_back(key(each));
    const double most = largest(values);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        if (values[i] > most - kAtLeast_jnd) names.push_back(curves[i]["curve"]);
    }
    return fmt::format("{} ({:.2f} JND)", fmt::join(names, " or "), std::abs(most));
}

std::string conclusionOf(const Json& done) {
    std::vector<Json> curves;
    for (const auto& each : done) {
        if (each["assignment"] == kUsual) curves.push_back(each);
    }
    const auto axis = [](std::size_t i) { return [i](const Json& each) { return distancesOf(each)[i]; }; };
    return fmt::format(
        "At constant Weber fractions the curve that keeps the conditions farthest apart is {}; neighbouring levels in "
        "amplitude {}, in interval {}; the one that moves least per train {}",
        bestOf(curves, axis(2)), bestOf(curves, axis(3)), bestOf(curves, axis(4)),
        bestOf(curves, [](const Json& each) { return -numberOr(each, "gradual_jnd"); }));
}

/// Returns what the figures show by themselves, and the limits of what they mean.
std::string symmetryOf(double asymmetry) {
    return fmt::format(
        "Swapping R and P is a symmetry of this metric: it exchanges smooth-high and rough-low, and texture and "
        "pressure, "
        "and leaves every distance as it is{}. No figure here can prefer one assignment; people decide which is told "
        "apart, natural or preferred",
        std::isnan(asymmetry) ? "" : fmt::format(" (measured: within {:.2f} JND)", std::max(kAtLeast_jnd, asymmetry)));
}

/// States once what is the same for all encodings.
std::string sameForAll(const Json& done) {
    const auto known = [](const Json& estimate, const char* key) {
        const double value = numberOr(estimate, key);
        return std::isnan(value) ? 0 : value;
    };
    double share = 1, least = 1;
    std::vector<std::string> verdicts;
    for (const auto& each : done) {
        share = std::min(share, known(each["accuracy"], "value"));
        least = std::min(least, known(each["accuracy"], "low"));
        const std::string verdict = each["separable"];
        if (std::ranges::find(verdicts, verdict) == verdicts.end()) verdicts.push_back(verdict);
    }
    return fmt::format(
        "Recognised trials: {:.1f} % or more under every encoding (95 % interval from {:.1f} %); "
        "separable by an oscilloscope: {}.",
        100 * share, 100 * least, fmt::join(verdicts, ", "));
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
        std::isnan(asymmetry) ? "?" : fmt::format("{:.2f}", std::max(kAtLeast_jnd, asymmetry)), run.low, run.high,
        fmt::join(kLevels, ", "), run.traverse_s);
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    Comparison first{.low = arguments.number("settings.low"),
                     .high = arguments.number("settings.high"),
                     .load_ohm = arguments.number("settings.load"),
                     .load_pct = arguments.number("settings.load_tolerance_pct"),
                     .traverse_s = arguments.number("settings.traverse_s")};
    const auto run = session.begin(arguments.object(), std::move(first));
    if (!run) return failure(run);
    if (auto said = session.reportText(symmetryOf(kNaN) + "."); !said) return failure(said);
    return Json{{"conditions", listOf(conditionsOf((*run)->low, (*run)->high))}, {"levels", listOf(levels())}};
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
    const auto sweep = analysis::computedTransitions(session, arguments, 11, (*run)->traverse_s, true);
    if (!sweep) return sweep;
    const auto found = analysis::separabilityOf(arguments, arguments.list("trials"), namesOf(conditionsOf(0, 1)));
    if (!found) return found;
    const auto between = analysis::separabilityOf(arguments, arguments.list("between"), namesOf(levels()));
    if (!between) return between;
    const Json &conditions = found->at("conditions"), &pairs = found->at("pairs");
    std::vector<double> bests;
    for (const auto& pair : pairs) bests.push_back(best(pair));
    (*run)->encodings.push_back(
        {{"name", arguments.text("encoding.name")},
         {"assignment", arguments.text("encoding.assignment")},
         {"curve", arguments.text("encoding.curve")},
         {"conditions", conditions},
         {"pairs", pairs},
         {"smallest_amplitude_jnd", numberOrNull(smallestApart(pairs, "amplitude_jnd"))},
         {"smallest_interval_jnd", numberOrNull(smallestApart(pairs, "interval_jnd"))},
         {"smallest_pair_jnd", numberOrNull(smallest(bests))},
         {"mahalanobis_min", numberOrNull(smallest(columnOf(pairs, "mahalanobis")))},
         {"amplitude_variation_max", numberOrNull(largest(columnOf(conditions, "amplitude_variation")))},
         {"interval_variation_max", numberOrNull(largest(columnOf(conditions, "interval_variation")))},
         {"accuracy", found->at("accuracy")},
         {"separable", found->at("verdict")},
         {"neighbours", neighboursOf(between->at("pairs"))},
         {"levels", between->at("conditions")},
         {"gradual_jnd", sweep->at("gradual").at("largest_jnd")},
         {"abrupt_jnd", sweep->at("abrupt").at("largest_jnd")}});
    session.keepPartial({{"reference", (*run)->reference}, {"encodings", (*run)->encodings}}, Json::array());
    return Json();
}

Result<Json> conclude(ScriptSession& session, const Arguments& arguments) {
    const auto run = session.begun<Comparison>(arguments.object());
    if (!run) return failure(run);
    const Json &done = (*run)->encodings, &reference = (*run)->reference;
    if (reference.is_null())
        return fail(ErrorCode::InvalidArgument, "{0}.conclude: {0}.knownLoad() is expected first", arguments.object());
    if (reference["passed"] != true || done.empty()) {
        const auto why = textOr(reference, "reason");
        return Json{{"verdict", "indeterminate"},
                    {"reference", reference},
                    {"encodings", Json::array()},
                    {"reasons", Json::array({why + (why.empty() ? "" : "; ") + "nothing was compared"})}};
    }
    const double asymmetry = asymmetryOf(done);
    if (auto said = session.reportText(shownText(**run, asymmetry)); !said) return failure(said);
    if (auto said = session.reportText(sameForAll(done)); !said) return failure(said);
    Json differences = Json::array(), reasons = Json::array();
    for (std::size_t i = 1; i < done.size(); ++i) differences.push_back(differenceRow(done[i], done[0]));
    for (const auto& each : done) {
        if (each["smallest_pair_jnd"].is_null() || each["neighbours"]["min_jnd"].is_null())
            reasons.push_back(each["name"].get<std::string>() + ": a condition or a level was not measured");
    }
    // A comparison has no pass: it gets a verdict only if the comparison could not be made.
    const bool missing = !reasons.empty();
    if (!missing) reasons = {symmetryOf(asymmetry), conclusionOf(done)};
    return Json{{"reference", reference},
                {"default", done[0]["name"]},
                {"encodings", done},
                {"conditions", conditionRows(done, differences)},
                {"differences", std::move(differences)},
                {"asymmetry_jnd", numberOrNull(asymmetry)},
                {"verdict", missing ? Json("indeterminate") : Json()},
                {"conclusion", missing ? Json() : Json(symmetryOf(asymmetry) + ". " + conclusionOf(done))},
                {"reasons", reasons}};
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
