// The figures of a stimulator's calibration: gain, offset, and the error at each judged level.
#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/calibration/CalibrationVerdict.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/coverage/CoverageTable.h"
#include "tests/coverage/TwinRuns.h"

namespace tacto::test {
namespace {

constexpr std::size_t kLevels = 11;
constexpr int kRepeats = 5;  // in each direction
constexpr double kSweepRange_v = 52;

enum class Quantity { Amplitude, Width, Gap, Interval };

struct Asked {
    Quantity quantity;
    const char* name;
    double low, high;
    [[nodiscard]] double level(std::size_t k) const {
        return low + (high - low) * static_cast<double>(k) / static_cast<double>(kLevels - 1);
    }
};

constexpr Asked kAsked[] = {{Quantity::Amplitude, "amplitude", 10, 40},
                            {Quantity::Width, "width", 100e-6, 400e-6},
                            {Quantity::Gap, "gap", 100e-6, 400e-6},
                            {Quantity::Interval, "interval", 0.5, 2}};

/// The instrument's errors as the run knows them: from the captures.
InstrumentErrors statedBy(const Capture& capture, Quantity quantity) {
    InstrumentErrors out;
    if (quantity != Quantity::Amplitude) {
        out.gainTolerance = capture.timeBaseTolerance;
        out.resolution = 0;
        out.samplingStep = 1 / capture.rate_hz;
        if (quantity == Quantity::Interval) out.stampTolerance = capture.stampTolerance_s;
        return out;
    }
    const auto& voltage = capture.channels.front();
    out.gainTolerance = voltage.gainTolerance;
    out.probeTolerance = voltage.probeTolerance;
    out.linearityTolerance = voltage.linearityTolerance;
    out.resolution = voltage.lsb;
    out.fullScale = voltage.high;
    return out;
}

class Sweep {
public:
    Sweep(TwinRuns& runs, const Asked& asked) : runs_(runs), asked_(asked) {
        for (int repeat = 0; repeat < kRepeats; ++repeat) {
            for (std::size_t k = 0; k < kLevels; ++k) read(k, SweepDirection::Up);
            for (std::size_t k = kLevels; k-- > 0;) read(k, SweepDirection::Down);
        }
    }
    [[nodiscard]] JudgedCalibration judged(std::uint64_t seed) const {
        return judgeCalibration(fitCalibration(readings_, {.resolution = stated_.samplingStep}).value(), stated_, 2,
                                {seed, 2000})
            .value();
    }
    [[nodiscard]] double truth(double commanded) const {
        switch (asked_.quantity) {
            case Quantity::Amplitude:
                return runs_.truth.volts(commanded);
            case Quantity::Width:
                return commanded + runs_.truth.width_s;
            case Quantity::Gap:
                return commanded + runs_.truth.gap_s;
            case Quantity::Interval:
                break;
        }
        return commanded;
    }

private:
    [[nodiscard]] std::vector<Capture> capturesOf(double level) {
        const bool width = asked_.quantity == Quantity::Width, gap = asked_.quantity == Quantity::Gap;
        const double volts = asked_.quantity == Quantity::Amplitude ? level : 10;
        const auto train = twinTrain(volts, width ? 1e6 * level : 200, gap ? 1e6 * level : 100);
        if (asked_.quantity == Quantity::Interval) return runs_.captured({train, train}, kSweepRange_v, {level});
        return {runs_.captured(train, kSweepRange_v)};
    }
    void read(std::size_t k, SweepDirection direction) {
        const double level = asked_.level(k);
        const auto captures = capturesOf(level);
        stated_ = statedBy(captures.front(), asked_.quantity);
        const auto found = measureTrains(captures, "voltage", {}).value();
        const double values[] = {found.amplitude.mean, found.width_s.mean, found.gap_s.mean, found.interval_s.mean};
        readings_.push_back({level, values[static_cast<std::size_t>(asked_.quantity)], direction});
    }

    TwinRuns& runs_;
    const Asked asked_;
    std::vector<CalibrationReading> readings_;
    InstrumentErrors stated_;
};

void addLevels(CoverageTable& table, const std::string& name, const Sweep& sweep, const JudgedCalibration& judged) {
    for (const auto& [where, k] :
         {std::pair("lowest", std::size_t{0}), {"middle", kLevels / 2}, {"largest", kLevels - 1}}) {
        const auto& level = judged.levels[k];
        const double truth = sweep.truth(level.commanded) - level.commanded;
        table.add(name + " error, " + where + " level", truth, level.error, level.budget.expanded);
        table.add(name + " error judged, " + where + " level", truth, level.worstError, level.worstBudget.expanded);
    }
}

TEST(Coverage, StimulatorCalibration) {
    RecordProperty("hazard", "H9");
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= coverageRuns(); ++seed) {
        TwinRuns runs(seed);
        for (const auto& asked : kAsked) {
            const Sweep sweep(runs, asked);
            const auto judged = sweep.judged(seed);
            const std::string name = asked.name;
            const double step = asked.high - asked.low;
            const double gain = (sweep.truth(asked.high) - sweep.truth(asked.low)) / step;
            table.add(name + " gain", gain, judged.calibration.gain, judged.gain.expanded);
            table.add(name + " offset", sweep.truth(asked.low) - gain * asked.low, judged.calibration.offset,
                      judged.offset.expanded);
            addLevels(table, name, sweep, judged);
        }
    }
    for (const char* times : {"width", "gap"})
        table.promise(times,
                      {.mostWithinHalf = 0.92,
                       .because = "edges faster than a sample read as whole samples: a mean errs little, or much"});
    table.judge("stimulator calibration");
}

}  // namespace
}  // namespace tacto::test
