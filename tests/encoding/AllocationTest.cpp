// Functions that the control loop calls for every train must not allocate memory.
#include <gtest/gtest.h>

#include "core/encoding/Encoder.h"
#include "core/encoding/PulseTrain.h"
#include "core/encoding/Rounding.h"
#include "core/encoding/TrainSeries.h"
#include "tests/support/Allocations.h"

namespace tacto {
namespace {

TEST(EncodingInTheLoop, DoesNotAllocate) {
    if (!test::countsAllocations()) GTEST_SKIP() << test::kNotCounted;
    EncodingProfile profile;
    profile.amplitudeSlew_V_per_s = 50;
    profile.intervalRatioPerTrain = 1.3;
    const Encoder encoder(profile);
    const DeviceGrid grid{0.5, 60, Micros(10), Micros(20), Micros(4000), 100};
    TrainScheduler scheduler;
    scheduler.start(Instant(0), Seconds(1));
    Command last = *encoder.encode(0.5, 0.5);
    std::vector<double> samples(2000);
    double sum = 0;
    const auto before = test::allocationsOfThisThread();
    for (int step = 0; step < 1000; ++step) {
        const Instant now = std::chrono::milliseconds(step);
        const auto wanted = encoder.encode(step / 1000.0, 1 - step / 1000.0);
        const Command next = encoder.limited(last, *wanted, Seconds(0.5));
        scheduler.setInterval(next.interval, now);
        if (*scheduler.due() <= now) scheduler.trainAt(now);
        const auto train = trainFor(Drive::Current, profile, next.amplitude, Ohms(1000));
        const auto rounded = roundToDevice(*train, grid);
        if (synthesize(rounded->train, Hertz(1e5), samples)) sum += samples[0];
        last = next;
    }
    const auto after = test::allocationsOfThisThread();
    EXPECT_EQ(after - before, 0U);
    EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace tacto
