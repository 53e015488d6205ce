// GateState.h - internal: what the gate knows between two requests, and the judgements that need all of it.
//
// Thread-safety: as SafetyGate: one caller.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/safety/AcceptedLevels.h"
#include "core/safety/ExposureMeter.h"
#include "core/safety/GateRules.h"
#include "core/safety/SafetyGate.h"

namespace tacto {

struct SafetyGate::State {
    std::optional<GateSetup> setup;  // Nothing: everything is refused
    std::vector<gate::ActiveLimit> limits;
    LoadRange load;
    double area = 0;
    PulseTrain check;
    PulseTrain lastTrain;

    ExposureMeter meter;
    double residual_V = 0;  // The most that may be left on the load ...
    Instant residualAt{0};  // ... at this moment

    std::optional<Ohms> impedance;
    Instant impedanceAt{std::numeric_limits<Instant::rep>::min()};
    std::optional<Ohms> lastGood;  // Since configure(), whatever came after it
    bool disowned = false;         // The last reading was no number or out of range

    std::map<std::string, AcceptedLevels> people;  // Who comes back has not forgotten
    AcceptedLevels nobody;                         // Permits nothing
    AcceptedLevels* levels = &nobody;              // Of the person set up now: in people

    [[nodiscard]] bool person() const noexcept { return setup->mode == OutputMode::Person; }
    /// A / |Z| and back, or a calibration and back, may end a few bits above A; else a command is exact.
    [[nodiscard]] bool commandIsComputed() const noexcept {
        return setup && (setup->source.drive == Drive::Current || setup->calibration.has_value());
    }
    /// What a train counts as: the larger of what the stimulator is told and what it may deliver.
    [[nodiscard]] PulseTrain judgedAs(const PulseTrain& train) const noexcept;
    /// How much of that is the command: of a calibrated stimulator what it delivers, else what it is told.
    [[nodiscard]] double commandShare(const PulseTrain& train) const noexcept;
    /// What an accepted level counts as: the smaller of what the stimulator was told and what it may have delivered.
    [[nodiscard]] PulseTrain feltAs(const PulseTrain& train) const noexcept;
    [[nodiscard]] double carriedAt(Instant now) const noexcept;
    /// `judged`: as judgedAs() gave it; `share`: how much of its amplitude is the command.
    [[nodiscard]] Result<void> judge(const TrainExposure& overRange, const TrainExposure& at500,
                                     const PulseTrain& judged, double share, Seconds interval, double carried_V) const;
    [[nodiscard]] Result<void> judgeMetered(const TrainExposure& overRange, const TrainExposure& at500, double hz,
                                            Instant now) const;
    [[nodiscard]] bool agreesWithDeclared(double ohm) const noexcept;
};

}  // namespace tacto
