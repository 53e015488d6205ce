#include "core/encoding/StepResponse.h"

#include <algorithm>
#include <cmath>

#include "core/base/JustNoticeable.h"
#include "core/encoding/TrainSeries.h"
#include "core/encoding/Transitions.h"

namespace tacto {

StepResponse respond(const StepEnds& ends, std::span<const StepTrain> trains, double carried) noexcept {
    constexpr Seconds kAtOnce{0.05};  // delay of the control loop and the stimulator
    StepResponse found;
    // NaN (not measured) is neither near nor far.
    const auto near = [carried](double distance) { return distance <= carried; };
    const auto far = [carried](double distance) { return distance > carried; };
    const auto intervalBefore = [&](std::size_t k) {
        return k == 0 ? trains[0].onset + ends.sinceOnset : trains[k].onset - trains[k - 1].onset;
    };
    for (std::size_t k = 0; k < trains.size(); ++k) {
        const Seconds interval = intervalBefore(k);
        const Volts amplitude = trains[k].amplitude;
        if (!found.latency && (far(amplitudeDistance(amplitude, ends.before.amplitude)) ||
                               far(intervalDistance(interval, ends.before.interval)))) {
            found.latency = trains[k].onset;
        }
        if (found.trains || k + 1 >= trains.size()) continue;
        // The first train may be late and still be sent at once, if the new interval had already passed at the step.
        const bool inTime = near(intervalDistance(interval, ends.after.interval)) ||
                            (k == 0 && ends.sinceOnset >= ends.after.interval && interval - ends.sinceOnset <= kAtOnce);
        if (inTime && near(amplitudeDistance(amplitude, ends.after.amplitude)) &&
            near(intervalDistance(intervalBefore(k + 1), ends.after.interval))) {
            found.trains = static_cast<int>(k) + 1;
            found.complete = trains[k].onset;
        }
    }
    return found;
}

ResponseRange rangeOf(const StepEnds& ends, std::span<const StepTrain> designed) noexcept {
    constexpr double kOff = 0.2;
    const StepResponse early = respond(ends, designed, (1 - kOff) * kCarried);
    const StepResponse late = respond(ends, designed, (1 + kOff) * kCarried);
    // With a small threshold the step is seen earlier, but is complete later.
    return {{early.latency, late.trains, late.complete}, {late.latency, early.trains, early.complete}};
}

Result<std::vector<StepTrain>> designedTrains(const EncodingProfile& profile, const StepEnds& ends) {
    constexpr std::size_t kMaxResponseTrains = 10'000;
    constexpr std::size_t kAfterArrival = 2;
    if (auto valid = validate(profile); !valid) return failure(valid);
    const double since = ends.sinceOnset.count();
    if (!(since >= 0 && since <= ends.before.interval.count())) {
        return invalid("a step {} s after an onset; 0 to {} s, the interval, is expected", since,
                       ends.before.interval.count());
    }
    TrainSeries series(profile);
    series.want(ends.before, Instant(0));
    static_cast<void>(series.begin(Instant(0)));
    series.delivered();
    const Instant step = toInstant(ends.sinceOnset);
    Instant now = step;
    std::vector<StepTrain> trains;
    std::size_t left = kAfterArrival + 1;
    while (left > 0) {
        if (trains.size() == kMaxResponseTrains) {
            return invalid(
                "limits of {} times and {} V/s of amplitude and {} times of interval per train let a step "
                "take more than {} trains",
                profile.amplitudeRatioPerTrain, profile.amplitudeSlew_V_per_s, profile.intervalRatioPerTrain,
                kMaxResponseTrains);
        }
        series.want(ends.after, now);
        now = *series.due();
        const Command train = series.begin(now);
        series.delivered();
        trains.push_back({Seconds(now - step), train.amplitude});
        if (train == ends.after) --left;
    }
    return trains;
}

namespace {

/// Number of steps for a distance. A rounding error above a whole number does not add a step.
int stepsFor(double distance, double perTrain) noexcept {
    return std::max(0, static_cast<int>(std::ceil(distance / perTrain - 1e-9)));
}

}  // namespace

StepPace fastestPace(const StepEnds& ends, double perTrain) noexcept {
    const double ratio = std::pow(1 + kIntervalWeberFraction, perTrain);
    const double before = ends.before.interval.count(), after = ends.after.interval.count();
    const double since = ends.sinceOnset.count();
    StepPace pace;
    pace.trains = std::max(1, stepsFor(amplitudeDistance(ends.before.amplitude, ends.after.amplitude), perTrain));
    double total = 0;
    if (after < before) {
        // The first interval cannot be shorter than the time already passed.
        double interval = std::max({before / ratio, after, since});
        // If more than the new interval has passed, a first train sent at once is already in time.
        const int steps = stepsFor(intervalDistance(Seconds(interval), ends.after.interval), perTrain);
        const bool atOnce = since >= interval && steps <= 1;
        pace.trains = std::max(pace.trains, atOnce ? 1 : 1 + steps);
        for (int k = 0; k < pace.trains; ++k) {
            total += interval;
            interval = std::max(interval / ratio, after);
        }
    } else {
        pace.trains =
            std::max(pace.trains, stepsFor(intervalDistance(ends.before.interval, ends.after.interval), perTrain));
        // Each interval is the shortest from which the remaining trains can still reach the new interval.
        for (int left = pace.trains - 1; left >= 0; --left) total += std::max(before, after / std::pow(ratio, left));
    }
    pace.complete = Seconds(std::max(0.0, total - since));
    return pace;
}

}  // namespace tacto
