#include "core/analysis/VirtualParticipant.h"

#include <cmath>

namespace tacto {

double LogNormal::draw(Random& random) const noexcept { return median * std::exp(std::log(spread) * random.normal()); }

Result<void> validate(const PopulationModel& model) {
    const struct {
        std::string_view name;
        const LogNormal& of;
        double most;
    } drawn[] = {
        {"series resistance (ohm)", model.series_ohm, 1e9},    {"parallel resistance (ohm)", model.parallel_ohm, 1e9},
        {"capacitance (nF)", model.capacitance_nf, 1e6},       {"detection threshold (mA)", model.detection_ma, 1e3},
        {"headroom of discomfort", model.headroom, 1e3},       {"Weber fraction of amplitude", model.amplitudeWeber, 1},
        {"Weber fraction of interval", model.intervalWeber, 1}};
    for (const auto& each : drawn) {
        if (!(each.of.median > 0 && each.of.median <= each.most)) {
            return fail(ErrorCode::InvalidArgument, "the median {} is {}; above 0 to {:g} is accepted", each.name,
                        each.of.median, each.most);
        }
        if (!(each.of.spread >= 1 && each.of.spread <= 10)) {
            return fail(ErrorCode::InvalidArgument, "the spread of the {} is {}; 1 (none) to 10 is accepted", each.name,
                        each.of.spread);
        }
    }
    if (!(model.lapseMost >= 0 && model.lapseMost <= 1)) {
        return fail(ErrorCode::InvalidArgument, "the largest lapse rate is {}; 0 to 1 is accepted", model.lapseMost);
    }
    if (!(model.noise_jnd > 0 && model.noise_jnd <= 100)) {
        return fail(ErrorCode::InvalidArgument, "the noise of what is felt is {} JND; above 0 to 100 is accepted",
                    model.noise_jnd);
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

VirtualParticipant drawParticipant(const PopulationModel& model, std::uint64_t seed, std::size_t index, Micros width) {
    Random random(seed, fmt::format("virtual participant {}", index));
    VirtualParticipant out;
    out.index = index;
    // Draws in a fixed order, one statement each: the order in which arguments are evaluated is the compiler's.
    const double series = model.series_ohm.draw(random);
    const double parallel = model.parallel_ohm.draw(random);
    const double capacitance = model.capacitance_nf.draw(random);
    out.skin = Load::skin(Ohms(series), Ohms(parallel), Nanofarads(capacitance));
    const double tau = model.strengthDuration.count();
    const double scale = (1 + tau / width.count()) / (1 + tau / model.thresholdWidth.count());
    const double detection = scale * model.detection_ma.draw(random);
    const double headroom = model.headroom.draw(random);
    out.detection = Milliamps(detection);
    out.discomfort = Milliamps(detection * (1 + headroom));
    out.amplitudeWeber = model.amplitudeWeber.draw(random);
    out.intervalWeber = model.intervalWeber.draw(random);
    out.lapse = model.lapseMost * random.uniform();
    out.noise_jnd = model.noise_jnd;
    return out;
}

}  // namespace tacto
