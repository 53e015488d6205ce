#include "core/analysis/separability/SeparabilityJson.h"

#include <cmath>
#include <limits>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/RecordFields.h"
#include "core/base/Statistics.h"

namespace tacto {

using nlohmann::json;

namespace {

RecordFields<SeparabilityTrial> trialFields() {
    using T = SeparabilityTrial;
    RecordFields<T> all;
    all.text("condition", &T::condition, {.mayBeEmpty = true}).required = true;
    all.number("amplitude_v", &T::amplitude, {.unit = "V"});
    all.number("interval_s", &T::interval_s, {.unit = "s"});
    all.number("amplitude_u_v", &T::amplitudeUncertainty, {.unit = "V"});
    all.number("interval_u_s", &T::intervalUncertainty_s, {.unit = "s"});
    all.number("time_base_u", &T::timeBase);
    all.number("amplitude_gain_u", &T::amplitudeGain);
    all.takeNullAsMissing();
    all.passOverUnknownKeys();
    return all;
}

}  // namespace

Result<SeparabilityTrial> separabilityTrialFrom(const json& row) {
    SeparabilityTrial trial{{}, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN};
    if (auto read = builtOnce<trialFields>().read(row, trial, {.path = "trial"}).map_error(asInvalidArgument); !read)
        return failure(read);
    return trial;
}

json toJson(const SeparabilityTrial& trial) { return builtOnce<trialFields>().write(trial); }

namespace {

using namespace describe;

ResultRecord<ConditionSummary> describeCondition() {
    using C = ConditionSummary;
    ResultRecord<C> all;
    all.shown(text("Condition", "name"), &C::name);
    all.shown(number("n", "n"), &C::n);
    all.shown(number("Amplitude, mean and s.d.", "amplitude_v", "V"), &C::amplitude);
    all.shown(number("Interval, mean and s.d.", "interval_s", "s"), &C::interval_s);
    all.shown(as(As::Share, "Variation of amplitude", "amplitude_variation", "amplitude_variation_high"),
              &C::amplitudeVariation);
    all.shown(as(As::Share, "Variation of interval", "interval_variation", "interval_variation_high"),
              &C::intervalVariation);
    all.keptBounds("amplitude_variation", &C::amplitudeVariationBounds);
    all.keptBounds("interval_variation", &C::intervalVariationBounds);
    all.shown(number("Not measured", "not_measured"), &C::notMeasured);
    return all;
}

ResultRecord<PairSummary> describePair() {
    using P = PairSummary;
    ResultRecord<P> all;
    all.shown(text("Condition", "a"), &P::a);
    all.shown(text("Against", "b"), &P::b);
    all.shown(as(As::AtLeast, "Amplitude (JND)", "amplitude_jnd", "amplitude_jnd_low"), &P::amplitudeJnd);
    all.shown(as(As::AtLeast, "Interval (JND)", "interval_jnd", "interval_jnd_low"), &P::intervalJnd);
    all.keptBounds("amplitude_jnd", &P::amplitudeJndBounds);
    all.keptBounds("interval_jnd", &P::intervalJndBounds);
    all.shown(number("Mahalanobis distance", "mahalanobis"), &P::mahalanobis);
    return all;
}

ResultRecord<FeltReference> describeFeltReference() {
    using F = FeltReference;
    ResultRecord<F> all;
    all.shown(text("Material", "material"), &F::material);
    all.shown(number("Vibration h", "h"), &F::h);
    all.shown(number("Taxels v", "v"), &F::v);
    all.shown(number("Frames", "frames"), &F::frames);
    return all;
}

ResultRecord<Separability> describeSeparability() {
    using S = Separability;
    ResultRecord<S> all;
    all.shown(as(As::Share, "Recognised", "accuracy"), &S::accuracy);
    all.shown(number("Folds of the cross-validation", "folds"), &S::folds);
    all.shown(number("Instrument's floor, amplitude", "floor.amplitude_v", "V"), &S::amplitudeFloor);
    all.shown(number("Instrument's floor, interval", "floor.interval_s", "s"), &S::intervalFloor_s);
    all.facts("Recognition");
    // The protocol adds these, of surfaces that were felt before the trials.
    all.table(
        rows("Reference surfaces", "references", builtOnce<describeFeltReference>().columns(), Else::InTheTerminal));
    all.rows("Conditions", "conditions", &S::conditions, conditionRecord()).note =
        "At most and at least: the one-sided 95 % confidence bound, by which each is judged.";
    all.rows("Pairs", "pairs", &S::pairs, pairRecord());
    all.table(confusion());
    all.kept("confusion", &S::confusion);
    all.judged();
    return all;
}

constexpr std::string_view kKind = "separability";

const ResultRecord<Separability>& separabilityRecord() { return builtOnce<describeSeparability>(); }

}  // namespace

const ResultRecord<ConditionSummary>& conditionRecord() { return builtOnce<describeCondition>(); }
const ResultRecord<PairSummary>& pairRecord() { return builtOnce<describePair>(); }

json toJson(const FeltReference& felt) { return builtOnce<describeFeltReference>().write(felt); }

json toJson(const Separability& found) {
    auto out = separabilityRecord().write(found);
    out["kind"] = kKind;
    return out;
}

ResultTraits separabilityKind() {
    return {.kind = ResultKind::Separability,
            .name = kKind,
            .decisionRule =
                "Separable when each pair of conditions is at least 5 just-noticeable differences apart in one "
                "dimension and no coefficient of variation exceeds 5 %, each judged by its one-sided 95 % confidence "
                "bound, and the accuracy's 95 % interval begins at 95 % or above. The 5 differences and the 5 % are "
                "choices of this program.",
            .members = separabilityRecord().keys(),
            .tables = withBasis(separabilityRecord().tables())};
}

Result<std::vector<SeparabilityTrial>> readSeparabilityTrials(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseSeparabilityTrials(*text, path.string());
}

Result<std::vector<SeparabilityTrial>> parseSeparabilityTrials(std::string_view text, std::string_view name) {
    NamedRows rows(text, name, "columns condition, amplitude and interval were expected", "a row per trial");
    const auto condition = rows.column({"condition"});
    if (!condition) return failure(condition);
    const auto amplitude = rows.column({"amplitude", "amplitude_v", "amplitude_ma"});
    if (!amplitude) return failure(amplitude);
    const auto interval = rows.column({"interval", "interval_s"});
    if (!interval) return failure(interval);

    std::vector<SeparabilityTrial> trials;
    auto more = rows.next();
    for (; more && *more; more = rows.next()) {
        SeparabilityTrial trial;
        trial.condition = std::string(rows[*condition]);
        if (trial.condition.empty()) return rows.refuse("the condition is empty; a name was expected");
        struct Value {
            std::string_view column;
            std::string_view field;
            double* target;
        };
        for (const auto& [column, field, target] : {Value{"amplitude", rows[*amplitude], &trial.amplitude},
                                                    Value{"interval", rows[*interval], &trial.interval_s}}) {
            if (field.empty()) {
                *target = std::numeric_limits<double>::quiet_NaN();
                continue;
            }
            const auto number = parseNumber(field);
            if (!number || !(std::isnan(*number) || (*number > 0 && std::isfinite(*number)))) {
                return rows.refuse(
                    "{} '{}'; a finite number above 0 was expected, or nothing where it was not measured", column,
                    field.substr(0, 40));
            }
            *target = *number;
        }
        trials.push_back(std::move(trial));
    }
    if (!more) return failure(more);
    return trials;
}

}  // namespace tacto
