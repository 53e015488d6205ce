// Ratios of two captured trains in just noticeable differences: errors of gain and time base that both share cancel.
#include <cmath>
#include <gtest/gtest.h>

#include "core/analysis/separability/Separability.h"
#include "core/analysis/transitions/CapturedChange.h"
#include "core/measure/PulseMeasurement.h"
#include "tests/coverage/CoverageTable.h"
#include "tests/coverage/TwinRuns.h"

namespace tacto::test {
namespace {

constexpr double kFrom_v = 20, kTo_v = 23, kFrom_s = 0.5, kTo_s = 0.55, kComparedRange_v = 60;
const double kAmplitudeJnd = std::log(1.10), kIntervalJnd = std::log(1.16);

struct Compared {
    double amplitude_v, own_v, gain;  ///< amplitude; error of this level alone; relative error of the gain
    double onset_s, onset_u_s;
    double interval_s = kNaN, interval_u_s = kNaN;
};

Compared comparedFrom(const Capture& capture) {
    const auto found = measureTrains({&capture, 1}, "voltage", {}).value();
    const auto& channel = capture.channels.front();
    const double gain = channel.gainTolerance / std::sqrt(3.0) * found.amplitude.mean;
    const double shared = std::hypot(gain, channel.linearityTolerance / std::sqrt(3.0), channel.lsb / std::sqrt(12.0));
    const double u = found.uncertainty.amplitude;
    return {found.amplitude.mean, std::sqrt(u * u - shared * shared), gain / found.amplitude.mean,
            found.trains.front().onset_s, 1 / capture.rate_hz / std::sqrt(12.0)};
}

TEST(Coverage, StepsFromTrainToTrain) {
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= coverageRuns(); ++seed) {
        TwinRuns runs(seed);
        const auto captures =
            runs.captured({twinTrain(kFrom_v), twinTrain(kFrom_v), twinTrain(kFrom_v), twinTrain(kTo_v)},
                          kComparedRange_v, {kFrom_s, kFrom_s, kTo_s});
        CapturedChange change{.name = "up", .from_v = kFrom_v, .to_v = kTo_v, .from_s = kFrom_s, .to_s = kTo_s};
        std::vector<Compared> read;
        for (const auto& capture : captures) read.push_back(comparedFrom(capture));
        for (std::size_t k = 0; k + 1 < read.size(); ++k) change.before_v.push_back(read[k].amplitude_v);
        const auto interval = [&read](std::size_t k) { return read[k].onset_s - read[k - 1].onset_s; };
        const auto train = [&](std::size_t k) {
            return CapturedTrain{
                .amplitude_v = read[k].amplitude_v,
                .interval_s = interval(k),
                .onsetUncertainty_s = read[k].onset_u_s,
                .amplitudeUncertainty_v = read[k].own_v,
                .amplitude_jnd = std::abs(std::log(read[k].amplitude_v / read[k - 1].amplitude_v)) / kAmplitudeJnd,
                .interval_jnd = std::abs(std::log(interval(k) / kFrom_s)) / kIntervalJnd};
        };
        auto last = train(3);
        last.interval_jnd = std::log(interval(3) / interval(2)) / kIntervalJnd;
        change.trains = {last};
        change.from_s = interval(2);
        const auto judged = judgeChanges(std::vector{change}, {}, {.perTrain_jnd = 2});
        const auto& group = judged.groups.front();
        table.add("step of amplitude", std::log(runs.truth.volts(kTo_v) / runs.truth.volts(kFrom_v)) / kAmplitudeJnd,
                  group.amplitude.jnd, group.amplitude.uncertainty);
        table.add("step of interval", std::log(kTo_s / kFrom_s) / kIntervalJnd, group.interval.jnd,
                  group.interval.uncertainty);
    }
    table.judge("transitions");
}

TEST(Coverage, DistanceOfTwoConditions) {
    CoverageTable table;
    for (std::uint64_t seed = 1; seed <= coverageRuns(); ++seed) {
        TwinRuns runs(seed);
        std::vector<SeparabilityTrial> trials;
        for (const auto& [name, volts, interval_s] : {std::tuple("low", 10.0, 2.0), {"high", 40.0, 0.5}}) {
            for (int k = 0; k < 4; ++k) {
                const auto captures =
                    runs.captured({twinTrain(volts), twinTrain(volts)}, kComparedRange_v, {interval_s});
                const auto found = measureTrains(captures, "voltage", {}).value();
                const auto one = comparedFrom(captures.front());
                SeparabilityTrial trial{name, found.amplitude.mean, found.interval_s.mean, found.uncertainty.amplitude};
                trial.amplitudeGain = one.gain;
                trial.timeBase = captures.front().timeBaseTolerance / std::sqrt(3.0);
                trial.intervalUncertainty_s = one.onset_u_s;
                trials.push_back(trial);
            }
        }
        const auto pair = judgeSeparability(trials).value().pairs.front();
        const double volts = std::log(runs.truth.volts(40) / runs.truth.volts(10)) / kAmplitudeJnd;
        table.add("distance of amplitudes", volts,
                  {pair.amplitudeJnd, pair.amplitudeJndBounds.low, pair.amplitudeJndBounds.high});
        table.add("distance of intervals", std::log(4) / kIntervalJnd,
                  {pair.intervalJnd, pair.intervalJndBounds.low, pair.intervalJndBounds.high});
    }
    table.promise("distance of amplitudes",
                  {.least = 0.87,
                   .most = 1,
                   .mostWithinHalf = 1,
                   .because = "the linearity's bound holds anew at each level, and the simulated one bends smoothly"});
    table.promise("distance of intervals",
                  {.least = 0.87,
                   .most = 1,
                   .mostWithinHalf = 1,
                   .because = "trials are not known to differ in where samples fall, and these do"});
    table.judge("separability");
}

}  // namespace
}  // namespace tacto::test
