#include "core/analysis/variation/VariationJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/Words.h"
#include "core/results/ResultRecord.h"

namespace tacto {

using nlohmann::json;

namespace {

json medianOf(const Estimate& e) {
    return {{"median", numberOrNull(e.value)}, {"low", numberOrNull(e.low)}, {"high", numberOrNull(e.high)}};
}

json orNull(const std::optional<std::size_t>& value) { return value ? json(*value) : json(nullptr); }

json pooledJson(const PooledTrials& pooled) {
    return {{"total", orNull(pooled.total)},
            {"per_participant", orNull(pooled.perParticipant)},
            {"design_effect", numberOrNull(pooled.designEffect)},
            {"participants_least", orNull(pooled.participantsLeast)}};
}

json trialsJson(const TrialsNeeded& trials, const TrialsWanted& wanted, double chance) {
    json curve = json::array();
    for (const auto& point : trials.curve) {
        curve.push_back({{"trials", point.trials}, {"width", toJson(point.width)}});
    }
    return {
        {"width", wanted.width},
        {"assurance", wanted.assurance},
        {"chance", chance},
        {"per_participant", {{"for_width", orNull(trials.forWidth)}, {"above_chance", orNull(trials.aboveChance)}}},
        {"pooled",
         {{"participants", wanted.participants},
          {"rho", numberOrNull(trials.rho)},
          {"for_width", pooledJson(trials.pooledForWidth)},
          {"above_chance", pooledJson(trials.pooledAboveChance)}}},
        {"curve", curve},
        {"assumptions",
         "Whole blocks of every condition; trials of a participant independent, with the accuracy predicted for "
         "that participant; Wilson's 95 % interval; pooled trials count less by the design effect 1 + (m - 1) rho."}};
}

json modelJson(const VariationOptions& options) {
    const auto& model = options.population;
    const auto& to = options.stimulation;
    json out = {{"threshold_width_us", model.thresholdWidth.count()},
                {"strength_duration_us", model.strengthDuration.count()},
                {"width_us", to.encoding.train.phaseWidth.count()},
                {"skin_area_cm2", model.skinArea.value()},
                {"electrode_area_cm2", to.electrodeArea ? json(to.electrodeArea->value()) : json(nullptr)},
                {"above_detection", to.aboveDetection},
                {"below_discomfort", to.belowDiscomfort},
                {"load_low_ohm", to.loadLow.value()},
                {"load_high_ohm", to.loadHigh.value()},
                {"trials", options.trials},
                {"guess", nameOf(options.guess)}};
    for (const auto& field : populationFields()) {
        out[std::string(field.key)] = field.of(model);
        if (field.drawn)
            out[std::string(field.key)] = {{"median", field.of(model)}, {"spread", (model.*field.drawn).spread}};
    }
    return out;
}

/// Writes one list per column, because one object per person would repeat the names a thousand times.
json peopleJson(const std::vector<ParticipantPrediction>& people) {
    const auto column = [&people](auto value) {
        json out = json::array();
        for (const auto& person : people) out.push_back(value(person));
        return out;
    };
    const auto perCondition = [&column](auto value) {
        return column([value](const ParticipantPrediction& person) {
            json out = json::array();
            for (const auto& stimulus : person.delivery.stimuli) out.push_back(value(stimulus));
            return out;
        });
    };
    using Person = const ParticipantPrediction&;
    using Stimulus = const PredictedStimulus&;
    return {{"series_ohm", column([](Person p) { return p.who.skin.series.value(); })},
            {"parallel_ohm", column([](Person p) { return p.who.skin.parallel.value(); })},
            {"capacitance_nf", column([](Person p) { return p.who.skin.capacitance.value(); })},
            {"impedance_ohm", column([](Person p) { return p.delivery.impedance.value(); })},
            {"detection_ma", column([](Person p) { return p.who.detection.value(); })},
            {"attention_ma", column([](Person p) { return p.who.attention.value(); })},
            {"discomfort_ma", column([](Person p) { return p.who.discomfort.value(); })},
            {"intolerance_ma", column([](Person p) { return p.who.intolerance.value(); })},
            {"weber_amplitude", column([](Person p) { return p.who.amplitudeWeber; })},
            {"weber_interval", column([](Person p) { return p.who.intervalWeber; })},
            {"lapse", column([](Person p) { return p.who.lapse; })},
            {"served", column([](Person p) { return p.served; })},
            {"accuracy", column([](Person p) { return numberOrNull(p.accuracy); })},
            {"information_bits", column([](Person p) { return numberOrNull(p.information); })},
            {"outcome", perCondition([](Stimulus s) { return std::string(nameOf(s.outcome)); })},
            {"felt", perCondition([](Stimulus s) { return s.felt; })},
            {"command_v", perCondition([](Stimulus s) { return s.command.value(); })},
            {"current_ma", perCondition([](Stimulus s) { return s.current.value(); })},
            {"interval_s", perCondition([](Stimulus s) { return s.interval.count(); })}};
}

using namespace describe;

/// A prediction together with the options that produced it.
struct Predicted {
    const Variation& found;
    const VariationOptions& options;
};

ResultRecord<PilotOutlook> describePilot() {
    using P = PilotOutlook;
    ResultRecord<P> all;
    all.shown(number("People", "people"), &P::people);
    all.shown(number("Trials each", "trials"), &P::trials);
    all.shown(number("Above chance from", "right_from"), &P::rightFrom);
    all.shown(as(As::Share, "All are served", "all_served"), &P::allServed);
    all.shown(as(As::Share, "And above chance", "all_above_chance"), &P::allAboveChance);
    all.shown(as(As::Share, "If all: can do it, at least", "prevalence_all"), &P::prevalenceAll);
    all.shown(as(As::Share, "If all but one: at least", "prevalence_but_one"), &P::prevalenceButOne);
    all.shown(as(As::Share, "One person's interval is wide", "width"), &P::width);
    return all;
}

ResultRecord<Premise> describePremise() {
    using P = Premise;
    ResultRecord<P> all;
    all.shown(text("Quantity", "quantity"), &P::quantity);
    all.shown(text("Value", "value"), &P::value);
    all.shown(text("Spread", "spread"), nullIfEmpty(&P::spread));
    all.shown(text("Mark", "mark"), &P::mark);
    all.shown(text("Source", "source"), &P::source);
    return all;
}

ResultRecord<PredictedCondition> describeCondition() {
    using C = PredictedCondition;
    ResultRecord<C> all;
    all.shown(text("Condition", "name"), &C::name);
    all.shown(number("Presented", "presented"), &C::presented);
    all.shown(number("Refused", "refused"), &C::refused);
    all.shown(number("Not felt", "not_felt"), &C::notFelt);
    all.shown(number("Draws attention", "draws_attention"), &C::drawsAttention);
    all.shown(number("Too strong", "too_strong"), &C::tooStrong);
    all.kept("not_tolerated", &C::notTolerated);
    all.shown(number("Counted", "counted"), &C::counted);
    all.shown(number("Current", "current_ma", "mA"), &C::current_ma);
    all.shown(number("Voltage", "voltage_v", "V"), &C::voltage_v);
    all.kept("interval_s", &C::interval_s);
    return all;
}

ResultRecord<PredictedPair> describePair() {
    using P = PredictedPair;
    ResultRecord<P> all;
    all.shown(text("Condition", "a"), &P::a);
    all.shown(text("Against", "b"), &P::b);
    all.shown(number("Participants", "participants"), &P::participants);
    all.shown(number("Together (JND)", "jnd"), &P::jnd);
    all.shown(number("Amplitude (JND)", "amplitude_jnd"), &P::amplitude_jnd);
    all.shown(number("Interval (JND)", "interval_jnd"), &P::interval_jnd);
    return all;
}

ResultRecord<BenchVariation> describeBench() {
    using Condition = BenchCondition;
    using Pair = BenchPair;
    ResultRecord<Condition> condition;
    condition.shown(text("Condition", "name"), &Condition::name);
    condition.shown(number("Amplitude", "amplitude_v", "V"), &Condition::amplitude_v);
    condition.shown(number("Interval", "interval_s", "s"), &Condition::interval_s);
    ResultRecord<Pair> pair;
    pair.shown(text("Condition", "a"), &Pair::a);
    pair.shown(text("Against", "b"), &Pair::b);
    pair.shown(number("Amplitude (JND)", "amplitude_jnd"), &Pair::amplitude_jnd);
    pair.shown(number("Interval (JND)", "interval_jnd"), &Pair::interval_jnd);
    ResultRecord<BenchVariation> all;
    all.kept("draws", &BenchVariation::draws);
    all.rows("Benches within their tolerances, predicted, not measured", "conditions", &BenchVariation::conditions,
             condition, Else::InTheTerminal);
    all.rows("Benches: pairs in just-noticeable differences, predicted, not measured", "pairs", &BenchVariation::pairs,
             pair, Else::InTheTerminal);
    return all;
}

double chanceOf(const Predicted& of) { return 1 / static_cast<double>(of.found.conditions.size()); }

std::vector<std::string> labelsOf(const Predicted& of) {
    std::vector<std::string> labels;
    for (const auto& condition : of.found.conditions) labels.push_back(condition.name);
    return labels;
}

template <class Member>
auto figure(Member member) {
    return [member](const Predicted& all) -> decltype(auto) { return std::invoke(member, all.found); };
}

auto median(Estimate Variation::*member) {
    return [member](const Predicted& all) { return medianOf(all.found.*member); };
}

ResultRecord<Predicted> describeServed() {
    using V = Variation;
    ResultRecord<Predicted> all;
    all.shown(number("Served", "served"), figure(&V::served));
    all.shown(number("Refused", "participants_refused"), figure(&V::refusedPeople));
    all.shown(number("Do not feel all", "participants_not_feeling"), figure(&V::unfeltPeople));
    all.shown(number("Without a range", "participants_without_range"), figure(&V::withoutRange));
    return all;
}

/// A range of amplitudes.
struct ServedRange {
    std::string amplitudes;
    Predicted predicted;
};

ResultRecord<ServedRange> describeRange() {
    using R = ServedRange;
    ResultRecord<R> all;
    all.shown(text("Amplitudes", "amplitudes"), &R::amplitudes);
    all.mergeShown(&R::predicted, describeServed());
    const auto of = [](auto get) { return [get](const R& range) { return get(range.predicted); }; };
    all.shown(number("Every pair 5 JND apart", "clearly_separable"), of(figure(&Variation::clearlySeparable)));
    all.shown(as(As::Share, "Right answers of the served", "accuracy"), of(median(&Variation::accuracy)));
    return all;
}

ResultRecord<ComfortReading> describeReading() {
    using R = ComfortReading;
    using V = Variation;
    const auto fixed = [](auto member) { return [member](const R& of) { return std::invoke(member, of.fixed); }; };
    const auto personal = [](auto member) {
        return [member](const R& of) { return std::invoke(member, of.personal); };
    };
    const auto estimate = [](Estimate V::*of) { return [of](const V& found) { return medianOf(found.*of); }; };
    ResultRecord<R> all;
    all.shown(text("Too strong from", "too_strong_from"), &R::tooStrongFrom);
    all.shown(number("Median", "median_ma", "mA"), &R::median_ma);
    all.shown(number("Fixed range serves", "fixed_served"), fixed(&V::served));
    all.shown(number("It is refused to", "fixed_refused"), fixed(&V::refusedPeople));
    all.shown(number("Its lowest not felt by", "fixed_not_feeling"), fixed(&V::unfeltPeople));
    all.shown(number("Own range serves", "personal_served"), personal(&V::served));
    all.shown(as(As::Share, "Right answers of these", "accuracy"), personal(estimate(&V::accuracy)));
    all.kept("presented_accuracy", personal(estimate(&V::presentedAccuracy)));
    all.kept("presented_fixed_accuracy", fixed(estimate(&V::presentedAccuracy)));
    return all;
}

/// An aim of a pilot, and how many answers it needs.
struct PilotAim {
    std::string aim;
    std::optional<std::size_t> onePerson;
    PooledTrials pooled;
};

ResultRecord<PilotAim> describeAim() {
    using A = PilotAim;
    using T = PooledTrials;
    ResultRecord<A> all;
    all.shown(text("Aim", "aim"), &A::aim);
    all.shown(number("One participant", "one_participant"), &A::onePerson);
    all.shown(number("Pooled, each", "pooled_each"), in(&A::pooled, &T::perParticipant));
    all.shown(number("Pooled, all", "pooled_trials"), in(&A::pooled, &T::total));
    all.shown(number("Design effect", "design_effect"), in(&A::pooled, &T::designEffect));
    all.shown(number("Participants, at least", "participants_at_least"), in(&A::pooled, &T::participantsLeast));
    return all;
}

/// The description also has the tables of what a run of the protocol adds.
ResultRecord<Predicted> describeVariation() {
    using P = Predicted;
    using V = Variation;
    ResultRecord<P> all;
    all.kept("simulated", [](const P&) { return true; });
    all.kept("measured", [](const P&) { return false; });
    all.kept("range_v", [](const P& of) {
        const auto& encoding = of.options.stimulation.encoding;
        return std::array{encoding.amplitudeMin.value(), encoding.amplitudeMax.value()};
    });
    all.merge(std::identity(), describeServed());
    all.kept("asked", figure(&V::asked));
    all.kept("partial", figure(&V::partial));
    all.kept("seed", figure(&V::seed));
    all.kept("labels", labelsOf);
    all.kept("columns", [](const P& of) {
        auto columns = labelsOf(of);
        columns.emplace_back("none");
        return columns;
    });
    all.kept("confusion", figure(&V::confusion));
    all.kept("presented_accuracy", median(&V::presentedAccuracy));
    all.kept("it_bits", figure(&V::pooledInformation));
    all.kept("it_bias_bits", [](const P& of) { return of.found.pooledInformation - of.found.pooledCorrected; });
    all.kept("it_corrected_bits", figure(&V::pooledCorrected));
    all.kept("clearly_separable", figure(&V::clearlySeparable));
    all.kept("refused", figure(&V::refused));
    all.kept("not_felt", figure(&V::notFelt));
    all.kept("withheld", [](const P& of) {
        json reasons = json::array();
        for (const auto& [reason, count] : of.found.withheld) reasons.push_back({{"reason", reason}, {"count", count}});
        return reasons;
    });
    all.kept("accuracies", figure(&V::accuracies));
    all.kept("attention_ma", figure(&V::attention_ma));
    all.kept("intolerance_ma", figure(&V::intolerance_ma));
    all.kept("trials_needed", [](const P& of) {
        return of.found.trials ? trialsJson(*of.found.trials, of.options.wanted, chanceOf(of)) : json();
    });
    all.kept("model", [](const P& of) { return modelJson(of.options); });
    all.kept("people", [](const P& of) { return peopleJson(of.found.people); });

    all.shown(number("Virtual participants", "participants"), figure(&V::participants));
    all.shown(number("Served", "complete"), figure(&V::complete));
    all.shown(as(As::Share, "Clearly separable", "clearly_separable_share"), [](const P& of) {
        return static_cast<double>(of.found.clearlySeparable) / static_cast<double>(of.found.participants);
    });
    all.shown(as(As::Share, "Recognised, median", "accuracy"), median(&V::accuracy));
    all.shown(as(As::Share, "Recognised, all together", "pooled_accuracy"), figure(&V::pooledAccuracy));
    all.shown(number("Information, median", "information_bits", "bit"), median(&V::information));
    all.shown(number("Felt from, median", "detection_ma", "mA"), figure(&V::detection_ma));
    all.shown(number("Uncomfortable from, median", "discomfort_ma", "mA"), figure(&V::discomfort_ma));
    all.shown(number("Impedance, median", "impedance_ohm", "ohm"), figure(&V::impedance_ohm));
    all.facts("Participants");
    all.table(rows("Who is served, predicted, not measured", "ranges", describeRange().columns()));
    all.table(rows("Served people by the level that is too strong, predicted, not measured", "readings",
                   describeReading().columns()));
    all.rows("What few people can show, predicted, not measured", "pilots", figure(&V::pilots), describePilot()).note =
        "“If all” says what share of such people can do it, at least (95 %), when everyone in the pilot is above "
        "chance "
        "(p < 0.05, one-sided); “if all but one” when one is not (Bayesian prevalence, Ince et al. 2021, "
        "doi:10.7554/eLife.62461). So few people say whether people can do it, not how well people do it on average.";
    all.rows(
           "Premises", "premises", [](const P& of) { return premisesOf(of.options); }, describePremise(),
           Else::InTheTerminal)
        .note =
        "Source: the value is the source's. Choice: ours, to be replaced with the laboratory's own. Set: for this run. "
        "Every spread (geometric standard deviation) is a choice.";
    all.rows("Conditions, predicted, not measured", "conditions", figure(&V::conditions), describeCondition(),
             Else::InTheTerminal)
        .note =
        "A value is the median, and in brackets stand 5 and 95 %, of participants or of benches. A condition counts "
        "for "
        "a participant only if it is presented, felt and not too strong.";
    Columns others;
    for (const char* key : {"name", "presented", "not_felt", "counted", "draws_attention", "too_strong"})
        others.push_back(describeCondition().column(key));
    others.push_back(number("Not tolerated", "not_tolerated"));
    all.table(rows("Conditions of the other amplitudes, predicted, not measured", "other_levels.conditions",
                   std::move(others), Else::InTheTerminal));
    all.rows("Pairs in just-noticeable differences, predicted, not measured", "separability", figure(&V::pairs),
             describePair());
    all.table(confusion());
    all.table(
        rows("Trials that the pilot needs, predicted, not measured", "trials_needed.aims", describeAim().columns()));
    all.table(sentences("Assumptions", "trials_needed.assumptions", Else::InTheTerminal));
    for (const auto& table : builtOnce<describeBench>().tables()) all.table(under("bench", table));
    return all;
}

Predicted predictedBy(const VariationRun& run) { return {run.found, run.options}; }

json trialsWithAims(const VariationRun& run) {
    const auto predicted = predictedBy(run);
    auto out = builtOnce<describeVariation>().only({"trials_needed"}).write(predicted)["trials_needed"];
    if (out.is_null()) return out;
    const auto& needed = *run.found.trials;
    const PilotAim aims[] = {{fmt::format("95 % interval at most {:.0f} % wide", 100 * run.options.wanted.width),
                              needed.forWidth, needed.pooledForWidth},
                             {fmt::format("lower end above chance, {:.0f} %", 100 * chanceOf(predicted)),
                              needed.aboveChance, needed.pooledAboveChance}};
    for (const auto& aim : aims) out["aims"].push_back(describeAim().write(aim));
    return out;
}

ResultRecord<VariationRun> describeRun() {
    using R = VariationRun;
    const auto with = [](AmplitudeLevels levels) {
        return [levels](const R& run) -> Predicted { return {run.with(levels), run.options}; };
    };
    const auto fixed = with(AmplitudeLevels::Profile), personal = with(AmplitudeLevels::Personal);
    const auto& prediction = builtOnce<describeVariation>();
    ResultRecord<Predicted> other;
    other.kept("levels", [](const Predicted& of) { return otherThan(of.options.stimulation.levels); });
    other.merge(std::identity(),
                prediction.only({"accuracy", "complete", "refused", "not_felt", "served", "participants_refused",
                                 "participants_not_feeling", "participants_without_range", "presented_accuracy",
                                 "conditions", "people"}));
    ResultRecord<R> all;
    all.merge(predictedBy, prediction);
    all.kept("verdict", [](const R&) { return json(); });
    all.kept("reasons", &R::reasons);
    all.kept("headline", [](const R& run) { return fmt::format("{}", fmt::join(run.reasons, " ")); });
    all.kept("levels", [](const R& run) { return run.options.stimulation.levels; });
    all.kept("source", [](const R& run) {
        return run.options.stimulation.source.drive == Drive::Voltage ? "voltage" : "current";
    });
    all.kept("profile_served", [fixed](const R& run) { return fixed(run).found.served; });
    all.kept("personal_served", [personal](const R& run) { return personal(run).found.served; });
    all.kept("readings", &R::readings);
    all.kept("trials_needed", trialsWithAims);
    all.kept(
        "other_levels",
        [](const R& run) -> Predicted {
            return {run.other, run.options};
        },
        other);
    all.kept("bench", &R::bench);
    all.kept(
        "ranges",
        [fixed, personal](const R& run) {
            return std::array{ServedRange{run.fixedRange, fixed(run)},
                              ServedRange{"A range of each participant's own", personal(run)}};
        },
        describeRange());
    return all;
}

}  // namespace

json toJson(const Variation& found, const VariationOptions& options) {
    return builtOnce<describeVariation>().write({found, options});
}

json toJson(const BenchVariation& found) { return builtOnce<describeBench>().write(found); }

json toJson(const ComfortReading& reading) { return builtOnce<describeReading>().write(reading); }

json toJson(const VariationRun& run) { return builtOnce<describeRun>().write(run); }

std::vector<std::string> variationRunMembers() { return builtOnce<describeRun>().keys(); }

ResultTraits variationKind() {
    return {.kind = ResultKind::Variation,
            .name = "variation",
            .decisionRule = "A prediction: nothing is measured, and nothing is judged.",
            .members = builtOnce<describeVariation>().keys(),
            .tables = builtOnce<describeVariation>().tables()};
}

namespace {

constexpr std::string_view kDoelker =
    "Dölker et al. 2022, doi:10.1038/s41598-022-10708-9: median of 81 people, upper arm, 150 µs per phase. A fingertip "
    "differs.";

/// Makes the rows of drawn quantities and compares them with the shipped model to mark changes in this run.
class Premises {
public:
    explicit Premises(const VariationOptions& options) : options_(options), model_(options.population) {}

    void drawn(std::string quantity, LogNormal PopulationModel::*member, std::string_view unit, PremiseMark mark,
               std::string_view source, double scale = 1) {
        const LogNormal& now = model_.*member;
        const LogNormal& shipped = shipped_.*member;
        // No source states the spread of these figures.
        const auto spreadMark = nameOf(now.spread != shipped.spread ? PremiseMark::Set : PremiseMark::Choice);
        add(std::move(quantity), withUnit(scale * now.median, unit), fmt::format("{:.4g} ({})", now.spread, spreadMark),
            mark, source, now.median != shipped.median, withUnit(scale * shipped.median, unit));
    }
    void single(std::string quantity, double value, double shippedValue, std::string_view unit, PremiseMark mark,
                std::string_view source) {
        add(std::move(quantity), withUnit(value, unit), "", mark, source, value != shippedValue,
            withUnit(shippedValue, unit));
    }
    /// Adds a figure that is derived from other figures or from the run.
    void derived(std::string quantity, std::string value, PremiseMark mark, std::string_view source) {
        add(std::move(quantity), std::move(value), "", mark, source, false, "");
    }
    [[nodiscard]] const VariationOptions& options() const noexcept { return options_; }
    [[nodiscard]] const PopulationModel& model() const noexcept { return model_; }
    [[nodiscard]] const PopulationModel& shipped() const noexcept { return shipped_; }
    [[nodiscard]] std::vector<Premise> taken() && { return std::move(rows_); }

private:
    static std::string withUnit(double value, std::string_view unit) {
        return unit.empty() ? fmt::format("{:.6g}", value) : fmt::format("{:.6g} {}", value, unit);
    }
    void add(std::string quantity, std::string value, std::string spread, PremiseMark mark, std::string_view source,
             bool changed, const std::string& shippedValue) {
        if (changed) {
            rows_.push_back({std::move(quantity), std::move(value), std::move(spread), PremiseMark::Set,
                             fmt::format("Set for this run; shipped: {}.", shippedValue)});
        } else {
            rows_.push_back({std::move(quantity), std::move(value), std::move(spread), mark, std::string(source)});
        }
    }
    const VariationOptions& options_;
    const PopulationModel& model_;
    const PopulationModel shipped_;
    std::vector<Premise> rows_;
};

void addThresholds(Premises& rows) {
    const auto& model = rows.model();
    rows.drawn("Perception threshold: felt from", &PopulationModel::detection_ma, "mA", PremiseMark::Source, kDoelker);
    rows.drawn("Attention threshold: draws attention from", &PopulationModel::attention_ma, "mA", PremiseMark::Source,
               kDoelker);
    rows.drawn("Intolerance threshold: not borne from", &PopulationModel::intolerance_ma, "mA", PremiseMark::Source,
               kDoelker);
    rows.single("Too strong from", model.discomfort_ma, rows.shipped().discomfort_ma, "mA", PremiseMark::Choice,
                "Geometric mean of attention and intolerance; no source says where between them comfort ends, so the "
                "readings at both stand beside it.");
    rows.single("Correlation of a person's thresholds", model.thresholdCorrelation, rows.shipped().thresholdCorrelation,
                "", PremiseMark::Choice, "No source found.");
    const auto width = rows.options().stimulation.encoding.train.phaseWidth;
    rows.derived(fmt::format("Thresholds at {:g} µs per phase, times", width.count()),
                 fmt::format("{:.3f}", thresholdScale(model, width)), PremiseMark::Source,
                 fmt::format("Weiss' law with {:g} µs: Kaczmarek et al. 2000, "
                             "doi:10.1109/86.847828: three fibres of macaque fingerpads.",
                             model.strengthDuration.count()));
    rows.derived("Thresholds against the electrode's area", "constant", PremiseMark::Source,
                 "Dölker et al. 2022: no significant influence of the size. Higashiyama and Rollman 1991 found lower "
                 "thresholds under larger electrodes, up to 15 mm across.");
}

void addSkin(Premises& rows) {
    const auto& model = rows.model();
    const auto& area = rows.options().stimulation.electrodeArea;
    const double larger = area ? area->value() / model.skinArea.value() : 1;
    const auto under = [&](const char* name) {
        return fmt::format("{} under {:g} cm²", name, larger * model.skinArea.value());
    };
    rows.derived("Electrode area", fmt::format("{:g} cm²", larger * model.skinArea.value()),
                 area ? PremiseMark::Set : PremiseMark::Choice,
                 area ? "The profile's or this run's."
                      : "Neither the profile nor the run states one: that for which the skin is given.");
    rows.drawn("Series resistance of the skin", &PopulationModel::series_ohm, "Ω", PremiseMark::Choice,
               "The bench's skin equivalent. Rosell et al. 1988, doi:10.1109/10.4599: about 220 Ω at 100 kHz for 1 cm² "
               "of gelled skin.");
    rows.drawn(under("Parallel resistance of the skin"), &PopulationModel::parallel_ohm, "kΩ", PremiseMark::Choice,
               "The bench's skin equivalent, taken as that of 1 cm²; as 1 / area. Rosell et al. 1988: 10 kΩ to 1 MΩ at "
               "1 Hz for 1 cm².",
               1e-3 / larger);
    rows.drawn(under("C"), &PopulationModel::capacitance_nf, "nF", PremiseMark::Choice,
               "The bench's skin equivalent, taken as that of 1 cm²; as the area.", larger);
}

void addDiscrimination(Premises& rows) {
    const auto& model = rows.model();
    rows.drawn("Weber fraction of amplitude", &PopulationModel::amplitudeWeber, "", PremiseMark::Choice,
               "No source found for electrical stimulation of the skin.");
    rows.drawn("Weber fraction of interval", &PopulationModel::intervalWeber, "", PremiseMark::Source,
               "Jones et al. 2009, doi:10.1080/17470210902782200: 160 ms at 1 s, vibrations, not "
               "pauses between pulses.");
    rows.single("Noise of what is felt", model.noise_jnd, rows.shipped().noise_jnd, "JND", PremiseMark::Choice,
                "One just-noticeable difference is one standard deviation.");
    rows.single(
        "Largest lapse rate (even from 0)", 100 * model.lapseMost, 100 * rows.shipped().lapseMost, "%",
        PremiseMark::Source,
        "Wichmann and Hill 2001, Percept Psychophys 63:1293: the range they allow when they fit; even within it is "
        "a choice.");
}

void addLevels(Premises& rows) {
    const auto& to = rows.options().stimulation;
    const VirtualStimulation shipped;
    rows.single("Personal range: from, times perception", to.aboveDetection, shipped.aboveDetection, "",
                PremiseMark::Choice, "Clear of the threshold by four differences of 10 %.");
    rows.single("Personal range: to, times too strong", to.belowDiscomfort, shipped.belowDiscomfort, "",
                PremiseMark::Choice, "A margin.");
}

constexpr Word<PremiseMark> kPremiseMarkWords[] = {
    {"source", PremiseMark::Source}, {"choice", PremiseMark::Choice}, {"set", PremiseMark::Set}};
}  // namespace

std::string_view nameOf(PremiseMark mark) noexcept { return wordFor(kPremiseMarkWords, mark); }

std::vector<Premise> premisesOf(const VariationOptions& options) {
    Premises rows(options);
    addThresholds(rows);
    addSkin(rows);
    addDiscrimination(rows);
    addLevels(rows);
    return std::move(rows).taken();
}

}  // namespace tacto
