#include <algorithm>
#include <cmath>

#include "core/electrode/LoadResponse.h"
#include "core/safety/GateRules.h"
#include "core/safety/Rules.h"

namespace tacto::gate {

namespace {
bool positive(double value) noexcept { return std::isfinite(value) && value > 0; }
bool notNegative(double value) noexcept { return std::isfinite(value) && value >= 0; }

// --- limits ---------------------------------------------------------------------------------------------------------

struct RowOfSet {
    const LimitSet& set;
    const LimitRow& row;
};

constexpr Rule<RowOfSet> kRowRules[] = {
    {BadLimitRow,
     [](auto& r) {
         return !(positive(r.row.max) && notNegative(r.row.aboveHz) && notNegative(r.row.upToHz) &&
                  indexOf(r.row.quantity) < kQuantityCount);
     },
     [](auto& r) {
         return invalid("limit set {} has a row with the limit {}; a finite number above 0 is needed", r.set.id,
                        r.row.max);
     }},
};

constexpr Rule<std::vector<LimitSet>> kSetRules[] = {
    {NoLimitSet,
     [](auto& sets) {
         return std::ranges::none_of(sets, [](const LimitSet& set) {
             return std::ranges::any_of(set.rows,
                                        [](const LimitRow& row) { return row.action == LimitAction::Refuse; });
         });
     },
     [](auto&) { return invalid("no limit set is loaded; at least one that refuses is needed"); }},
};

constexpr Rule<Ceiling> kCeilingRules[] = {
    {BadCeiling, [](auto& c) { return !(positive(c.max) && indexOf(c.quantity) < kQuantityCount); },
     [](auto& c) { return invalid("the profile's ceiling is {}; a finite number above 0 is needed", c.max); }},
};

struct CeilingBesideRow {
    const Ceiling& ceiling;
    const LimitSet& set;
    const LimitRow& row;
};

constexpr Rule<CeilingBesideRow> kTighteningRules[] = {
    {LoosenedCeiling,
     [](auto& c) {
         const bool same = c.row.quantity == c.ceiling.quantity && c.row.action == LimitAction::Refuse;
         return same && !(c.ceiling.max <= c.row.max);
     },
     [](auto& c) {
         return invalid(
             "the profile's ceiling on {} is {:.6g} {}; {} allows {:.6g} {}, and a profile may only tighten it",
             titleOf(c.ceiling.quantity), c.ceiling.max, unitOf(c.ceiling.quantity), c.set.id, c.row.max,
             unitOf(c.row.quantity));
     }},
};

std::size_t rowsOf(const GateSetup& setup) noexcept {
    std::size_t rows = setup.ceilings.size() + kShown.size();
    for (const auto& set : setup.limits) rows += set.rows.size();
    return rows;
}

constexpr Rule<GateSetup> kTableRules[] = {
    {TooManyLimits, [](auto& s) { return rowsOf(s) > kMaxExposureRows; },
     [](auto& s) {
         return invalid("the limit sets and the profile's ceilings hold {} limits; at most {} can be watched at once",
                        rowsOf(s) - kShown.size(), kMaxExposureRows - kShown.size());
     }},
};

Result<void> checkLimits(const GateSetup& setup) {
    if (auto sound = judge(kTableRules, setup); !sound) return sound;
    for (const auto& set : setup.limits) {
        for (const auto& row : set.rows) {
            if (auto sound = judge(kRowRules, RowOfSet{set, row}); !sound) return sound;
        }
    }
    if (auto sound = judge(kSetRules, setup.limits); !sound) return sound;
    for (const auto& ceiling : setup.ceilings) {
        if (auto sound = judge(kCeilingRules, ceiling); !sound) return sound;
        for (const auto& set : setup.limits) {
            for (const auto& row : set.rows) {
                if (auto sound = judge(kTighteningRules, CeilingBesideRow{ceiling, set, row}); !sound) return sound;
            }
        }
    }
    return {};
}

// --- source ---------------------------------------------------------------------------------------------------------

/// Returns the first stated accuracy that is not valid.
std::optional<Spread> unsoundAccuracy(const SourceTraits& s) noexcept {
    const auto& of = s.accuracy;
    for (const auto& stated : {of.amplitude, of.phaseWidth, of.gap, of.interval, of.rate}) {
        if (stated && !stated->sound()) return stated;
    }
    return std::nullopt;
}

constexpr Rule<SourceTraits> kSourceRules[] = {
    {SourceDrive, [](auto& s) { return s.drive != Drive::Voltage && s.drive != Drive::Current; },
     [](auto&) { return invalid("the source drives neither voltage nor current"); }},
    {SourceAmplitudeMax, [](auto& s) { return !positive(s.amplitudeMax); },
     [](auto& s) { return invalid("the source's largest amplitude is {}; it must be above 0", s.amplitudeMax); }},
    {SourceAmplitudeStep, [](auto& s) { return !notNegative(s.amplitudeStep); },
     [](auto& s) { return invalid("the source's amplitude step is {}; 0 or more is needed", s.amplitudeStep); }},
    {SourceWidths,
     [](auto& s) {
         return !(notNegative(s.widthStep.count()) && notNegative(s.widthMin.count()) && positive(s.widthMax.count()));
     },
     [](auto& s) {
         return invalid("the source's pulse widths are {} to {} us in steps of {} us; finite numbers are needed",
                        s.widthMin.count(), s.widthMax.count(), s.widthStep.count());
     }},
    {SourcePulses, [](auto& s) { return s.pulsesMax < 1; },
     [](auto& s) { return invalid("the source allows {} pulses a train; 1 or more are needed", s.pulsesMax); }},
    {SourceCompliance, [](auto& s) { return !notNegative(s.compliance.value()); },
     [](auto& s) {
         return invalid("the source states a compliance of {} V; 0 or more is needed", s.compliance.value());
     }},
    {SourceCurrentLimit, [](auto& s) { return !notNegative(s.currentLimit.value()); },
     [](auto& s) {
         return invalid("the source states a current limit of {} mA; 0 or more is needed", s.currentLimit.value());
     }},
    {SourceNoCompliance, [](auto& s) { return s.drive == Drive::Current && !positive(s.compliance.value()); },
     [](auto&) { return invalid("the current source states no compliance; its voltage could not be judged"); }},
    {SourceAccuracy, [](auto& s) { return unsoundAccuracy(s).has_value(); },
     [](auto& s) {
         const Spread stated = unsoundAccuracy(s).value_or(Spread{});
         return invalid("the source states an accuracy of {} % and {}; 0 or more and less than 100 % are needed",
                        100 * stated.relative, stated.absolute);
     }},
};

// --- load, electrode, calibration -----------------------------------------------------------------------------------

bool soundLoad(const Load& load) noexcept {
    if (load.kind == LoadKind::Short) return true;
    if (load.kind == LoadKind::Resistor) return positive(load.series.value());
    if (load.kind != LoadKind::SkinEquivalent) return false;
    const Circuit circuit = circuitAt(load, 0);
    return positive(load.series.value()) && positive(load.parallel.value()) && positive(circuit.capacitance_F) &&
           notNegative(load.halvingVoltage.value());
}

Result<void> checkCalibration(const GateSetup& s) {
    if (!s.calibration) return {};
    return s.calibrated ? validate(*s.calibration) : validateNumbers(*s.calibration);
}

constexpr Rule<GateSetup> kSetupRules[] = {
    {BadLoad,
     [](auto& s) {
         const bool person = s.mode == OutputMode::Person;  // judged at the measured or the profile's loads instead
         return !person && !(soundLoad(s.load.min) && soundLoad(s.load.max) && soundLoad(s.load.nominal));
     },
     [](auto& s) {
         return invalid(
             "the declared load {} cannot be judged: a resistance or a skin equivalent is needed, open is a trip test",
             s.load.nominal.text());
     }},
    {BadArea, [](auto& s) { return s.electrodeArea && !positive(s.electrodeArea->value()); },
     [](auto& s) {
         return invalid("the electrode area is {} cm2; a finite area above 0 is needed", s.electrodeArea->value());
     }},
    {BadCalibration, [](auto& s) { return !checkCalibration(s); },
     [](auto& s) { return failure(checkCalibration(s)); }},
};

// --- person ---------------------------------------------------------------------------------------------------------

struct Personal {
    const GateSetup& setup;
    const PersonSetup& person;  // default values if no person is set
};

constexpr Rule<Personal> kPersonRules[] = {
    {PersonMissing, [](auto& p) { return !p.setup.person; },
     [](auto&) { return invalid("person mode needs a person's consent, limits and ramp step"); }},
    {PersonConsent, [](auto& p) { return !p.person.consentRecorded; },
     [](auto&) { return invalid("person mode needs a recorded consent"); }},
    {PersonPseudonym, [](auto& p) { return p.person.participant.empty(); },
     [](auto&) {
         return invalid("person mode needs the participant's pseudonym: accepted levels belong to one person");
     }},
};

/// The requirements for a person at electrodes.
constexpr Rule<Personal> kElectrodeRules[] = {
    {PersonArea, [](auto& p) { return !p.setup.electrodeArea; },
     [](auto&) { return invalid("person mode needs the electrode area in cm2"); }},
    {PersonVoltageSource, [](auto& p) { return p.setup.source.drive != Drive::Current; },
     [](auto&) { return invalid("a voltage source is refused for a person; a current source is needed"); }},
    {PersonMonophasicCheck, [](auto& p) { return p.setup.check.shape == PulseShape::Monophasic; },
     [](auto&) { return invalid("a monophasic check pulse is refused for a person; a biphasic one is needed"); }},
    {PersonCalibration,
     [](auto& p) { return !(p.setup.calibration && p.setup.calibrated && p.setup.calibration->complete()); },
     [](auto&) {
         return invalid(
             "the stimulator is not calibrated; a valid calibration of amplitude, interval, phase width and gap is "
             "needed before a person");
     }},
    {PersonDiscomfort, [](auto& p) { return !positive(p.person.discomfortLimit.value()); },
     [](auto& p) {
         return invalid("the personal discomfort limit is {} mA; a finite current above 0 is needed",
                        p.person.discomfortLimit.value());
     }},
    {PersonRampStep, [](auto& p) { return !positive(p.person.rampStep.value()); },
     [](auto& p) {
         return invalid("the ramp step is {} mA; a finite current above 0 is needed", p.person.rampStep.value());
     }},
    {PersonCap, [](auto& p) { return p.person.cap && !positive(p.person.cap->value()); },
     [](auto& p) {
         return invalid("the study's cap is {} mA; a finite current above 0 is needed", p.person.cap->value());
     }},
    {PersonImpedanceBounds,
     [](auto& p) {
         const double low = p.person.impedanceLow.value();
         const double high = p.person.impedanceHigh.value();
         return !(positive(low) && std::isfinite(high) && low < high);
     },
     [](auto& p) {
         return invalid("a person's impedance range of {} to {} ohm is not one", p.person.impedanceLow.value(),
                        p.person.impedanceHigh.value());
     }},
};

bool isShare(double value) noexcept { return value > 0 && value <= 1; }

/// The requirements for a person at a massager.
constexpr Rule<PersonVibration> kVibrationRules[] = {
    {PersonVibrationLimit, [](auto& v) { return !isShare(v.discomfortLimit); },
     [](auto& v) {
         return invalid("the personal discomfort limit is intensity {}; above 0 to 1 is needed", v.discomfortLimit);
     }},
    {PersonVibrationStep, [](auto& v) { return !isShare(v.rampStep); },
     [](auto& v) { return invalid("the ramp step is intensity {}; above 0 to 1 is needed", v.rampStep); }},
};

Result<void> checkPerson(const GateSetup& setup) {
    if (setup.mode != OutputMode::Person) return {};
    const Personal personal{setup, setup.person ? *setup.person : PersonSetup{}};
    if (auto sound = judge(kPersonRules, personal); !sound) return sound;
    if (personal.person.vibration) return judge(kVibrationRules, *personal.person.vibration);
    return judge(kElectrodeRules, personal);
}

// --- check pulse ----------------------------------------------------------------------------------------------------

Result<void> checkCheckTrain(const GateSetup& setup) {
    const PulseTrain check = checkTrainOf(setup);
    return checkRequest(check, checkInterval(check), setup.source);
}

constexpr Rule<GateSetup> kCheckTrainRules[] = {
    {BadCheckTrain, [](auto& s) { return !checkCheckTrain(s); },
     [](auto& s) {
         return invalid("the impedance check cannot be delivered: {}", checkCheckTrain(s).error().message);
     }},
};
}  // namespace

Result<void> checkSetup(const GateSetup& setup) {
    if (auto sound = checkLimits(setup); !sound) return sound;
    if (auto sound = judge(kSourceRules, setup.source); !sound) return sound;
    if (auto sound = judge(kSetupRules, setup); !sound) return sound;
    if (auto sound = checkPerson(setup); !sound) return sound;
    return judge(kCheckTrainRules, setup);
}

}  // namespace tacto::gate
