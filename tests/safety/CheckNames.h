// CheckNames.h - the table of all checks that have a case in GateCases. A check added to Rules.h but not to this table
// fails to compile.
//
// Thread-safety: constant.
#pragma once

#include <array>
#include <string_view>

#include "core/safety/Rules.h"

namespace tacto::test {

struct CheckName {
    gate::Check check;
    std::string_view name;
};
#define TACTO_CHECK(name) \
    CheckName { gate::name, #name }
inline constexpr std::array kCheckNames{
    TACTO_CHECK(NoLimitSet),
    TACTO_CHECK(BadLimitRow),
    TACTO_CHECK(BadCeiling),
    TACTO_CHECK(LoosenedCeiling),
    TACTO_CHECK(TooManyLimits),
    TACTO_CHECK(SourceDrive),
    TACTO_CHECK(SourceAmplitudeMax),
    TACTO_CHECK(SourceAmplitudeStep),
    TACTO_CHECK(SourceWidths),
    TACTO_CHECK(SourcePulses),
    TACTO_CHECK(SourceCompliance),
    TACTO_CHECK(SourceCurrentLimit),
    TACTO_CHECK(SourceNoCompliance),
    TACTO_CHECK(SourceAccuracy),
    TACTO_CHECK(BadLoad),
    TACTO_CHECK(BadArea),
    TACTO_CHECK(BadCheckTrain),
    TACTO_CHECK(PersonMissing),
    TACTO_CHECK(PersonConsent),
    TACTO_CHECK(PersonPseudonym),
    TACTO_CHECK(PersonArea),
    TACTO_CHECK(PersonDiscomfort),
    TACTO_CHECK(PersonRampStep),
    TACTO_CHECK(PersonCap),
    TACTO_CHECK(PersonImpedanceBounds),
    TACTO_CHECK(PersonVoltageSource),
    TACTO_CHECK(PersonMonophasicCheck),
    TACTO_CHECK(PersonCalibration),
    TACTO_CHECK(PersonVibrationLimit),
    TACTO_CHECK(PersonVibrationStep),
    TACTO_CHECK(BadCalibration),
    TACTO_CHECK(ImpedanceValue),
    TACTO_CHECK(ImpedanceFromFuture),
    TACTO_CHECK(ImpedanceOutOfRange),
    TACTO_CHECK(ImpedanceJump),
    TACTO_CHECK(MoreThanProgrammed),
    TACTO_CHECK(LevelMoreThanProgrammed),
    TACTO_CHECK(Uncertainty),
    TACTO_CHECK(PulseBeyondPeriod),
    TACTO_CHECK(LongWithoutDeadMan),
    TACTO_CHECK(PastUnknown),
    TACTO_CHECK(MeterFull),
    TACTO_CHECK(MeterBooking),
    TACTO_CHECK(RecordBooking),
    TACTO_CHECK(MalformedTrain),
    TACTO_CHECK(SourceKind),
    TACTO_CHECK(AmplitudeMax),
    TACTO_CHECK(AmplitudeGrid),
    TACTO_CHECK(WidthRange),
    TACTO_CHECK(WidthGrid),
    TACTO_CHECK(GapGrid),
    TACTO_CHECK(PulsesMax),
    TACTO_CHECK(IntervalValue),
    TACTO_CHECK(IntervalBelowTrain),
    TACTO_CHECK(IntervalMayBeBelowTrain),
    TACTO_CHECK(OnsetAhead),
    TACTO_CHECK(CheckOnsetAhead),
    TACTO_CHECK(ImpedanceRejected),
    TACTO_CHECK(PersonMonophasic),
    TACTO_CHECK(PersonNoImpedance),
    TACTO_CHECK(PersonStaleImpedance),
    TACTO_CHECK(PersonBeyondAmplitude),
    TACTO_CHECK(PersonBeyondWidth),
    TACTO_CHECK(PersonBeyondInterval),
    TACTO_CHECK(PersonLevel),
    TACTO_CHECK(CheckDiscomfort),
    TACTO_CHECK(LevelOfPerson),
    TACTO_CHECK(DiscomfortOfPerson),
    TACTO_CHECK(LevelMalformed),
    TACTO_CHECK(LevelInVolts),
    TACTO_CHECK(LevelDiscomfort),
    TACTO_CHECK(LevelCap),
    TACTO_CHECK(LevelRamp),
    TACTO_CHECK(LevelAccept),
    TACTO_CHECK(DiscomfortValue),
    TACTO_CHECK(BurstIntensity),
    TACTO_CHECK(BurstDuration),
    TACTO_CHECK(BurstAtElectrodes),
    TACTO_CHECK(BurstDiscomfort),
    TACTO_CHECK(BurstRamp),
    TACTO_CHECK(IntensityOfPerson),
    TACTO_CHECK(IntensityMalformed),
    TACTO_CHECK(IntensityAccept),
    TACTO_CHECK(IntensityDiscomfort),
    TACTO_CHECK(Epoch),
    TACTO_CHECK(Expiry),
    TACTO_CHECK(InterlockMove),
    TACTO_CHECK(ArmRequestState),
    TACTO_CHECK(ArmConfirmState),
    TACTO_CHECK(ArmTicket),
    TACTO_CHECK(ArmState),
    TACTO_CHECK(ArmLimits),
    TACTO_CHECK(ArmIdentity),
    TACTO_CHECK(ArmOperator),
    TACTO_CHECK(ArmImpedanceMissing),
    TACTO_CHECK(ArmImpedanceRange),
    TACTO_CHECK(ArmImpedanceAge),
    TACTO_CHECK(ResetState),
    TACTO_CHECK(ResetCause),
    TACTO_CHECK(ResetSeen),
    TACTO_CHECK(ResetGrave),
    TACTO_CHECK(TrainNoStatus),
    TACTO_CHECK(TrainGarbage),
    TACTO_CHECK(TrainOpen),
    TACTO_CHECK(TrainShort),
    TACTO_CHECK(TrainNetCharge),
    TACTO_CHECK(TrainStuckOn),
    TACTO_CHECK(TrainStatusLate),
    TACTO_CHECK(TrainNeverRead),
    TACTO_CHECK(TrainReadEarly),
    TACTO_CHECK(HeartSilent),
    TACTO_CHECK(HeartNever),
    TACTO_CHECK(HeartLate),
};
#undef TACTO_CHECK
static_assert(kCheckNames.size() == gate::kNamedChecks, "a check has no case: write one, then add it here");
static_assert([] {
    for (std::size_t k = 0; k < kCheckNames.size(); ++k) {
        if (kCheckNames[k].check != static_cast<int>(k)) return false;
    }
    return true;
}());

}  // namespace tacto::test
