#include "core/analysis/variation/VirtualParticipant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/analysis/statistics/GivenFigure.h"

namespace tacto {

namespace {

/// Maps `from` from its place between two neighbours of `medians` to the same place between those of `own`; above the
/// last value, in proportion. Both lists rise, and `from` is above the first median.
double ownScale(const std::array<double, 3>& medians, const std::array<double, 3>& own, double from) noexcept {
    if (from >= medians[2]) return own[2] * (from / medians[2]);
    const std::size_t low = from < medians[1] ? 0 : 1;
    const double share = std::log(from / medians[low]) / std::log(medians[low + 1] / medians[low]);
    return own[low] * std::pow(own[low + 1] / own[low], share);
}

}  // namespace

double LogNormal::at(double z) const noexcept { return median * std::exp(std::log(spread) * z); }

double thresholdScale(const PopulationModel& model, Micros width) noexcept {
    const double tau = model.strengthDuration.count();
    return (1 + tau / width.count()) / (1 + tau / model.thresholdWidth.count());
}

Result<void> validate(const PopulationModel& model) {
    for (const auto& field : populationFields()) {
        if (!field.accepted.contain(field.of(model)))
            return invalid("the {} is {}; {} is expected", field.name, field.of(model), field.accepted.text());
        if (const double spread = field.drawn ? (model.*field.drawn).spread : 1; !kAcceptedSpread.contain(spread)) {
            constexpr std::string_view kMedian = "median ";  // the field's name begins with this word
            return invalid("the spread of the {} is {}; {} is expected", field.name.substr(kMedian.size()), spread,
                           kAcceptedSpread.text());
        }
    }
    const double detection = model.detection_ma.median, attention = model.attention_ma.median;
    if (!(detection < attention && attention < model.intolerance_ma.median)) {
        return invalid(
            "the thresholds of perception, attention and intolerance are {:g}, {:g} and {:g} mA; each more "
            "than the one before is accepted",
            detection, attention, model.intolerance_ma.median);
    }
    if (!(model.discomfort_ma > detection)) {
        return invalid(
            "stimulation is too strong from {:g} mA; more than the perception threshold of {:g} mA is accepted",
            model.discomfort_ma, detection);
    }
    return checkFigures({givenAboveZero("the area in cm2 that the skin is given for", model.skinArea.value()),
                         givenAboveZero("the phase width of the thresholds in us", model.thresholdWidth.count()),
                         {"the strength-duration constant in us", model.strengthDuration.count(), {.low = 0}}});
}

VirtualParticipant drawParticipant(const PopulationModel& model, std::uint64_t seed, std::size_t index, Micros width,
                                   std::optional<SquareCentimetres> area) {
    Random random(seed, fmt::format("virtual participant {}", index));
    VirtualParticipant out;
    out.index = index;
    // One statement per draw keeps the order fixed; the compiler may evaluate function arguments in any order.
    const double series = model.series_ohm.draw(random);
    const double parallel = model.parallel_ohm.draw(random);
    const double capacitance = model.capacitance_nf.draw(random);
    const double larger = area ? area->value() / model.skinArea.value() : 1;
    out.skin = Load::skin(Ohms(series), Ohms(parallel / larger), Nanofarads(capacitance * larger));

    const double scale = thresholdScale(model, width);
    const double shared = std::sqrt(model.thresholdCorrelation) * random.normal();
    const LogNormal* const thresholds[] = {&model.detection_ma, &model.attention_ma, &model.intolerance_ma};
    std::array<double, 3> own{}, medians{};
    for (std::size_t i = 0; i < own.size(); ++i) {
        medians[i] = thresholds[i]->median;
        own[i] = scale * thresholds[i]->at(shared + std::sqrt(1 - model.thresholdCorrelation) * random.normal());
    }
    std::ranges::sort(own);  // a person who tolerates a current also feels it
    out.detection = Milliamps(own[0]);
    out.attention = Milliamps(own[1]);
    out.intolerance = Milliamps(own[2]);
    out.discomfort = Milliamps(ownScale(medians, own, model.discomfort_ma));
    out.amplitudeWeber = model.amplitudeWeber.draw(random);
    out.intervalWeber = model.intervalWeber.draw(random);
    out.lapse = model.lapseMost * random.uniform();
    out.noise_jnd = model.noise_jnd;
    return out;
}

namespace {
constexpr PopulationField drawnField(std::string_view key, std::string_view name, std::string_view holdsFor,
                                     const AcceptedNumbers& accepted, LogNormal PopulationModel::*member) {
    return {key, name, holdsFor, accepted, member, nullptr};
}
constexpr PopulationField singleField(std::string_view key, std::string_view name, std::string_view holdsFor,
                                      const AcceptedNumbers& accepted, double PopulationModel::*member) {
    return {key, name, holdsFor, accepted, nullptr, member};
}
}  // namespace

std::span<const PopulationField> populationFields() noexcept {
    using Model = PopulationModel;
    static constexpr PopulationField kFields[] = {
        drawnField("series_ohm", "median R_s of the skin", "", {.low = 1, .high = 1e6, .unit = "ohm"},
                   &Model::series_ohm),
        drawnField("parallel_ohm", "median R_p of the skin", "under 1 cm2", {.low = 1, .high = 1e8, .unit = "ohm"},
                   &Model::parallel_ohm),
        drawnField("capacitance_nf", "median C of the skin", "under 1 cm2", {.low = 0.001, .high = 1e5, .unit = "nF"},
                   &Model::capacitance_nf),
        drawnField("detection_ma", "median perception threshold", "at 150 us per phase",
                   {.low = 0.01, .high = 100, .unit = "mA"}, &Model::detection_ma),
        drawnField("attention_ma", "median attention threshold", "", {.low = 0.01, .high = 1000, .unit = "mA"},
                   &Model::attention_ma),
        singleField("discomfort_ma", "current that is too strong for the median participant", "",
                    {.low = 0.01, .high = 1000, .unit = "mA"}, &Model::discomfort_ma),
        drawnField("intolerance_ma", "median intolerance threshold", "", {.low = 0.01, .high = 1000, .unit = "mA"},
                   &Model::intolerance_ma),
        singleField("threshold_correlation", "correlation of the logarithms of a participant's thresholds", "",
                    {.low = 0, .high = 1}, &Model::thresholdCorrelation),
        drawnField("weber_amplitude", "median Weber fraction of amplitude", "", {.low = 0.001, .high = 1},
                   &Model::amplitudeWeber),
        drawnField("weber_interval", "median Weber fraction of interval", "", {.low = 0.001, .high = 1},
                   &Model::intervalWeber),
        singleField("lapse_most", "largest lapse rate", "which begins at 0", {.low = 0, .high = 1}, &Model::lapseMost),
        singleField("noise_jnd", "standard deviation of what is felt", "", {.low = 0.01, .high = 100, .unit = "JND"},
                    &Model::noise_jnd)};
    return kFields;
}

}  // namespace tacto
