#include "core/analysis/variation/VirtualParticipant.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/analysis/variation/PopulationField.h"

namespace tacto {

namespace {

/// Where `from` lies between two neighbours of `medians`, `to` lies between those of `own`; beyond the last, in
/// proportion. Both rise, and `from` is above the first median.
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
    PopulationModel copy = model;
    for (const auto& field : populationFields()) {
        const double value = field.in(copy);
        if (field.accepted.contain(value)) continue;
        return invalid("the {} is {}; {} is expected", field.name, value, field.accepted.text());
    }
    const std::pair<std::string_view, const LogNormal&> drawn[] = {
        {"series resistance", model.series_ohm},
        {"parallel resistance", model.parallel_ohm},
        {"capacitance", model.capacitance_nf},
        {"perception threshold", model.detection_ma},
        {"attention threshold", model.attention_ma},
        {"intolerance threshold", model.intolerance_ma},
        {"Weber fraction of amplitude", model.amplitudeWeber},
        {"Weber fraction of interval", model.intervalWeber}};
    for (const auto& [name, of] : drawn) {
        if (kAcceptedSpread.contain(of.spread)) continue;
        return invalid("the spread of the {} is {}; {} is expected", name, of.spread, kAcceptedSpread.text());
    }
    const double detection = model.detection_ma.median, attention = model.attention_ma.median;
    if (!(detection < attention && attention < model.intolerance_ma.median)) {
        return fail(ErrorCode::InvalidArgument,
                    "the thresholds of perception, attention and intolerance are {:g}, {:g} and {:g} mA; each more "
                    "than the one before is accepted",
                    detection, attention, model.intolerance_ma.median);
    }
    if (!(model.discomfort_ma > detection)) {
        return fail(ErrorCode::InvalidArgument,
                    "stimulation is too strong from {:g} mA; more than the perception threshold of {:g} mA is accepted",
                    model.discomfort_ma, detection);
    }
    if (!(model.skinArea.value() > 0 && std::isfinite(model.skinArea.value()))) {
        return fail(ErrorCode::InvalidArgument, "the area that the skin is given for is {} cm2; above 0 is accepted",
                    model.skinArea.value());
    }
    if (!(model.thresholdWidth.count() > 0 && std::isfinite(model.thresholdWidth.count()))) {
        return fail(ErrorCode::InvalidArgument, "the phase width of the thresholds is {} us; above 0 is accepted",
                    model.thresholdWidth.count());
    }
    if (!(model.strengthDuration.count() >= 0 && std::isfinite(model.strengthDuration.count()))) {
        return fail(ErrorCode::InvalidArgument, "the strength-duration constant is {} us; 0 or more is accepted",
                    model.strengthDuration.count());
    }
    return {};
}

VirtualParticipant drawParticipant(const PopulationModel& model, std::uint64_t seed, std::size_t index, Micros width,
                                   std::optional<SquareCentimetres> area) {
    Random random(seed, fmt::format("virtual participant {}", index));
    VirtualParticipant out;
    out.index = index;
    // Draws in a fixed order, one statement each: the order in which arguments are evaluated is the compiler's.
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
    std::ranges::sort(own);  // who tolerates a current feels it
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

}  // namespace tacto
