#include "core/bench/TrainPlanner.h"

#include <algorithm>
#include <cmath>

namespace tacto {

DeviceGrid gridOf(const SourceTraits& source) noexcept {
    return {.amplitudeStep = source.amplitudeStep,
            .amplitudeMax = source.amplitudeMax,
            .widthStep = source.widthStep,
            .widthMin = source.widthMin,
            .widthMax = source.widthMax,
            .pulsesMax = source.pulsesMax};
}

namespace {

/// What is programmed stays this near to the command, whatever a calibration says.
constexpr double kMaxCorrection = 0.2;

double levelOf(const PulseTrain& train) noexcept {
    return std::visit([](auto amplitude) { return amplitude.value(); }, train.amplitude);
}

Result<void> staysNear(std::string_view what, double programmed, double command) {
    if (std::abs(programmed - command) <= kMaxCorrection * command) return {};
    return fail(ErrorCode::LimitExceeded,
                "the calibration would program {:.4g} for {} {:.4g}; at most 20 % beside it is "
                "accepted: the stimulator is out of order, or the calibration is not its own",
                programmed, what, command);
}

Result<void> staysNear(const PulseTrain& programmed, const PulseTrain& command) {
    if (auto near = staysNear("the amplitude", levelOf(programmed), levelOf(command)); !near) return near;
    if (auto near = staysNear("the phase width", programmed.phaseWidth.count(), command.phaseWidth.count()); !near)
        return near;
    return staysNear("the gap", programmed.interPhaseGap.count(), command.interPhaseGap.count());
}

}  // namespace

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

Result<PlannedTrain> TrainPlanner::plan(Instant now, std::optional<Ohms> impedance) {
    const Instant onset = std::max(series_.due().value_or(now), now);
    const Command command = series_.begin(onset);
    const auto held =
        heldAmplitude(encoder().profile().hold, command.amplitude, armed_, impedance ? impedance : armed_);
    if (!held) return failure(held);
    const auto train = trainFor(source_.drive, encoder().profile(), *held, impedance);
    if (!train) return failure(train);
    const PulseTrain programmed = programmedFor(*train, calibration_);
    if (auto near = staysNear(programmed, *train); !near) return failure(near);
    const Seconds interval = programmedFor(command.interval, calibration_);
    if (auto near = staysNear("the interval", interval.count(), command.interval.count()); !near) return failure(near);
    const auto rounded = roundToDevice(programmed, gridOf(source_));
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
