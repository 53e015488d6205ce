#include "core/bench/delivery/TrainPlanner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

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
    waiting_.reset();
    const auto encoded = encoder().encode(roughness, pressure);
    if (!encoded) {
        wantNothing();
        return failure(encoded);
    }
    series_.want(*encoded, now);
    return {};
}

void TrainPlanner::want(const EncodedTrain& train, Instant due) noexcept {
    series_.wantNothing();
    waiting_ = Waiting{train, due};
}

void TrainPlanner::wantNothing() noexcept {
    waiting_.reset();
    series_.wantNothing();
}

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

namespace {

/// Returns what is programmed so that `train` comes out, which stands for the command `amplitude`.
Result<RoundedTrain> programmedTrain(const PulseTrain& train, const EncodingProfile& profile,
                                     const SourceTraits& source, const KnownLines& calibration, Volts amplitude) {
    PulseTrain programmed = programmedFor(train, calibration);
    if (auto near = staysNear(programmed, train); !near) return failure(near);
    if (!calibration) return roundToDevice(programmed, gridOf(source));
    // To the nearest step, or toward zero if more than the profile's largest amplitude would come out.
    const double top = levelOf(train) * (profile.amplitudeMax / amplitude);
    const double level = levelOf(programmed), step = source.amplitudeStep;
    if (calibration->amplitude.delivered(toNearest(level, step)) > top)
        programmed = trainAt(programmed, source.drive, towardZero(level, step));
    return roundToDevice(programmed, gridOf(source), RoundedTo::Nearest);
}

/// The board computes in single precision.
bool isSame(double ours, double theirs) noexcept { return static_cast<float>(ours) == static_cast<float>(theirs); }

Result<void> isOfTheProfile(const EncodedTrain& train, const EncodingProfile& profile) {
    const auto &own = profile.train, &form = train.form;
    const auto differs = [](std::string_view what, double theirs, double ours) {
        return fail(ErrorCode::LimitExceeded, "the board's train has {} {:g}; the profile's is {:g}", what, theirs,
                    ours);
    };
    if (form.shape != own.shape || form.polarity != own.polarity)
        return fail(ErrorCode::LimitExceeded, "the board's train has another shape or polarity than the profile's");
    const double pairs[][2] = {{form.phaseWidth.count(), own.phaseWidth.count()},
                               {form.interPhaseGap.count(), own.interPhaseGap.count()},
                               {form.rechargeRatio, own.rechargeRatio},
                               {static_cast<double>(form.pulses), static_cast<double>(own.pulses)},
                               {form.rate.value(), own.rate.value()}};
    constexpr std::string_view kWhat[] = {"a phase width in us of", "a gap in us of", "a recharge ratio of",
                                          "a number of pulses of", "a pulse rate in Hz of"};
    for (std::size_t i = 0; i < std::size(kWhat); ++i)
        if (!isSame(pairs[i][0], pairs[i][1])) return differs(kWhat[i], pairs[i][0], pairs[i][1]);
    const auto within = [](double value, double low, double high) {
        return value >= static_cast<float>(low) && value <= static_cast<float>(high);
    };
    if (!within(train.command.value(), profile.amplitudeMin.value(), profile.amplitudeMax.value())) {
        return fail(ErrorCode::LimitExceeded, "the board commands {:g} V; {:g} to {:g} V is the profile's range",
                    train.command.value(), profile.amplitudeMin.value(), profile.amplitudeMax.value());
    }
    if (within(train.interval.count(), profile.intervalMin.count(), profile.intervalMax.count())) return {};
    return fail(ErrorCode::LimitExceeded, "the board commands an interval of {:g} s; {:g} to {:g} s is the profile's",
                train.interval.count(), profile.intervalMin.count(), profile.intervalMax.count());
}

/// Returns the board's train as the bench would make it: the profile's own, at the board's amplitude. The amplitude may
/// differ from the bench's for that command by rounding (10 %), and that of a current source by a declared load beside
/// the measured one (20 %).
Result<PulseTrain> trainOfBoard(const EncodedTrain& train, const EncodingProfile& profile, const SourceTraits& source,
                                std::optional<Ohms> impedance) {
    constexpr double kOffGrid = 1e-3;
    const double most = source.drive == Drive::Current ? 0.3 : 0.1;
    if (auto fits = isOfTheProfile(train, profile); !fits) return failure(fits);
    const auto own = trainFor(source.drive, profile, train.command, impedance);
    if (!own) return failure(own);
    const double level = levelOf(*own), step = source.amplitudeStep;
    if (!(std::abs(train.amplitude - level) <= most * level)) {
        return fail(ErrorCode::LimitExceeded,
                    "the board makes {:.4g} {} of {:.4g} V, and the bench {:.4g}; within {:.0f} % is expected",
                    train.amplitude, amplitudeUnit(source.drive), train.command.value(), level, 100 * most);
    }
    const double settable = step > 0 ? toNearest(train.amplitude, step) : train.amplitude;
    if (!(std::abs(settable - train.amplitude) <= std::max(kOffGrid * step, 1e-6 * train.amplitude))) {
        return fail(ErrorCode::LimitExceeded,
                    "the board commands {:g} {}; multiples of the device's step, {:g}, are "
                    "accepted",
                    train.amplitude, amplitudeUnit(source.drive), step);
    }
    return trainAt(*own, source.drive, settable);
}

}  // namespace

Result<RoundedTrain> programmedTrain(const EncodingProfile& profile, const SourceTraits& source,
                                     const KnownLines& calibration, Volts amplitude, std::optional<Ohms> impedance) {
    const auto train = trainFor(source.drive, profile, amplitude, impedance);
    if (!train) return failure(train);
    return programmedTrain(*train, profile, source, calibration, amplitude);
}

Result<PlannedTrain> TrainPlanner::plan(Instant now, std::optional<Ohms> impedance) {
    if (const auto waiting = std::exchange(waiting_, std::nullopt)) return planWaiting(*waiting, now, impedance);
    const Instant onset = std::max(series_.due().value_or(now), now);
    const Command command = series_.begin(onset);
    const auto held =
        heldAmplitude(encoder().profile().hold, command.amplitude, armed_, impedance ? impedance : armed_);
    if (!held) return failure(held);
    return approve(programmedTrain(encoder().profile(), source_, calibration_, *held, impedance), command, *held,
                   onset);
}

Result<PlannedTrain> TrainPlanner::planWaiting(const Waiting& waiting, Instant now, std::optional<Ohms> impedance) {
    const auto& train = waiting.train;
    const auto made = trainOfBoard(train, encoder().profile(), source_, impedance ? impedance : armed_);
    if (!made) return failure(made);
    // Of a voltage source what is played tells the step, where it is more than what was commanded.
    const auto out = source_.drive == Drive::Voltage ? std::max(train.command, Volts(train.amplitude)) : train.command;
    const Command command{train.command, train.interval};
    if (!series_.follow({out, train.interval}, toInstant(Seconds(train.onset_s)))) {
        return fail(ErrorCode::LimitExceeded,
                    "the board commands {:.4g} V and {:.4g} s: a larger step from the last train, or sooner after it, "
                    "than the profile permits",
                    command.amplitude.value(), command.interval.count());
    }
    return approve(programmedTrain(*made, encoder().profile(), source_, calibration_, command.amplitude), command,
                   command.amplitude, std::max(waiting.due, now));
}

Result<PlannedTrain> TrainPlanner::approve(const Result<RoundedTrain>& rounded, const Command& command, Volts held,
                                           Instant onset) {
    if (!rounded) return failure(rounded);
    const Seconds interval = programmedFor(command.interval, calibration_);
    if (auto near = staysNear("the interval", interval.count(), command.interval.count()); !near) return failure(near);
    auto approved = gate_.approve(TrainRequest{rounded->train, interval, onset});
    if (!approved) return failure(approved);
    series_.delivered();
    const double level = levelOf(rounded->train);
    return PlannedTrain{std::move(*approved),
                        onset,
                        command,
                        held,
                        *rounded,
                        calibration_ ? calibration_->amplitude.delivered(level) : level};
}

}  // namespace tacto
