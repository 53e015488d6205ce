// GateState.h - internal: what the gate knows between two requests, and the judgements that need all of it.
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
#include "core/safety/GateChecks.h"
#include "core/safety/GateRules.h"
#include "core/safety/SafetyGate.h"
#include "core/safety/UnitRecord.h"

namespace tacto {

struct SafetyGate::State {
    std::optional<GateSetup> setup;        // Nothing: everything is refused
    std::optional<DeliveryBounds> bounds;  // of setup
    std::vector<gate::ActiveLimit> limits;
    LoadRange load;
    double area = 0;
    PulseTrain check;
    PulseTrain lastTrain;

    ExposureMeter meter;
    ResidualVoltages residuals;
    UnitRecord* record = nullptr;  // Of the unit; null: none is kept

    std::optional<Ohms> impedance;
    Instant impedanceAt{std::numeric_limits<Instant::rep>::min()};
    std::optional<Ohms> lastGood;    // Since configure(), whatever came after it
    bool impedanceRejected = false;  // The last reading was no number or out of range

    std::map<std::string, AcceptedLevels> people;  // Who comes back has not forgotten
    AcceptedLevels nobody;                         // Permits nothing
    AcceptedLevels* levels = &nobody;              // Of the person set up now: in people

    [[nodiscard]] bool person() const noexcept { return setup->mode == OutputMode::Person; }
    /// A / |Z| and back, or a calibration and back, may end a few bits above A; else a command is exact.
    [[nodiscard]] bool commandIsComputed() const noexcept {
        return setup && (setup->source.drive == Drive::Current || setup->calibration.has_value());
    }
    /// Errors: LimitExceeded where a person's request leaves the range in which the stimulator was calibrated, to the
    /// side that adds exposure, by more than it may be off.
    [[nodiscard]] Result<void> withinCalibration(const TrainRequest& request) const;
    [[nodiscard]] double carriedAt(Instant now) const noexcept;
    /// A request on its way through the judgement.
    struct Judged {
        PulseTrain command;            // what it should come out as, for the figure beside the worst case
        Seconds interval{0};           // as it was asked for
        TimeRange<Seconds> intervals;  // between which it may come out
        double stretch = 1;            // as DeliveryBounds::stretch()
        double carried_V = 0;          // what it may find on the load
        TrainExposure overRange, at500;
        /// For frequency bands: the lowest.
        [[nodiscard]] double hz() const noexcept { return 1 / intervals.most.count(); }
        /// Whether the row belongs to a band that the train may come out in.
        [[nodiscard]] bool fallsUnder(const LimitRow& row) const noexcept {
            return row.holdsAt(hz()) || row.holdsAt(1 / intervals.least.count());
        }
    };
    [[nodiscard]] Result<void> judge(const Judged& request) const;
    [[nodiscard]] Result<void> judgeMetered(const Judged& request, Instant now) const;
    [[nodiscard]] bool agreesWithDeclared(double ohm) const noexcept;
    /// The declared load as it was measured after lastTrain: A was divided by this |Z|, so the command is judged on it.
    [[nodiscard]] Load measuredLoad(Ohms magnitude) const noexcept;
};

}  // namespace tacto
