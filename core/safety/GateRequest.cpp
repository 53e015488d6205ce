#include <cmath>

#include "core/safety/GateChecks.h"
#include "core/safety/GateRules.h"

namespace tacto::gate {

namespace {
/// On a multiple of `step` but for what decimal steps lose in binary.
bool onGrid(double value, double step) noexcept {
    if (step == 0) return true;
    const double steps = value / step;
    return std::abs(steps - std::round(steps)) <= 1e-6;
}

double inOwnUnit(const Amplitude& amplitude) noexcept {
    return std::visit([](auto a) { return a.value(); }, amplitude);
}
}  // namespace

Result<void> checkRequest(const PulseTrain& train, Seconds interval, const SourceTraits& source) {
    if (checks(MalformedTrain)) {
        if (auto sound = validate(train); !sound) return sound;
    }
    const bool current = isCurrent(train.amplitude);
    const char* unit = current ? "mA" : "V";
    if (checks(SourceKind) && current != (source.drive == Drive::Current)) {
        return fail(ErrorCode::InvalidArgument, "an amplitude in {} was asked of a {} source", unit,
                    source.drive == Drive::Current ? "current" : "voltage");
    }
    const double amplitude = inOwnUnit(train.amplitude);
    if (checks(AmplitudeMax) && !(amplitude <= source.amplitudeMax * (1 + kRounding))) {
        return fail(ErrorCode::InvalidArgument, "amplitude {:.6g} {} is above the device's largest, {:.6g} {}",
                    amplitude, unit, source.amplitudeMax, unit);
    }
    if (checks(AmplitudeGrid) && !onGrid(amplitude, source.amplitudeStep)) {
        return fail(ErrorCode::InvalidArgument, "amplitude {:.9g} {} is not a multiple of the device's step, {:.6g} {}",
                    amplitude, unit, source.amplitudeStep, unit);
    }
    const double width = train.phaseWidth.count();
    if (checks(WidthRange) &&
        !(width >= source.widthMin.count() * (1 - kRounding) && width <= source.widthMax.count() * (1 + kRounding))) {
        return fail(ErrorCode::InvalidArgument, "phase width {:.6g} us is outside the device's {:.6g} to {:.6g} us",
                    width, source.widthMin.count(), source.widthMax.count());
    }
    if (checks(WidthGrid) && !onGrid(width, source.widthStep.count())) {
        return fail(ErrorCode::InvalidArgument,
                    "phase width {:.9g} us is not a multiple of the device's step, {:.6g} us", width,
                    source.widthStep.count());
    }
    const double gap = train.interPhaseGap.count();
    if (checks(GapGrid) && train.shape != PulseShape::Monophasic && !onGrid(gap, source.widthStep.count())) {
        return fail(ErrorCode::InvalidArgument,
                    "inter-phase gap {:.9g} us is not a multiple of the device's step, {:.6g} us", gap,
                    source.widthStep.count());
    }
    if (checks(PulsesMax) && !(train.pulses <= source.pulsesMax)) {
        return fail(ErrorCode::InvalidArgument, "{} pulses a train are more than the device's {}", train.pulses,
                    source.pulsesMax);
    }
    const double seconds = interval.count();
    if (checks(IntervalValue) && !(std::isfinite(seconds) && seconds > 0)) {
        return fail(ErrorCode::InvalidArgument, "interval {} s is not a finite time above 0", seconds);
    }
    if (checks(IntervalBelowTrain) && !(train.duration().count() <= seconds * (1 + kRounding))) {
        return fail(ErrorCode::InvalidArgument, "interval {:.6g} s is shorter than the train, {} pulses at {:.6g} Hz",
                    seconds, train.pulses, train.rate.value());
    }
    return {};
}

bool keepsLimit(const LimitRow& row, double value, bool commandComputed) noexcept {
    const bool computed = row.quantity == Quantity::CommandVoltage && commandComputed;
    return row.keeps(computed ? value * (1 - 1e-12) : value);
}

std::string refusalText(const ActiveLimit& limit, double value, const std::string& aside) {
    return fmt::format("{} would be {:.4g} {}{}; {} allows {} {:.6g} {} ({})", titleOf(limit.row.quantity), value,
                       unitOf(limit.row.quantity), aside, limit.set.view(), limit.row.strict ? "less than" : "at most",
                       limit.row.max, unitOf(limit.row.quantity), limit.row.source);
}

}  // namespace tacto::gate
