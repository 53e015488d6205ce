#include "core/analysis/variation/VariationDelivery.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/GivenFigure.h"
#include "core/base/Words.h"
#include "core/electrode/LoadResponse.h"
#include "core/safety/SourceTraits.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

namespace {

/// The result of one pulse into the participant's skin.
struct PulseIntoSkin {
    Milliamps mean{0};  ///< mean of the leading phase
    Volts end{0};
};

PulseIntoSkin pulseInto(const Load& skin, const PulseTrain& train, const SourceTraits& source) {
    SourceLimits limits;
    if (source.compliance.value() > 0) limits.compliance_V = source.compliance.value();
    if (source.currentLimit.value() > 0) limits.current_A = source.currentLimit.value() / 1e3;
    const auto rest = restOf(source.gap, train.pulses > 1 ? restBetweenPulses(train) : Seconds(1 / train.rate.value()));
    const auto totals = pulseTotals(circuitAt(skin, 0), segmentsOf(train, source.gap), rest, limits);
    return {Milliamps(1e3 * std::abs(totals.leadingCharge_C) / Seconds(train.phaseWidth).count()),
            Volts(std::abs(totals.leadingEndVoltage_V))};
}

/// Returns the part of the profile's amplitude range that the participant feels and that is not too strong, or nothing
/// if no such part exists. Skin is assumed linear: the current per volt of command does not depend on the amplitude.
std::optional<EncodingProfile> personalRange(const VirtualParticipant& who, const VirtualStimulation& stimulation,
                                             double milliampsPerVolt) {
    EncodingProfile personal = stimulation.encoding;
    const double low = stimulation.aboveDetection * who.detection.value() / milliampsPerVolt;
    const double high = stimulation.belowDiscomfort * who.discomfort.value() / milliampsPerVolt;
    personal.amplitudeMin = Volts(std::max(personal.amplitudeMin.value(), low));
    personal.amplitudeMax = Volts(std::min(personal.amplitudeMax.value(), high));
    if (!(personal.amplitudeMin < personal.amplitudeMax)) return std::nullopt;
    return personal;
}

GateSetup setupFor(const VirtualParticipant& who, const VirtualStimulation& stimulation, Ohms impedance) {
    GateSetup setup;
    setup.source = stimulation.source;
    // For a person the gate knows only |Z|. It refuses voltage sources for people, so these are judged as on the bench.
    if (stimulation.source.drive == Drive::Current) {
        setup.mode = OutputMode::Person;
        setup.load = LoadRange::measured(impedance);
    } else {
        setup.load = LoadRange::declared(who.skin);
    }
    setup.limits = stimulation.limits;
    setup.ceilings = stimulation.ceilings;
    setup.electrodeArea = stimulation.electrodeArea;
    setup.check = stimulation.encoding.train;
    return setup;
}

/// Completes a stimulus after the command: rounds and delivers the train and decides whether to withhold it.
void follow(PredictedStimulus& stimulus, const VirtualParticipant& who, const VirtualStimulation& stimulation,
            Ohms impedance, const GateSetup& setup) {
    const auto withhold = [&stimulus](DeliveryOutcome outcome, std::string reason) {
        stimulus.outcome = outcome;
        stimulus.reason = std::move(reason);
    };
    const auto wanted = trainFor(stimulation.source.drive, stimulation.encoding, stimulus.command, impedance);
    if (!wanted) return withhold(DeliveryOutcome::NotSettable, "no train of this amplitude");
    const auto rounded = roundToDevice(*wanted, gridOf(stimulation.source));
    if (!rounded) return withhold(DeliveryOutcome::NotSettable, "the device's step or range");
    const auto pulse = pulseInto(who.skin, rounded->train, stimulation.source);
    stimulus.current = pulse.mean;
    stimulus.voltage = pulse.end;
    if (auto why = forbiddenBy(setup, rounded->train, stimulus.interval); !why.empty()) {
        return withhold(DeliveryOutcome::RefusedByLimits, std::move(why));
    }
    if (stimulus.current > who.discomfort)
        return withhold(DeliveryOutcome::Uncomfortable, "too strong for the participant");
    stimulus.outcome = DeliveryOutcome::Presented;
    stimulus.felt = stimulus.current >= who.detection;
}

constexpr Word<AmplitudeLevels> kAmplitudeLevels[] = {{"profile", AmplitudeLevels::Profile},
                                                      {"personal", AmplitudeLevels::Personal}};
constexpr Word<DeliveryOutcome> kDeliveryOutcomeWords[] = {
    {"presented", DeliveryOutcome::Presented},         {"impedance out of range", DeliveryOutcome::ImpedanceOutOfRange},
    {"not settable", DeliveryOutcome::NotSettable},    {"refused by limits", DeliveryOutcome::RefusedByLimits},
    {"uncomfortable", DeliveryOutcome::Uncomfortable}, {"no range", DeliveryOutcome::NoRange}};

}  // namespace

std::string_view nameOf(AmplitudeLevels levels) noexcept { return wordFor(kAmplitudeLevels, levels); }

Result<AmplitudeLevels> amplitudeLevelsFrom(std::string_view name) {
    if (const auto known = valueFor(kAmplitudeLevels, name)) return *known;
    return invalid("the amplitude levels are \"{}\"; profile or personal is accepted", name);
}

std::string_view nameOf(DeliveryOutcome outcome) noexcept { return wordFor(kDeliveryOutcomeWords, outcome); }

SourceTraits idealSource(Drive drive) noexcept {
    constexpr double kFarAway = 1000;  // V and mA: ten times what 40 V needs into the permitted loads
    SourceTraits source;
    source.drive = drive;
    source.amplitudeMax = kFarAway;
    source.compliance = Volts(kFarAway);
    source.widthMax = Micros(100'000);
    source.accuracy = StatedAccuracy::exact();
    return source;
}

Result<void> validate(const VirtualStimulation& stimulation) {
    if (auto valid = validate(stimulation.encoding); !valid) return failure(valid);
    if (stimulation.encoding.conditions.size() < 2) {
        return invalid("{} conditions; two or more can be told apart", stimulation.encoding.conditions.size());
    }
    if (stimulation.limits.empty()) {
        return invalid("no limit set is given; what would be refused cannot be determined");
    }
    if (const auto area = stimulation.electrodeArea; area && !(area->value() > 0 && area->value() <= 1e4)) {
        return invalid("an electrode of {} cm2; above 0 to 10000 is accepted", area->value());
    }
    if (stimulation.source.drive == Drive::HighImpedance) {
        return invalid("a source of high impedance; a voltage or a current source is accepted");
    }
    if (!(stimulation.loadLow.value() > 0 && stimulation.loadLow < stimulation.loadHigh)) {
        return invalid("loads of {} to {} ohm; a range above 0 is accepted", stimulation.loadLow.value(),
                       stimulation.loadHigh.value());
    }
    return checkFigures(
        {{"the lower level, in detection thresholds,", stimulation.aboveDetection, {.low = 1, .high = 10}},
         givenAboveZero("the upper level, in parts of discomfort,", stimulation.belowDiscomfort, 1)});
}

Delivery deliverTo(const VirtualParticipant& who, const VirtualStimulation& stimulation) {
    Delivery out;
    const auto& train = stimulation.encoding.train;
    out.impedance = impedanceOf(who.skin, train, stimulation.source);
    const bool drivesCurrent = stimulation.source.drive == Drive::Current;
    const double perVolt =
        drivesCurrent ? 1e3 / out.impedance.value()
                      : pulseInto(who.skin, trainAt(train, Drive::Voltage, 1), stimulation.source).mean.value();
    const bool personal = stimulation.levels == AmplitudeLevels::Personal;
    const auto encoding = personal ? personalRange(who, stimulation, perVolt) : stimulation.encoding;
    const bool inRange = out.impedance >= stimulation.loadLow && out.impedance <= stimulation.loadHigh;
    const auto setup = setupFor(who, stimulation, out.impedance);
    for (const auto& condition : stimulation.encoding.conditions) {
        PredictedStimulus stimulus;
        if (!encoding) {
            stimulus.reason = "no amplitude of the profile between felt and too strong";
        } else if (const auto command = Encoder(*encoding).encode(condition.R, condition.P); command) {
            stimulus.command = command->amplitude;
            stimulus.interval = command->interval;
            if (drivesCurrent && !inRange) {
                stimulus.outcome = DeliveryOutcome::ImpedanceOutOfRange;
                stimulus.reason = "impedance outside the profile's range";
            } else {
                follow(stimulus, who, stimulation, out.impedance, setup);
            }
        } else {
            stimulus.outcome = DeliveryOutcome::NotSettable;
            stimulus.reason = "the encoder";
        }
        out.stimuli.push_back(std::move(stimulus));
    }
    return out;
}

}  // namespace tacto
