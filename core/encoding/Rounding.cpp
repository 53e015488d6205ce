#include "core/encoding/Rounding.h"

#include <algorithm>
#include <cmath>

namespace tacto {
namespace {

/// Relative decrease of `wanted`; 0 if only the last bits differ.
double shrunk(double wanted, double rounded) noexcept {
    if (!(wanted > 0)) return 0;
    const double relative = (wanted - rounded) / wanted;
    return std::abs(relative) > 1e-9 ? relative : 0;
}

}  // namespace

double towardZero(double value, double step) noexcept {
    if (!(step > 0)) return value;
    const double multiple = std::trunc(value / step + std::copysign(1e-9, value));
    return multiple == 0 ? 0.0 : multiple * step;
}

double toNearest(double value, double step) noexcept { return step > 0 ? std::round(value / step) * step : value; }

Result<RoundedTrain> roundToDevice(const PulseTrain& wanted, const DeviceGrid& grid, RoundedTo to) {
    if (auto valid = validate(wanted); !valid) return failure(valid);
    RoundedTrain result{wanted};
    const auto tooFar = [](double relative) { return !(std::abs(relative) <= kLargestRounding * (1 + 1e-9)); };
    const auto onto = to == RoundedTo::Zero ? towardZero : toNearest;

    const bool current = isCurrent(wanted.amplitude);
    const double amplitude = std::visit([](auto a) { return a.value(); }, wanted.amplitude);
    // The outer minimum is needed because a multiple of an inexact step may lie a last bit above the range.
    const double amplitudeSet =
        std::min(onto(std::min(amplitude, grid.amplitudeMax), grid.amplitudeStep), grid.amplitudeMax);
    const char* unit = amplitudeUnit(wanted.amplitude);
    result.amplitude = shrunk(amplitude, amplitudeSet);
    if (tooFar(result.amplitude)) {
        return fail(
            ErrorCode::Unsupported,
            "amplitude {:.6g} {} would become {:.6g} {} on this device (steps of {:.6g}, at most {:.6g} {}), more "
            "than 10 % away",
            amplitude, unit, amplitudeSet, unit, grid.amplitudeStep, grid.amplitudeMax, unit);
    }
    if (current) {
        result.train.amplitude = Milliamps(amplitudeSet);
    } else {
        result.train.amplitude = Volts(amplitudeSet);
    }

    const double width = wanted.phaseWidth.count();
    const double widthMax = grid.widthMax.count();
    const double widthSet = std::min(onto(std::min(width, widthMax), grid.widthStep.count()), widthMax);
    result.phaseWidth = shrunk(width, widthSet);
    if (tooFar(result.phaseWidth) || !(widthSet >= grid.widthMin.count() * (1 - 1e-9))) {
        return fail(
            ErrorCode::Unsupported,
            "phase width {:.6g} µs cannot be set within 10 % on this device (steps of {:.6g} µs, {:.6g} to {:.6g} "
            "µs)",
            width, grid.widthStep.count(), grid.widthMin.count(), grid.widthMax.count());
    }
    result.train.phaseWidth = Micros(widthSet);

    if (wanted.shape != PulseShape::Monophasic) {
        const double gap = wanted.interPhaseGap.count();
        const double gapSet = onto(gap, grid.widthStep.count());
        result.gap = shrunk(gap, gapSet);
        if (tooFar(result.gap)) {
            return fail(ErrorCode::Unsupported,
                        "inter-phase gap {:.6g} µs cannot be set within 10 % in steps of {:.6g} µs", gap,
                        grid.widthStep.count());
        }
        result.train.interPhaseGap = Micros(gapSet);
    }

    result.train.pulses = std::min(wanted.pulses, grid.pulsesMax);
    result.pulses = shrunk(wanted.pulses, result.train.pulses);
    if (tooFar(result.pulses)) {
        return fail(ErrorCode::Unsupported, "a train of {} pulses is more than this device's {}", wanted.pulses,
                    grid.pulsesMax);
    }
    return result;
}

}  // namespace tacto
