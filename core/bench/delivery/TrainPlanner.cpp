#include "core/bench/delivery/TrainPlanner.h"

#include <algorithm>
#include <cmath>

#include "core/safety/SourceTraits.h"

namespace tacto {

namespace {

/// With any calibration, the programmed value deviates from the command by at most this share.
constexpr double kMaxCorrection = 0.2;

double levelOf(const PulseTrain& train) noexcept {
    return std::visit([](auto amplitude) { return amplitude.value(); }, train.amplitude);
}

Result<void> staysNear(std::string_view what, double programmed, double command) {
    if (std::abs(programmed - command) <= kMaxCorrection * command) return {};
    return fail(ErrorCode::LimitExceeded,
                "the calibration turns {} {:.4g} into {:.4g}; it must be within 20 %: the stimulator is defective, or "
                "the calibration belongs to another",
                what, command, programmed);
}

Result<void> timesStayNear(const PulseTrain& programmed, const PulseTrain& command) {
    if (auto near = staysNear("the phase width", programmed.phaseWidth.count(), command.phaseWidth.count()); !near)
        return near;
    return staysNear("the gap", programmed.interPhaseGap.count(), command.interPhaseGap.count());
}

Result<void> staysNear(const PulseTrain& programmed, const PulseTrain& command) {
    if (auto near = staysNear("the amplitude", levelOf(programmed), levelOf(command)); !near) return near;
    return timesStayNear(programmed, command);
}

/// The tolerance, the same as in SafetyGate, covers the rounding of decimal steps in binary.
bool isOnGrid(double value, double step) noexcept {
    return step == 0 || std::abs(value / step - std::round(value / step)) <= 1e-6;
}

Result<void> canBeSet(Milliamps level, const SourceTraits& source) {
    const double mA = level.value();
    if (!(mA > 0 && mA <= source.amplitudeMax)) {
        return invalid("a level of {} mA; above 0 to {:g} mA, the device's largest, is accepted", mA,
                       source.amplitudeMax);
    }
    if (isOnGrid(mA, source.amplitudeStep)) return {};
    return invalid("a level of {} mA; multiples of the device's step, {:g} mA, are accepted", mA, source.amplitudeStep);
}

}  // namespace

Result<PulseTrain> levelTrain(const EncodingProfile& profile, const SourceTraits& source, const KnownLines& calibration,
                              Milliamps level) {
    if (source.drive != Drive::Current)
        return fail(ErrorCode::Unsupported, "a level of {} mA of a voltage source; a current source is needed",
                    level.value());
    if (auto settable = canBeSet(level, source); !settable) return failure(settable);
    PulseTrain wanted = profile.train;
    wanted.amplitude = level;
    PulseTrain programmed = programmedFor(wanted, calibration);
    programmed.amplitude = level;
    if (auto near = timesStayNear(programmed, wanted); !near) return failure(near);
    auto rounded = roundToDevice(programmed, gridOf(source), calibration ? RoundedTo::Nearest : RoundedTo::Zero);
    if (!rounded) return failure(rounded);
    rounded->train.amplitude = level;
    return rounded->train;
}

TrainPlanner::TrainPlanner(const EncodingProfile& profile, const SourceTraits& source, SafetyGate& gate,
                           const KnownLines& calibration)
    : source_(source), calibration_(calibration), gate_(gate), series_(profile, calibration) {}

Result<void> TrainPlanner::want(double roughness, std::optional<double> pressure, Instant now) {
    const auto encoded = encoder().encode(roughness, pressure);
    if (!encoded) {
        wantNothing();
        return failure(encoded);
    }
    series_.want(*encoded, now);
    return {};
}

void TrainPlanner::wantNothing() noexcept { series_.wantNothing(); }

Result<PlannedBurst> TrainPlanner::planBurst(Instant now) {
    const Instant onset = std::max(series_.due().value_or(now), now);
    const Command command = series_.begin(onset);
    auto approved = gate_.approve(VibrationBurst{.intensity = encoder().massagerIntensity(command.amplitude)});
    if (!approved) return failure(approved);
    series_.delivered();
    return PlannedBurst{std::move(*approved), onset, command};
}

Result<PlannedLevel> TrainPlanner::planLevel(Milliamps level, Seconds interval, Instant onset) {
    const auto train = levelTrain(encoder().profile(), source_, calibration_, level);
    if (!train) return failure(train);
    auto approved = gate_.approve(TrainRequest{*train, programmed(interval), onset});
    if (!approved) return failure(approved);
    const double expected = calibration_ ? calibration_->amplitude.delivered(level.value()) : level.value();
    return PlannedLevel{std::move(*approved), onset, expected};
}

Result<RoundedTrain> programmedTrain(const EncodingProfile& profile, const SourceTraits& source,
                                     const KnownLines& calibration, Volts amplitude, std::optional<Ohms> impedance) {
    const auto train = trainFor(source.drive, profile, amplitude, impedance);
    if (!train) return failure(train);
    PulseTrain programmed = programmedFor(*train, calibration);
    if (auto near = staysNear(programmed, *train); !near) return failure(near);
    if (!calibration) return roundToDevice(programmed, gridOf(source));
    // To the nearest step, or toward zero if more than the profile's largest amplitude would come out.
    const double top = levelOf(*train) * (profile.amplitudeMax / amplitude);
    const double level = levelOf(programmed), step = source.amplitudeStep;
    if (calibration->amplitude.delivered(toNearest(level, step)) > top)
        programmed = trainAt(programmed, source.drive, towardZero(level, step));
    return roundToDevice(programmed, gridOf(source), RoundedTo::Nearest);
}

Result<PlannedTrain> TrainPlanner::plan(Instant now, std::optional<Ohms> impedance) {
    const Instant onset = std::max(series_.due().value_or(now), now);
    const Command command = series_.begin(onset);
    const auto held =
        heldAmplitude(encoder().profile().hold, command.amplitude, armed_, impedance ? impedance : armed_);
    if (!held) return failure(held);
    const Seconds interval = programmedFor(command.interval, calibration_);
    if (auto near = staysNear("the interval", interval.count(), command.interval.count()); !near) return failure(near);
    const auto rounded = programmedTrain(encoder().profile(), source_, calibration_, *held, impedance);
    if (!rounded) return failure(rounded);
    auto approved = gate_.approve(TrainRequest{rounded->train, interval, onset});
    if (!approved) return failure(approved);
    series_.delivered();
    const double level = levelOf(rounded->train);
    return PlannedTrain{std::move(*approved),
                        onset,
                        command,
                        *held,
                        *rounded,
                        calibration_ ? calibration_->amplitude.delivered(level) : level};
}

}  // namespace tacto
