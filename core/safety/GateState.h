// GateState.h - internal: what the gate knows between two requests, and the judgements that need all of it.
//
// Thread-safety: as SafetyGate: one caller.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/safety/AcceptedLevels.h"
#include "core/safety/ExposureMeter.h"
#include "core/safety/GateChecks.h"
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
    struct Residual {
        double volts = 0;  // The most that may be left on the load ...
        Instant at{0};     // ... at this moment
    };
    std::array<Residual, 2> residuals;  // by what the source that left it does at rest, in the order of GapState

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
    /// What a train counts as: the larger amplitude of what the stimulator is told and what it may deliver.
    [[nodiscard]] PulseTrain judgedAs(const PulseTrain& train) const noexcept;
    /// What was commanded: of a calibrated stimulator what it delivers, else what it is told.
    [[nodiscard]] PulseTrain commandOf(const PulseTrain& train) const noexcept;
    /// What an accepted level counts as: the smaller of what the stimulator was told and what it may have delivered.
    [[nodiscard]] PulseTrain feltAs(const PulseTrain& train) const noexcept;
    /// Between which an interval may come out: the shortest gives the most exposure, the longest the lowest band.
    [[nodiscard]] TimeRange intervalsOf(Seconds told) const noexcept;
    /// How much longer a window of real time may last by the clock that trains are booked on: 1 or more.
    [[nodiscard]] double stretchAt(Seconds told) const noexcept;
    /// `exposure`, a function of a train, at its worst over the phase widths and gaps that `judged` may come out with.
    template <class Exposure>
    [[nodiscard]] TrainExposure worstOf(const PulseTrain& judged, Exposure exposure) const noexcept {
        TrainExposure worst = exposure(judged);
        const auto& known = setup->calibration;
        if (!known || !gate::checks(gate::MoreThanTold)) return worst;
        const auto width = deliveredRange(judged.phaseWidth, known->phaseWidth);
        const auto gap = deliveredRange(judged.interPhaseGap, known->gap);
        for (const Seconds w : {width.least, width.most}) {
            for (const Seconds g : {gap.least, gap.most}) {
                PulseTrain out = judged;
                out.phaseWidth = w;
                out.interPhaseGap = g;
                if (out != judged) worst = worse(worst, exposure(out));
            }
        }
        return worst;
    }
    /// Errors: LimitExceeded where a person's request leaves the range in which the stimulator was calibrated, to the
    /// side that adds exposure, by more than it may be off.
    [[nodiscard]] Result<void> withinCalibration(const TrainRequest& request) const;
    [[nodiscard]] double carriedAt(Instant now) const noexcept;
    /// A request on its way through the judgement.
    struct Judged {
        PulseTrain train;      // as judgedAs() gave it
        TimeRange intervals;   // between which its interval may come out
        double stretch = 1;    // as stretchAt() gave it
        double carried_V = 0;  // what it may find on the load
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
