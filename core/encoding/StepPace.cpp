#include "core/encoding/StepPace.h"

#include <algorithm>
#include <cmath>

#include "core/base/JustNoticeable.h"
#include "core/encoding/Transitions.h"

namespace tacto {

namespace {

/// Steps that a distance takes; a last bit above a whole number is that number.
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
        // The first interval lasts at least as long as has passed already.
        double interval = std::max({before / ratio, after, since});
        // A first train that comes at once, since more than the new interval has passed, is in time for it already.
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
        // As short as the last, which is the new interval, allows.
        for (int left = pace.trains - 1; left >= 0; --left) total += std::max(before, after / std::pow(ratio, left));
    }
    pace.complete = Seconds(std::max(0.0, total - since));
    return pace;
}

}  // namespace tacto
