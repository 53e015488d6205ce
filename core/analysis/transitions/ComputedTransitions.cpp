#include "core/analysis/transitions/ComputedTransitions.h"

#include <array>
#include <fmt/format.h>

#include "core/base/JsonText.h"

namespace tacto {

namespace {

using namespace describe;

/// A step of amplitude or of interval, as a sentence and a table name it.
struct SizedStep {
    std::string movement;
    bool isAmplitude = true;
    const TransitionStep* step = nullptr;

    [[nodiscard]] double jnd() const { return isAmplitude ? step->amplitude : step->interval; }
    [[nodiscard]] double from() const { return at(step->from); }
    [[nodiscard]] double to() const { return at(step->to); }
    [[nodiscard]] const char* unit() const { return isAmplitude ? "V" : "s"; }
    [[nodiscard]] bool isWanted() const { return jnd() <= kWantedPerTrain; }

private:
    [[nodiscard]] double at(const Command& command) const {
        return isAmplitude ? command.amplitude.value() : command.interval.count();
    }
};

std::array<SizedStep, 2> sized(const std::string& movement, const LargestSteps& steps) {
    return {SizedStep{movement, true, &steps.amplitude}, SizedStep{movement, false, &steps.interval}};
}

std::vector<SizedStep> sideBySide(const ComputedTransitions& computed) {
    std::vector<SizedStep> rows;
    const auto add = [&rows](const std::string& movement, const LargestSteps& steps) {
        for (auto& row : sized(movement, steps)) rows.push_back(std::move(row));
    };
    add(fmt::format("across in {} s", computed.sweep.traverse.count()), computed.report.gradual);
    add("jump between corners", computed.report.abrupt);
    return rows;
}

std::string tooLarge(const SizedStep& found) {
    return fmt::format(
        "{}: {} goes from {:.3g} to {:.3g} {} in one train, {:.1f} just-noticeable differences, at R {:.2f}, P {:.2f}; "
        "at most {:g} are wanted",
        found.movement, found.isAmplitude ? "amplitude" : "the interval", found.from(), found.to(), found.unit(),
        found.jnd(), found.step->R, found.step->P, kWantedPerTrain);
}

ResultRecord<SizedStep> describeSizedStep() {
    using S = SizedStep;
    ResultRecord<S> all;
    all.shown(text("Movement", "movement"), &S::movement);
    all.shown(text("Of", "of"), [](const S& row) { return row.isAmplitude ? "amplitude" : "interval"; });
    all.shown(number("From", "from", "@unit"), &S::from);
    all.shown(number("To", "to", "@unit"), &S::to);
    all.kept("unit", &S::unit);
    all.shown(jnd("Step (JND)", "jnd"), &S::jnd);
    all.shown(number("R", "roughness"), [](const S& row) { return row.step->R; });
    all.shown(number("P", "pressure"), [](const S& row) { return row.step->P; });
    all.shown(as(As::YesNo, "As wanted", "wanted"), &S::isWanted);
    return all;
}

/// The members of a step; `distance` is its size in amplitude or in interval.
ResultRecord<TransitionStep> describeStep(double TransitionStep::*distance) {
    using S = TransitionStep;
    ResultRecord<S> all;
    all.kept("jnd", distance);
    all.kept("roughness", &S::R);
    all.kept("pressure", &S::P);
    all.kept("from_v", [](const S& step) { return step.from.amplitude.value(); });
    all.kept("to_v", [](const S& step) { return step.to.amplitude.value(); });
    all.kept("from_s", [](const S& step) { return step.from.interval.count(); });
    all.kept("to_s", [](const S& step) { return step.to.interval.count(); });
    return all;
}

ResultRecord<LargestSteps> describeLargestSteps() {
    using L = LargestSteps;
    ResultRecord<L> all;
    all.shown(jnd("Largest change (JND)", "largest_jnd"), &L::largest);
    all.kept("amplitude", &L::amplitude, describeStep(&TransitionStep::amplitude));
    all.kept("interval", &L::interval, describeStep(&TransitionStep::interval));
    return all;
}

ResultRecord<ComputedTransitions> describeComputedTransitions() {
    using C = ComputedTransitions;
    using E = EncodingProfile;
    const auto largest = describeLargestSteps();
    ResultRecord<C> all;
    all.kept("wanted_jnd", [](const C&) { return kWantedPerTrain; });
    all.kept("lines", in(&C::sweep, &TransitionSweep::lines));
    all.kept("traverse_s", [](const C& computed) { return computed.sweep.traverse.count(); });
    all.kept("jumps_judged", &C::jumpsJudged);
    all.kept("amplitude_ratio_per_train", in(&C::encoding, &E::amplitudeRatioPerTrain));
    all.kept("amplitude_slew_v_per_s", in(&C::encoding, &E::amplitudeSlew_V_per_s));
    all.kept("interval_ratio_per_train", in(&C::encoding, &E::intervalRatioPerTrain));
    all.kept("steps", [](const C& computed) { return computed.report.steps.size(); });
    for (const auto& [key, title, steps] :
         {std::tuple("gradual", "Largest change, gradual (JND)", &TransitionReport::gradual),
          std::tuple("abrupt", "Largest change, abrupt (JND)", &TransitionReport::abrupt)}) {
        all.kept(key, in(&C::report, steps), largest);
        for (auto& column : under(key, {largest.column("largest_jnd", title)})) all.shown(std::move(column));
    }
    all.rows("Computed from the encoding: largest step from train to train", "largest", sideBySide, describeSizedStep(),
             Else::InTheTerminal);
    all.kept("amplitude_map", in(&C::map, &TransitionMap::amplitude));
    all.kept("interval_map", in(&C::map, &TransitionMap::interval));
    all.judged();
    return all;
}

}  // namespace

Result<ComputedTransitions> computeTransitions(const EncodingProfile& encoding, const TransitionSweep& sweep,
                                               bool judgeJumps) {
    auto report = sweepTransitions(encoding, sweep);
    if (!report) return failure(report);
    auto map = mapOf(report->steps, sweep.lines);
    if (!map) return failure(map);
    ComputedTransitions out{.encoding = encoding,
                            .sweep = sweep,
                            .jumpsJudged = judgeJumps,
                            .report = std::move(*report),
                            .map = std::move(*map)};
    const auto judge = [&out](const char* movement, const LargestSteps& steps) {
        for (const auto& found : sized(movement, steps)) {
            if (!found.isWanted()) out.reasons.push_back(tooLarge(found));
        }
    };
    judge("moving through the plane", out.report.gradual);
    if (judgeJumps) judge("jumping between its corners", out.report.abrupt);
    out.verdict = out.reasons.empty() ? Verdict::Pass : Verdict::Fail;
    return out;
}

nlohmann::json toJson(const ComputedTransitions& computed) { return computedTransitionsRecord().write(computed); }

const ResultRecord<ComputedTransitions>& computedTransitionsRecord() {
    return builtOnce<describeComputedTransitions>();
}

}  // namespace tacto
