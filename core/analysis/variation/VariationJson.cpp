#include "core/analysis/variation/VariationJson.h"

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/Words.h"

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

json pilotsJson(const std::vector<PilotOutlook>& pilots) {
    json out = json::array();
    for (const auto& pilot : pilots) {
        out.push_back({{"people", pilot.people},
                       {"trials", pilot.trials},
                       {"right_from", pilot.rightFrom},
                       {"all_served", pilot.allServed},
                       {"all_above_chance", pilot.allAboveChance},
                       {"prevalence_all", pilot.prevalenceAll},
                       {"prevalence_but_one", pilot.prevalenceButOne},
                       {"width", toJson(pilot.width)}});
    }
    return out;
}

json premisesJson(const VariationOptions& options) {
    json out = json::array();
    for (const auto& premise : premisesOf(options)) {
        out.push_back({{"quantity", premise.quantity},
                       {"value", premise.value},
                       {"spread", premise.spread.empty() ? json(nullptr) : json(premise.spread)},
                       {"mark", nameOf(premise.mark)},
                       {"source", premise.source}});
    }
    return out;
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

/// A list per column: rows of objects would repeat the names a thousand times.
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

}  // namespace

json toJson(const Variation& found, const VariationOptions& options) {
    json conditions = json::array(), labels = json::array(), pairs = json::array(), withheld = json::array();
    for (const auto& c : found.conditions) {
        labels.push_back(c.name);
        conditions.push_back({{"name", c.name},
                              {"presented", c.presented},
                              {"refused", c.refused},
                              {"not_felt", c.notFelt},
                              {"counted", c.counted},
                              {"draws_attention", c.drawsAttention},
                              {"too_strong", c.tooStrong},
                              {"not_tolerated", c.notTolerated},
                              {"current_ma", toJson(c.current_ma)},
                              {"voltage_v", toJson(c.voltage_v)},
                              {"interval_s", toJson(c.interval_s)}});
    }
    for (const auto& p : found.pairs) {
        pairs.push_back({{"a", p.a},
                         {"b", p.b},
                         {"participants", p.participants},
                         {"jnd", toJson(p.jnd)},
                         {"amplitude_jnd", toJson(p.amplitude_jnd)},
                         {"interval_jnd", toJson(p.interval_jnd)}});
    }
    for (const auto& [reason, count] : found.withheld) withheld.push_back({{"reason", reason}, {"count", count}});
    json columns = labels;
    columns.push_back("none");
    json trials;
    if (found.trials) {
        trials = trialsJson(*found.trials, options.wanted, 1 / static_cast<double>(found.conditions.size()));
    }
    const auto& encoding = options.stimulation.encoding;
    return {{"simulated", true},
            {"measured", false},
            {"range_v", {encoding.amplitudeMin.value(), encoding.amplitudeMax.value()}},
            {"served", found.served},
            {"participants_refused", found.refusedPeople},
            {"participants_not_feeling", found.unfeltPeople},
            {"participants_without_range", found.withoutRange},
            {"asked", found.asked},
            {"participants", found.participants},
            {"partial", found.partial},
            {"seed", found.seed},
            {"conditions", conditions},
            {"separability", pairs},
            {"labels", labels},
            {"columns", columns},
            {"confusion", found.confusion},
            {"complete", found.complete},
            {"accuracy", medianOf(found.accuracy)},
            {"presented_accuracy", medianOf(found.presentedAccuracy)},
            {"pooled_accuracy", numberOrNull(found.pooledAccuracy)},
            {"information_bits", medianOf(found.information)},
            {"it_bits", numberOrNull(found.pooledInformation)},
            {"it_bias_bits", numberOrNull(found.pooledInformation - found.pooledCorrected)},
            {"it_corrected_bits", numberOrNull(found.pooledCorrected)},
            {"clearly_separable", found.clearlySeparable},
            {"clearly_separable_share",
             static_cast<double>(found.clearlySeparable) / static_cast<double>(found.participants)},
            {"refused", found.refused},
            {"not_felt", found.notFelt},
            {"withheld", withheld},
            {"accuracies", found.accuracies},
            {"impedance_ohm", toJson(found.impedance_ohm)},
            {"detection_ma", toJson(found.detection_ma)},
            {"attention_ma", toJson(found.attention_ma)},
            {"discomfort_ma", toJson(found.discomfort_ma)},
            {"intolerance_ma", toJson(found.intolerance_ma)},
            {"trials_needed", trials},
            {"pilots", pilotsJson(found.pilots)},
            {"premises", premisesJson(options)},
            {"model", modelJson(options)},
            {"people", peopleJson(found.people)}};
}

json toJson(const BenchVariation& found) {
    json conditions = json::array(), pairs = json::array();
    for (const auto& c : found.conditions) {
        conditions.push_back(
            {{"name", c.name}, {"amplitude_v", toJson(c.amplitude_v)}, {"interval_s", toJson(c.interval_s)}});
    }
    for (const auto& p : found.pairs) {
        pairs.push_back({{"a", p.a},
                         {"b", p.b},
                         {"amplitude_jnd", toJson(p.amplitude_jnd)},
                         {"interval_jnd", toJson(p.interval_jnd)}});
    }
    return {{"draws", found.draws}, {"conditions", conditions}, {"pairs", pairs}};
}

namespace {

constexpr std::string_view kDoelker =
    "Dölker et al. 2022, doi:10.1038/s41598-022-10708-9: median of 81 people, upper arm, 150 µs per phase. A fingertip "
    "differs.";

/// Rows of quantities that every participant draws; compared with the shipped model to show changes in this run.
class Premises {
public:
    explicit Premises(const VariationOptions& options) : options_(options), model_(options.population) {}

    void drawn(std::string quantity, LogNormal PopulationModel::*member, std::string_view unit, PremiseMark mark,
               std::string_view source, double scale = 1) {
        const LogNormal& now = model_.*member;
        const LogNormal& shipped = shipped_.*member;
        // No source gives the spread of any of them.
        const auto spreadMark = nameOf(now.spread != shipped.spread ? PremiseMark::Set : PremiseMark::Choice);
        add(std::move(quantity), withUnit(scale * now.median, unit), fmt::format("{:.4g} ({})", now.spread, spreadMark),
            mark, source, now.median != shipped.median, withUnit(scale * shipped.median, unit));
    }
    void single(std::string quantity, double value, double shippedValue, std::string_view unit, PremiseMark mark,
                std::string_view source) {
        add(std::move(quantity), withUnit(value, unit), "", mark, source, value != shippedValue,
            withUnit(shippedValue, unit));
    }
    /// What follows from the other figures or from the run.
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
