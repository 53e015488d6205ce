#include <cmath>

#include "core/electrode/LoadResponse.h"
#include "core/encoding/Rounding.h"
#include "core/safety/GateChecks.h"
#include "core/safety/GateRules.h"

namespace tacto::gate {

namespace {
bool positive(double value) noexcept { return std::isfinite(value) && value > 0; }
bool notNegative(double value) noexcept { return std::isfinite(value) && value >= 0; }

template <class... Args>
tl::unexpected<Error> invalid(fmt::format_string<Args...> text, Args&&... args) {
    return fail(ErrorCode::InvalidArgument, text, std::forward<Args>(args)...);
}

Result<void> checkLimits(const GateSetup& setup) {
    bool refuses = false;
    for (const auto& set : setup.limits) {
        for (const auto& row : set.rows) {
            refuses = refuses || row.action == LimitAction::Refuse;
            const bool sound = positive(row.max) && notNegative(row.aboveHz) && notNegative(row.upToHz) &&
                               indexOf(row.quantity) < kQuantityCount;
            if (checks(BadLimitRow) && !sound) {
                return invalid("limit set {} has a row with the limit {}; a finite number above 0 is needed", set.id,
                               row.max);
            }
        }
    }
    if (checks(NoLimitSet) && !refuses) return invalid("no limit set is loaded; at least one that refuses is needed");
    for (const auto& ceiling : setup.ceilings) {
        if (checks(BadCeiling) && !(positive(ceiling.max) && indexOf(ceiling.quantity) < kQuantityCount)) {
            return invalid("the profile's ceiling is {}; a finite number above 0 is needed", ceiling.max);
        }
        for (const auto& set : setup.limits) {
            for (const auto& row : set.rows) {
                const bool same = row.quantity == ceiling.quantity && row.action == LimitAction::Refuse;
                if (checks(LoosenedCeiling) && same && !(ceiling.max <= row.max)) {
                    return invalid(
                        "the profile's ceiling on {} is {:.6g} {}; {} allows {:.6g} {}, and a profile may only tighten "
                        "it",
                        titleOf(ceiling.quantity), ceiling.max, unitOf(ceiling.quantity), set.id, row.max,
                        unitOf(row.quantity));
                }
            }
        }
    }
    return {};
}

Result<void> checkSource(const SourceTraits& s) {
    if (checks(SourceDrive) && s.drive != Drive::Voltage && s.drive != Drive::Current)
        return invalid("the source drives neither voltage nor current");
    if (checks(SourceAmplitudeMax) && !positive(s.amplitudeMax))
        return invalid("the source's largest amplitude is {}; it must be above 0", s.amplitudeMax);
    if (checks(SourceAmplitudeStep) && !notNegative(s.amplitudeStep))
        return invalid("the source's amplitude step is {}; 0 or more is needed", s.amplitudeStep);
    if (checks(SourceWidths) &&
        !(notNegative(s.widthStep.count()) && notNegative(s.widthMin.count()) && positive(s.widthMax.count()))) {
        return invalid("the source's pulse widths are {} to {} us in steps of {} us; finite numbers are needed",
                       s.widthMin.count(), s.widthMax.count(), s.widthStep.count());
    }
    if (checks(SourcePulses) && s.pulsesMax < 1)
        return invalid("the source allows {} pulses a train; 1 or more are needed", s.pulsesMax);
    if (checks(SourceCompliance) && !notNegative(s.compliance.value())) {
        return invalid("the source states a compliance of {} V; 0 or more is needed", s.compliance.value());
    }
    if (checks(SourceCurrentLimit) && !notNegative(s.currentLimit.value())) {
        return invalid("the source states a current limit of {} mA; 0 or more is needed", s.currentLimit.value());
    }
    if (checks(SourceNoCompliance) && s.drive == Drive::Current && !positive(s.compliance.value())) {
        return invalid("the current source states no compliance; its voltage could not be judged");
    }
    for (const auto& stated : {s.accuracy.amplitude, s.accuracy.phaseWidth, s.accuracy.gap, s.accuracy.interval}) {
        if (checks(SourceAccuracy) && stated && !stated->sound()) {
            return invalid("the source states an accuracy of {} % and {}; 0 or more and less than 100 % are needed",
                           100 * stated->relative, stated->absolute);
        }
    }
    return {};
}

bool soundLoad(const Load& load) noexcept {
    if (load.kind == LoadKind::Short) return true;
    if (load.kind == LoadKind::Resistor) return positive(load.series.value());
    if (load.kind != LoadKind::SkinEquivalent) return false;
    const Circuit circuit = circuitAt(load, 0);
    return positive(load.series.value()) && positive(load.parallel.value()) && positive(circuit.capacitance_F) &&
           notNegative(load.halvingVoltage.value());
}

Result<void> checkPerson(const GateSetup& setup) {
    if (setup.mode != OutputMode::Person) return {};
    if (checks(PersonMissing) && !setup.person)
        return invalid("person mode needs a person's consent, limits and ramp step");
    const PersonSetup person = setup.person.value_or(PersonSetup{});
    if (checks(PersonConsent) && !person.consentRecorded) return invalid("person mode needs a recorded consent");
    if (checks(PersonPseudonym) && person.participant.empty()) {
        return invalid("person mode needs the participant's pseudonym: accepted levels belong to one person");
    }
    if (checks(PersonArea) && !setup.electrodeArea) return invalid("person mode needs the electrode area in cm2");
    if (checks(PersonVoltageSource) && setup.source.drive != Drive::Current) {
        return invalid("a voltage source is refused for a person; a current source is needed");
    }
    if (checks(PersonMonophasicCheck) && setup.check.shape == PulseShape::Monophasic) {
        return invalid("a monophasic check pulse is refused for a person; a biphasic one is needed");
    }
    if (checks(PersonCalibration) && !(setup.calibration && setup.calibrated && setup.calibration->complete())) {
        return invalid(
            "the stimulator is not calibrated; a valid calibration of amplitude, interval, phase width and gap is "
            "needed before a person");
    }
    if (checks(PersonDiscomfort) && !positive(person.discomfortLimit.value())) {
        return invalid("the personal discomfort limit is {} mA; a finite current above 0 is needed",
                       person.discomfortLimit.value());
    }
    if (checks(PersonRampStep) && !positive(person.rampStep.value())) {
        return invalid("the ramp step is {} mA; a finite current above 0 is needed", person.rampStep.value());
    }
    const double low = person.impedanceLow.value();
    const double high = person.impedanceHigh.value();
    if (checks(PersonImpedanceBounds) && !(positive(low) && std::isfinite(high) && low < high)) {
        return invalid("a person's impedance range of {} to {} ohm is not one", low, high);
    }
    return {};
}
}  // namespace

Result<void> checkSetup(const GateSetup& setup) {
    if (auto limits = checkLimits(setup); !limits) return limits;
    if (auto source = checkSource(setup.source); !source) return source;
    const bool person = setup.mode == OutputMode::Person;  // Judged at measured or profile's loads instead
    if (checks(BadLoad) && !person &&
        !(soundLoad(setup.load.min) && soundLoad(setup.load.max) && soundLoad(setup.load.nominal))) {
        return invalid(
            "the declared load {} cannot be judged: a resistance or a skin equivalent is needed, open is a trip test",
            setup.load.nominal.text());
    }
    if (checks(BadArea) && setup.electrodeArea && !positive(setup.electrodeArea->value())) {
        return invalid("the electrode area is {} cm2; a finite area above 0 is needed", setup.electrodeArea->value());
    }
    if (checks(BadCalibration) && setup.calibration) {
        const auto& known = *setup.calibration;
        if (auto sound = setup.calibrated ? validate(known) : validateNumbers(known); !sound) return sound;
    }
    if (auto personal = checkPerson(setup); !personal) return personal;
    if (checks(BadCheckTrain)) {
        const PulseTrain check = checkTrainOf(setup);
        const Seconds interval = std::max(kCheckInterval, check.duration());
        if (auto sound = checkRequest(check, interval, setup.source); !sound) {
            return invalid("the impedance check cannot be delivered: {}", sound.error().message);
        }
    }
    return {};
}

double areaOf(const GateSetup& setup) noexcept {
    return setup.electrodeArea ? setup.electrodeArea->value() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<ActiveLimit> activeLimits(const GateSetup& setup) {
    std::vector<ActiveLimit> limits;
    for (const auto& set : setup.limits) {
        for (const auto& row : set.rows) limits.push_back({row, std::string_view(set.id), false});
    }
    for (const auto& ceiling : setup.ceilings) {
        LimitRow row;
        row.quantity = ceiling.quantity;
        row.max = ceiling.max;
        row.source = "the profile's ceiling";
        row.confidence = Confidence::High;
        limits.push_back({row, "profile", true});
    }
    return limits;
}

}  // namespace tacto::gate
