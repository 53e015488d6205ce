#include "core/pilot/PilotResults.h"

#include <algorithm>
#include <iterator>

#include "core/analysis/identification/IdentificationJson.h"
#include "core/analysis/vibration/VibrationSeparability.h"
#include "core/pilot/PilotRecord.h"
#include "core/results/ResultRecord.h"

namespace tacto {

using namespace describe;

namespace {

using nlohmann::json;

/// A column with a level. The session decides key and unit: a current in mA, or a massager's intensity.
ResultColumn level(const char* title, std::string_view what, LevelUnit unit) {
    return {title, levelKey(what, unit), As::Number, unit == LevelUnit::Current ? "mA" : ""};
}

ResultRecord<AscendingSeries> describeSeries(LevelUnit unit) {
    using S = AscendingSeries;
    ResultRecord<S> all;
    all.shown(level("Felt from", "felt", unit), &S::felt);
    all.shown(level("Too strong from", "too_strong", unit), &S::tooStrong);
    all.shown(level("Highest", "highest", unit), &S::highest);
    all.shown(as(As::Condition, "Ended by", "ended_by"), &S::endedBy);
    all.kept("felt_empty", &S::feltEmpty);
    all.kept("marked", &S::marked);
    return all;
}

ResultRecord<IntervalShare> describeShare() {
    ResultRecord<IntervalShare> all;
    all.kept("trials", &IntervalShare::trials);
    all.kept("right", &IntervalShare::right);
    return all;
}

ResultRecord<DetectionFound> describeDetection(LevelUnit unit) {
    using D = DetectionFound;
    using T = AnsweredTwoIntervalTrial;
    ResultRecord<T> trial;
    trial.kept(std::string(nameOf(unit)), &T::level);
    trial.kept("correct", &T::correct);
    ResultRecord<D> all;
    all.shown(level("Detection", "estimate", unit), [](const D& found) { return estimateOrNull(found.estimate); });
    all.shown(as(As::YesNo, "It may lie beyond", "at_edge"), &D::atEdge);
    all.shown(number("Trials", "trials"), [](const D& found) { return found.trials.size(); });
    all.shown(as(As::Condition, "By", "method"), &D::method);
    all.kept("history", &D::trials, trial);
    all.kept("first", in(&D::shares, &IntervalShares::first), describeShare());
    all.kept("second", in(&D::shares, &IntervalShares::second), describeShare());
    return all;
}

ResultRecord<StrengthComparisonResult> describeComparison(LevelUnit unit) {
    using C = StrengthComparisonResult;
    using T = AnsweredComparison;
    ResultRecord<T> trial;
    trial.kept(levelKey("weaker", unit), [](const T& answered) { return answered.pair.weaker; });
    trial.kept(levelKey("stronger", unit), [](const T& answered) { return answered.pair.stronger; });
    trial.kept("correct", &T::correct);
    ResultRecord<C> all;
    all.shown(number("Weber fraction of strength", "amplitude_weber"),
              [](const C& found) { return estimateOrNull(found.weber); });
    all.shown(as(As::YesNo, "It may lie beyond", "at_edge"), &C::atEdge);
    all.kept("trials", [](const C& found) { return found.trials.size(); });
    all.kept("history", &C::trials, trial);
    all.kept("first", in(&C::intervals, &IntervalShares::first), describeShare());
    all.kept("second", in(&C::intervals, &IntervalShares::second), describeShare());
    return all;
}

ResultRecord<PresentedCondition> describePresented(LevelUnit unit) {
    using P = PresentedCondition;
    const bool current = unit == LevelUnit::Current;
    ResultRecord<P> all;
    all.shown(as(As::Condition, "Condition", "name"), &P::name);
    all.shown({current ? "Level" : "Strength", std::string(nameOf(unit)), As::Number, current ? "mA" : ""}, &P::level);
    all.shown(number("Interval", "interval_s", "s"), [](const P& presented) { return presented.interval.count(); });
    return all;
}

ResultRecord<ThresholdsFound> describeThresholds(LevelUnit unit) {
    using F = ThresholdsFound;
    const auto detection = describeDetection(unit);
    const auto comparison = describeComparison(unit);
    ResultRecord<F> all;
    all.shown(level("Felt from", "felt", unit), in(&F::limits, &AscendingResult::felt));
    all.shown(level("Too strong from", "too_strong", unit), in(&F::limits, &AscendingResult::tooStrong));
    all.shown(as(As::YesNo, "Said to be too strong, not only the highest", "said_too_strong"),
              in(&F::limits, &AscendingResult::saidTooStrong));
    all.kept("series", in(&F::limits, &AscendingResult::series), describeSeries(unit));
    all.kept("detection", &F::detection, detection);
    all.kept("range", &F::range);
    all.kept("comparison", &F::compared, comparison);
    for (const auto& part : {under("detection", detection.columns()), under("range", rangeColumns(unit)),
                             under("comparison", comparison.columns())}) {
        for (const auto& column : part) all.shown(column);
    }
    return all;
}

/// Returns the columns of both units, those at the same place beside each other; a session fills only the columns of
/// its own unit.
template <class ColumnsOf>
Columns ofBothUnits(ColumnsOf columnsOf) {
    const Columns currents = columnsOf(LevelUnit::Current), intensities = columnsOf(LevelUnit::Intensity);
    Columns both = currents;
    for (std::size_t i = 0; i < intensities.size(); ++i) {
        const auto at = [&both](const ResultColumn& one) { return std::ranges::find(both, one.at, &ResultColumn::at); };
        if (at(intensities[i]) == both.end()) both.insert(std::next(at(currents[i])), intensities[i]);
    }
    return both;
}

/// Returns tables of the session's participant, thresholds and range.
Tables ofSession(const char* thresholds) {
    return {
        facts("Session", "",
              {text("Participant", "participant.code"), text("Basis", "participant.basis"), number("Parts", "parts")},
              Else::InTheReport),
        facts("Thresholds and range", thresholds,
              ofBothUnits([](LevelUnit unit) { return describeThresholds(unit).columns(); }), Else::InTheReport)};
}

}  // namespace

json presentedJson(const std::vector<PresentedCondition>& presented, LevelUnit unit) {
    json all = json::array();
    for (const auto& each : presented) all.push_back(describePresented(unit).write(each));
    return all;
}

json thresholdsJson(const ThresholdsFound& found, LevelUnit unit) { return describeThresholds(unit).write(found); }

ResultTraits pilotThresholdsKind() {
    Tables tables = ofSession("");
    tables.push_back(rows("Series", "series",
                          ofBothUnits([](LevelUnit unit) { return describeSeries(unit).columns(); }),
                          Else::InTheReport));
    return {
        .kind = ResultKind::PilotThresholds, .name = "pilot-thresholds", .ofStudy = true, .tables = std::move(tables)};
}

ResultTraits pilotIdentificationKind() {
    Tables tables = ofSession("thresholds");
    Tables own{rows("Presented levels", "presented",
                    ofBothUnits([](LevelUnit unit) { return describePresented(unit).columns(); }))};
    std::ranges::copy(identificationTables(), std::back_inserter(own));
    std::ranges::copy(vibrationTables("vibration"), std::back_inserter(own));
    own.push_back(sentences("Notes", "notes"));
    for (auto& table : own) {
        table.shown = Else::InTheReport;
        tables.push_back(std::move(table));
    }
    return {.kind = ResultKind::PilotIdentification,
            .name = "pilot-identification",
            .ofStudy = true,
            .tables = std::move(tables)};
}

}  // namespace tacto
