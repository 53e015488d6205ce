// GateState.h - internal: what the gate knows between two requests, and the figures that need all of it.
//
// Thread-safety: as SafetyGate: one caller.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/safety/AcceptedLevels.h"
#include "core/safety/DeliveryBounds.h"
#include "core/safety/ExposureMeter.h"
#include "core/safety/GateRules.h"
#include "core/safety/UnitRecord.h"

namespace tacto::gate {

struct State {
    std::optional<GateSetup> setup;        // nothing: everything is refused
    std::optional<DeliveryBounds> bounds;  // the bounds of what the setup may deliver
    std::vector<ActiveLimit> limits;
    LoadRange load;
    double area = 0;
    PulseTrain check;
    PulseTrain lastTrain;

    ExposureMeter meter;
    ResidualVoltages residuals;
    UnitRecord* record = nullptr;  // the unit's; null: none is kept

    std::optional<Ohms> impedance;
    Instant impedanceAt{std::numeric_limits<Instant::rep>::min()};
    std::optional<Ohms> lastGood;    // the newest good one since configure(), whatever came after it
    bool impedanceRejected = false;  // the last reading was not a number or out of range

    std::map<std::string, AcceptedLevels> people;         // a participant who comes back keeps the accepted levels
    AcceptedLevels none;                                  // permits nothing
    AcceptedLevels* levels = &none;                       // the current participant's, in people; without one, none
    std::map<std::string, AcceptedIntensities> vibrated;  // intensities that each participant at a massager accepted
    AcceptedIntensities noIntensities;                    // permits nothing
    AcceptedIntensities* intensities = &noIntensities;

    [[nodiscard]] bool person() const noexcept { return setup && setup->mode == OutputMode::Person; }
    /// A person at a massager.
    [[nodiscard]] bool vibrates() const noexcept { return person() && setup->person && setup->person->vibration; }
    /// A / |Z| and back, or a calibration and back, may end a few bits above A; else a command is exact.
    [[nodiscard]] bool commandIsComputed() const noexcept {
        return setup && (setup->source.drive == Drive::Current || setup->calibration.has_value());
    }
    /// The rest of the residual voltage at `now`, on the load that keeps it longest.
    [[nodiscard]] double carriedAt(Instant now) const noexcept;
    /// Whether a reading belongs to the declared load.
    [[nodiscard]] bool agreesWithDeclared(double ohm) const noexcept;
    /// The declared load as it was measured after lastTrain: A was divided by this |Z|, so the command is judged on it.
    [[nodiscard]] Load measuredLoad(Ohms magnitude) const noexcept;
};

/// A train on its way through the limits.
struct JudgedTrain {
    PulseTrain command;        // the wanted train, for the figure beside the worst case
    Seconds interval{0};       // the interval that was asked for
    Range<Seconds> intervals;  // the two values between which it may come out
    double stretch = 1;        // as DeliveryBounds::stretch()
    double carried_V = 0;      // the voltage that it may find on the load
    TrainExposure overRange, at500;
    /// The frequency for bands: the lowest.
    [[nodiscard]] double hz() const noexcept { return 1 / intervals.most.count(); }
    /// Whether the row belongs to a band in which the train may come out.
    [[nodiscard]] bool fallsUnder(const LimitRow& row) const noexcept {
        return row.holdsAt(hz()) || row.holdsAt(1 / intervals.least.count());
    }
};

}  // namespace tacto::gate
