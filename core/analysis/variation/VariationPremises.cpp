#include "core/analysis/variation/VariationPremises.h"

#include "core/base/Words.h"

namespace tacto {

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
