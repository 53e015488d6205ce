#include "core/analysis/encodings/ComparedEncodings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>

#include "core/analysis/separability/SeparabilityJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JustNoticeable.h"
#include "core/encoding/EncodingProfile.h"

namespace tacto {

namespace {

using namespace describe;

std::string levelName(double roughness, double pressure) { return fmt::format("R {} P {}", roughness, pressure); }

bool isUsual(const ComparedEncoding& each) { return each.of.assignment == nameOf(Assignment::TextureToAmplitude); }

/// Returns NaN for no values or if one was not measured.
double largestOf(const std::vector<double>& values) {
    if (values.empty() || !std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) return kNaN;
    return std::ranges::max(values);
}

double smallestOf(std::vector<double> values) {
    for (double& value : values) value = -value;
    return -largestOf(values);
}

template <class Row, class Of>
std::vector<double> valuesOf(const std::vector<Row>& rows, Of of) {
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(std::invoke(of, row));
    return values;
}

double bestAxis(const PairSummary& pair) { return largestOf({pair.amplitudeJnd, pair.intervalJnd}); }

/// Returns the smallest distance on one axis; pairs with the same level on it are left out.
double smallestApart(const std::vector<PairSummary>& pairs, double PairSummary::*axis) {
    auto values = valuesOf(pairs, axis);
    std::erase_if(values, [](double value) { return value <= 1; });
    return smallestOf(values);
}

/// Each pair of neighbours counts on the axis that separates it best.
NeighbourDistances neighboursOf(const std::vector<PairSummary>& pairs) {
    const auto between = [&pairs](const std::string& a, const std::string& b) {
        const auto pair = std::ranges::find_if(
            pairs, [&](const PairSummary& row) { return (row.a == a && row.b == b) || (row.a == b && row.b == a); });
        return pair == pairs.end() ? kNaN : bestAxis(*pair);
    };
    std::vector<double> texture, pressure;
    for (std::size_t i = 0; i + 1 < kComparedLevels.size(); ++i) {
        for (const double other : kComparedLevels) {
            texture.push_back(between(levelName(kComparedLevels[i], other), levelName(kComparedLevels[i + 1], other)));
            pressure.push_back(between(levelName(other, kComparedLevels[i]), levelName(other, kComparedLevels[i + 1])));
        }
    }
    auto all = texture;
    all.insert(all.end(), pressure.begin(), pressure.end());
    const auto mean = [](const std::vector<double>& values) { return statisticsOf(values).mean; };
    return {smallestOf(texture), mean(texture), smallestOf(pressure), mean(pressure), smallestOf(all), mean(all)};
}

/// Returns how far a condition moved; negative if its value became smaller.
EncodingDifference::Moved movedBetween(const ConditionSummary& from, const ConditionSummary& to) {
    const auto moved = [](double a, double b, double weberFraction) {
        const double size = justNoticeableDifferences(b, a, weberFraction);
        return b < a ? -size : size;
    };
    return {moved(from.amplitude.mean, to.amplitude.mean, kAmplitudeWeberFraction),
            moved(from.interval_s.mean, to.interval_s.mean, kIntervalWeberFraction)};
}

// The distances of an encoding, sorted by what a person feels, not by the input that sets it.
double amplitudeNeighbours(const ComparedEncoding& each) {
    return isUsual(each) ? each.neighbours.textureMin : each.neighbours.pressureMin;
}
double intervalNeighbours(const ComparedEncoding& each) {
    return isUsual(each) ? each.neighbours.pressureMin : each.neighbours.textureMin;
}

double asymmetryOf(const std::vector<ComparedEncoding>& done) {
    std::vector<double> found;
    for (const auto& usual : done) {
        if (!isUsual(usual)) continue;
        const auto swapped = std::ranges::find_if(
            done, [&](const auto& other) { return !isUsual(other) && other.of.curve == usual.of.curve; });
        if (swapped == done.end()) continue;
        const auto compare = [&](auto of) {
            found.push_back(std::abs(std::invoke(of, usual) - std::invoke(of, *swapped)));
        };
        compare(&ComparedEncoding::smallestAmplitude_jnd);
        compare(&ComparedEncoding::smallestInterval_jnd);
        compare(&ComparedEncoding::smallestPair_jnd);
        compare(amplitudeNeighbours);
        compare(intervalNeighbours);
        compare(&ComparedEncoding::gradual_jnd);
        constexpr std::array<std::size_t, kComparedConditions> kThere{0, 2, 1, 3};
        for (std::size_t here = 0; here < kThere.size(); ++here) {
            const auto moved =
                movedBetween(usual.conditions.conditions.at(here), swapped->conditions.conditions.at(kThere[here]));
            found.push_back(std::abs(moved.amplitude_jnd));
            found.push_back(std::abs(moved.interval_jnd));
        }
    }
    return largestOf(found);
}

EncodingDifference differenceOf(const ComparedEncoding& each, const ComparedEncoding& base) {
    EncodingDifference out;
    out.encoding = each.of.name;
    for (std::size_t i = 0; i < kComparedConditions; ++i)
        out.conditions.push_back(movedBetween(base.conditions.conditions.at(i), each.conditions.conditions.at(i)));
    out.pair_jnd = each.smallestPair_jnd - base.smallestPair_jnd;
    out.neighboursMin_jnd = each.neighbours.min - base.neighbours.min;
    out.neighboursMean_jnd = each.neighbours.mean - base.neighbours.mean;
    out.perTrain_jnd = each.gradual_jnd - base.gradual_jnd;
    return out;
}

/// Names all curves within a hundredth of the best, because a measurement cannot tell them apart.
template <class Of>
std::string bestCurves(const std::vector<ComparedEncoding>& curves, const Of& of) {
    const auto values = valuesOf(curves, of);
    const double most = largestOf(values);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        if (values[i] > most - kComparedAtLeast_jnd) names.push_back(curves[i].of.curve);
    }
    return fmt::format("{} ({:.2f} JND)", fmt::join(names, " or "), std::abs(most));
}

std::string farthestOf(const std::vector<ComparedEncoding>& done) {
    std::vector<ComparedEncoding> curves;
    std::ranges::copy_if(done, std::back_inserter(curves), isUsual);
    return fmt::format(
        "At constant Weber fractions the curve that keeps the conditions farthest apart is {}; neighbouring levels in "
        "amplitude {}, in interval {}; the one that moves least per train {}",
        bestCurves(curves, &ComparedEncoding::smallestPair_jnd), bestCurves(curves, amplitudeNeighbours),
        bestCurves(curves, intervalNeighbours),
        bestCurves(curves, [](const ComparedEncoding& curve) { return -curve.gradual_jnd; }));
}

ResultRecord<NeighbourDistances> describeNeighbours() {
    using N = NeighbourDistances;
    ResultRecord<N> all;
    all.kept("texture_min_jnd", &N::textureMin);
    all.kept("texture_mean_jnd", &N::textureMean);
    all.kept("pressure_min_jnd", &N::pressureMin);
    all.kept("pressure_mean_jnd", &N::pressureMean);
    all.kept("min_jnd", &N::min);
    all.kept("mean_jnd", &N::mean);
    return all;
}

ResultRecord<ComparedEncoding> describeEncoding() {
    using E = ComparedEncoding;
    const auto conditions = in(&E::conditions, &Separability::conditions);
    const auto pairs = in(&E::conditions, &Separability::pairs);
    ResultRecord<E> all;
    all.shown(text("Encoding", "name"), in(&E::of, &EncodingName::name));
    all.kept("assignment", in(&E::of, &EncodingName::assignment));
    all.kept("curve", in(&E::of, &EncodingName::curve));
    all.kept("conditions", conditions, conditionRecord());
    all.kept("pairs", pairs, pairRecord());
    all.shown(jnd("Amplitude (JND)", "smallest_amplitude_jnd"), &E::smallestAmplitude_jnd);
    all.shown(jnd("Interval (JND)", "smallest_interval_jnd"), &E::smallestInterval_jnd);
    all.shown(jnd("Smallest pair (JND)", "smallest_pair_jnd"), &E::smallestPair_jnd);
    all.kept("mahalanobis_min",
             [pairs](const E& of) { return smallestOf(valuesOf(pairs(of), &PairSummary::mahalanobis)); });
    all.kept("amplitude_variation_max", [conditions](const E& of) {
        return largestOf(valuesOf(conditions(of), &ConditionSummary::amplitudeVariation));
    });
    all.kept("interval_variation_max", [conditions](const E& of) {
        return largestOf(valuesOf(conditions(of), &ConditionSummary::intervalVariation));
    });
    all.kept("neighbours", &E::neighbours, describeNeighbours());
    all.shown(jnd("Neighbours, smallest (JND)", "neighbours.min_jnd"));
    all.kept("levels", in(&E::levels, &Separability::conditions), conditionRecord());
    all.shown(jnd("A train, at most (JND)", "gradual_jnd"), &E::gradual_jnd);
    all.kept("abrupt_jnd", &E::abrupt_jnd);
    all.shown(as(As::Share, "Recognised", "accuracy"), in(&E::conditions, &Separability::accuracy));
    all.shown(as(As::Verdict, "Separable", "separable"), in(&E::conditions, &Separability::verdict));
    return all;
}

/// A condition under an encoding, and how far it moved against the default.
struct MovedCondition {
    std::string encoding;
    ConditionSummary condition;
    std::optional<EncodingDifference::Moved> moved;  ///< empty for the default itself
};

std::vector<MovedCondition> conditionRows(const ComparedEncodings& compared) {
    std::vector<MovedCondition> rows;
    for (std::size_t i = 0; i < compared.encodings.size(); ++i) {
        const auto& encoding = compared.encodings[i];
        for (std::size_t k = 0; k < encoding.conditions.conditions.size(); ++k) {
            MovedCondition row{encoding.of.name, encoding.conditions.conditions[k], {}};
            if (i > 0) row.moved = compared.differences[i - 1].conditions.at(k);
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

ResultRecord<EncodingDifference::Moved> describeMoved() {
    using M = EncodingDifference::Moved;
    ResultRecord<M> all;
    all.shown(jnd("Amplitude moved (JND)", "amplitude_jnd"), &M::amplitude_jnd);
    all.shown(jnd("Interval moved (JND)", "interval_jnd"), &M::interval_jnd);
    return all;
}

ResultRecord<MovedCondition> describeMovedCondition() {
    using M = MovedCondition;
    const auto moved = describeMoved();
    ResultRecord<M> all;
    all.shown(text("Encoding", "encoding"), &M::encoding);
    all.merge(&M::condition, conditionRecord());
    all.merge(&M::moved, moved);
    all.shown(conditionRecord().column("name", "Condition"));
    all.shown(conditionRecord().column("amplitude_v", "Amplitude, mean and s.d."));
    all.shown(conditionRecord().column("interval_s", "Interval, mean and s.d."));
    for (const auto& column : moved.columns()) all.shown(column);
    return all;
}

ResultRecord<EncodingDifference> describeDifference() {
    using D = EncodingDifference;
    ResultRecord<D> all;
    all.shown(text("Encoding", "encoding"), &D::encoding);
    const auto places = comparedConditions(0, 1);
    for (std::size_t i = 0; i < places.size(); ++i) {
        describeMoved().each([&](const nlohmann::json::json_pointer& at, const auto& value) {
            all.kept(places[i].name + " " + at.back(), [i, value](const D& of) { return value(of.conditions.at(i)); });
        });
    }
    all.shown(jnd("Smallest pair (JND)", "pair_jnd"), &D::pair_jnd);
    all.shown(jnd("Neighbours, smallest (JND)", "neighbours_min_jnd"), &D::neighboursMin_jnd);
    all.shown(jnd("Neighbours, mean (JND)", "neighbours_mean_jnd"), &D::neighboursMean_jnd);
    all.shown(jnd("A train, at most (JND)", "per_train_jnd"), &D::perTrain_jnd);
    return all;
}

ResultRecord<ComparedEncodings> describeComparedEncodings() {
    using C = ComparedEncodings;
    ResultRecord<C> all;
    all.shown(text("Compared with", "default"), [](const C& of) {
        return of.encodings.empty() ? nlohmann::json() : nlohmann::json(of.encodings.front().of.name);
    });
    all.shown(jnd("Asymmetry (JND)", "asymmetry_jnd"), &C::asymmetry_jnd);
    all.facts("Comparison", Else::InTheTerminal);
    all.rows("Encodings: smallest distances in just-noticeable differences", "encodings", &C::encodings,
             describeEncoding());
    all.rows("Conditions as measured, and how far they moved against the default", "conditions", conditionRows,
             describeMovedCondition(), Else::InTheTerminal);
    all.rows("Distances beside those of the default", "differences", &C::differences, describeDifference(),
             Else::InTheTerminal);
    // A comparison has no pass: it has a verdict only if it could not be made.
    all.kept("verdict",
             [](const C& of) { return of.missing.empty() ? std::optional<Verdict>() : Verdict::Indeterminate; });
    all.kept("reasons", [](const C& of) {
        return of.missing.empty() ? std::vector{of.symmetry, of.farthest} : of.missing;
    });
    all.kept("conclusion", [](const C& of) {
        return of.missing.empty() ? nlohmann::json(of.symmetry + ". " + of.farthest) : nlohmann::json();
    });
    return all;
}

const ResultRecord<ComparedEncodings>& comparedEncodingsRecord() { return builtOnce<describeComparedEncodings>(); }

}  // namespace

std::vector<ComparedPlace> comparedConditions(double low, double high) {
    return {{"smooth-low", low, low}, {"smooth-high", low, high}, {"rough-low", high, low}, {"rough-high", high, high}};
}

std::vector<ComparedPlace> comparedLevels() {
    std::vector<ComparedPlace> out;
    for (const double roughness : kComparedLevels) {
        for (const double pressure : kComparedLevels)
            out.push_back({levelName(roughness, pressure), roughness, pressure});
    }
    return out;
}

ComparedEncoding comparedEncoding(EncodingName of, Separability conditions, Separability levels, double gradual_jnd,
                                  double abrupt_jnd) {
    ComparedEncoding out{.of = std::move(of),
                         .conditions = std::move(conditions),
                         .levels = std::move(levels),
                         .gradual_jnd = gradual_jnd,
                         .abrupt_jnd = abrupt_jnd,
                         .neighbours = {}};
    const auto& pairs = out.conditions.pairs;
    out.smallestAmplitude_jnd = smallestApart(pairs, &PairSummary::amplitudeJnd);
    out.smallestInterval_jnd = smallestApart(pairs, &PairSummary::intervalJnd);
    out.smallestPair_jnd = smallestOf(valuesOf(pairs, bestAxis));
    out.neighbours = neighboursOf(out.levels.pairs);
    return out;
}

ComparedEncodings compareEncodings(std::vector<ComparedEncoding> encodings) {
    ComparedEncodings out;
    out.encodings = std::move(encodings);
    for (std::size_t i = 1; i < out.encodings.size(); ++i)
        out.differences.push_back(differenceOf(out.encodings[i], out.encodings.front()));
    out.asymmetry_jnd = asymmetryOf(out.encodings);
    for (const auto& encoding : out.encodings) {
        if (std::isnan(encoding.smallestPair_jnd) || std::isnan(encoding.neighbours.min))
            out.missing.push_back(encoding.of.name + ": a condition or a level was not measured");
    }
    out.symmetry = symmetryOfEncodings(out.asymmetry_jnd);
    out.farthest = farthestOf(out.encodings);
    return out;
}

std::string symmetryOfEncodings(double asymmetry_jnd) {
    return fmt::format(
        "Swapping R and P is a symmetry of this metric: it exchanges smooth-high and rough-low, and texture and "
        "pressure, and leaves every distance as it is{}. No figure here can prefer one assignment; people decide which "
        "is told apart, natural or preferred",
        std::isnan(asymmetry_jnd)
            ? ""
            : fmt::format(" (measured: within {:.2f} JND)", std::max(kComparedAtLeast_jnd, asymmetry_jnd)));
}

std::string sameForAllEncodings(const ComparedEncodings& compared) {
    const auto known = [](double value) { return std::isnan(value) ? 0 : value; };
    double share = 1, least = 1;
    std::vector<std::string> verdicts;
    for (const auto& encoding : compared.encodings) {
        share = std::min(share, known(encoding.conditions.accuracy.value));
        least = std::min(least, known(encoding.conditions.accuracy.low));
        const std::string verdict(nameOf(encoding.conditions.verdict));
        if (std::ranges::find(verdicts, verdict) == verdicts.end()) verdicts.push_back(verdict);
    }
    return fmt::format(
        "Recognised trials: {:.1f} % or more under every encoding (95 % interval from {:.1f} %); "
        "separable by an oscilloscope: {}.",
        100 * share, 100 * least, fmt::join(verdicts, ", "));
}

nlohmann::json toJson(const ComparedEncodings& compared) { return comparedEncodingsRecord().write(compared); }

ResultTraits comparedEncodingsKind() {
    return {.kind = ResultKind::EncodingComparison,
            .name = "encoding-comparison",
            .decisionRule = "A comparison: the encodings are set side by side, and none is judged.",
            .members = comparedEncodingsRecord().keys(),
            .tables = withBasis(comparedEncodingsRecord().tables())};
}

}  // namespace tacto
