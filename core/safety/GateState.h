// GateState.h - internal: the gate's knowledge between two requests, and the values computed from it.
//
// Thread-safety: one caller, as SafetyGate.
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
    std::optional<GateSetup> setup;        // nothing: every request is refused
    std::optional<DeliveryBounds> bounds;  // the range of what the setup may deliver
    std::vector<ActiveLimit> limits;
    LoadRange load;
    double area = 0;
    PulseTrain check;
    PulseTrain lastTrain;

    ExposureMeter meter;
    ResidualVoltages residuals;
    UnitRecord* record = nullptr;  // the unit's record; null: none is kept

    std::optional<Ohms> impedance;
    Instant impedanceAt{std::numeric_limits<Instant::rep>::min()};
    std::optional<Ohms> lastGood;    // the newest good reading since configure(), even if bad ones followed
    bool impedanceRejected = false;  // the last reading was not a number or out of range

    std::map<std::string, AcceptedLevels> people;         // accepted levels, kept for a participant who returns
    AcceptedLevels none;                                  // permits no level
    AcceptedLevels* levels = &none;                       // the present participant's entry in people, or none
    std::map<std::string, AcceptedIntensities> vibrated;  // accepted intensities by participant at a massager
    AcceptedIntensities noIntensities;                    // permits no intensity
    AcceptedIntensities* intensities = &noIntensities;

    [[nodiscard]] bool person() const noexcept { return setup && setup->mode == OutputMode::Person; }
    /// True for a person at a massager.
    [[nodiscard]] bool vibrates() const noexcept { return person() && setup->person && setup->person->vibration; }
    /// True if commands are computed: A / |Z| or a calibration, and back, may end a few bits above A. Otherwise exact.
    [[nodiscard]] bool commandIsComputed() const noexcept {
        return setup && (setup->source.drive == Drive::Current || setup->calibration.has_value());
    }
    /// Returns what is left of the residual voltage at `now`, on the load that keeps it longest.
    [[nodiscard]] double carriedAt(Instant now) const noexcept;
    /// True if a reading fits the declared load.
    [[nodiscard]] bool agreesWithDeclared(double ohm) const noexcept;
    /// Returns the declared load as measured after lastTrain; commands are judged with the |Z| by which A was divided.
    [[nodiscard]] Load measuredLoad(Ohms magnitude) const noexcept;
};

/// A train while the limits judge it.
struct JudgedTrain {
    PulseTrain command;        // the wanted train, for the value shown next to the worst case
    Seconds interval{0};       // the interval as requested
    Range<Seconds> intervals;  // the range in which it may come out
    double stretch = 1;        // see DeliveryBounds::stretch()
    double carried_V = 0;      // the voltage that the train may find on the load
    TrainExposure overRange, at500;
    NearestLimit nearest;  // of the limits that were checked so far
    /// The frequency for selecting bands: the lowest possible.
    [[nodiscard]] double hz() const noexcept { return 1 / intervals.most.count(); }
    /// True if the row belongs to a band in which the train may come out.
    [[nodiscard]] bool fallsUnder(const LimitRow& row) const noexcept {
        return row.holdsAt(hz()) || row.holdsAt(1 / intervals.least.count());
    }
};

}  // namespace tacto::gate
