// The flaws of simulated devices: drawn from the seed within the stated limits, absent on request, and an oscilloscope
// that states nothing (science.md section 12).
#include <cmath>
#include <gtest/gtest.h>

#include "core/devices/DeviceUri.h"
#include "core/devices/Registry.h"
#include "core/measure/InstrumentStatement.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/drivers/SimBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

/// Returns the voltage plateau of 40 V into 1 kohm as the oscilloscope with this seed shows it, and the capture.
std::pair<double, Capture> shown(std::uint64_t seed, const std::string& parameters) {
    SimBench bench("1 kohm", seed);
    EXPECT_TRUE(bench.tryOpen("sim:stimulator?" + parameters));
    EXPECT_TRUE(bench.tryOpen("sim:oscilloscope?" + parameters));
    bench.arm({});
    bench.deliver(voltagePulse(40));
    const auto capture = bench.capture();
    double sum = 0;
    std::size_t n = 0;
    for (const float x : capture.channels[0].samples) {
        if (x < 36) continue;
        sum += static_cast<double>(x);
        ++n;
    }
    return {n > 0 ? sum / static_cast<double>(n) : std::nan(""), capture};
}

TEST(SimulatedFlaws, AreDrawnFromTheSeedWithinWhatIsStated) {
    double least = 1e9, most = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const auto [volts, capture] = shown(seed, "flaws=drawn");
        EXPECT_EQ(volts, shown(seed, "flaws=drawn").first) << "the same seed, the same flaws";
        // Stated limits. Stimulator: gain 0.5 %, cold 0.2 %, droop 0.3 %, source 0.2 %; oscilloscope: 0.5 %.
        EXPECT_NEAR(volts, 40, 0.02 * 40) << seed;
        EXPECT_EQ(capture.channels[0].gainTolerance, 0.005);
        EXPECT_TRUE(notStated(capture).empty()) << notStatedText(capture);
        least = std::min(least, volts);
        most = std::max(most, volts);
    }
    EXPECT_GT(most - least, 0.1) << "errors of the size that is stated";
}

TEST(SimulatedFlaws, AreNoneWhereNoneAreWanted) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) EXPECT_NEAR(shown(seed, "flaws=none").first, 40, 0.01);
}

TEST(SimulatedFlaws, AnOscilloscopeMayStateNothing) {
    RecordProperty("hazard", "H9");
    SimBench bench;
    ASSERT_TRUE(bench.tryOpen("sim:stimulator"));
    ASSERT_TRUE(bench.tryOpen("sim:oscilloscope?accuracy=unknown"));
    bench.arm({});
    bench.deliver(voltagePulse(10));
    const auto capture = bench.capture();
    EXPECT_EQ(notStated(capture).size(), 5U) << notStatedText(capture);
    EXPECT_TRUE(std::isnan(capture.stampTolerance_s));
    EXPECT_FALSE(bench.tryOpen("sim:oscilloscope?accuracy=perfect"));
}

TEST(StatementKeys, AreTakenOutOfAnAddressAndCheckedByName) {
    auto uri = DeviceUri::parse("sigrok:demo?voltage=A0&gain_pct=2&probe_pct=0&shunt_pct=0.1&timebase_ppm=50").value();
    const auto stated = accepted(takeStatement(uri).value());
    EXPECT_DOUBLE_EQ(stated.voltage.gain.value, 0.02);
    EXPECT_DOUBLE_EQ(stated.current.gain.value, 0.02);
    EXPECT_DOUBLE_EQ(stated.voltage.probe.value, 0) << "0 is a statement";
    EXPECT_DOUBLE_EQ(stated.current.probe.value, 0.001);
    EXPECT_DOUBLE_EQ(stated.timeBase.value, 50e-6);
    EXPECT_FALSE(stated.stamp_s.known());
    EXPECT_EQ(uri.text(), "sigrok:demo?voltage=A0");
    for (const char* wrong : {"gain_pct=nan", "gain_pct=-1", "gain_pct=60", "gain_pct=", "timebase_ppm=x"}) {
        auto refused = DeviceUri::parse(std::string("sigrok:demo?") + wrong).value();
        EXPECT_THAT(takeStatement(refused), refusedSaying("accepted")) << wrong;
    }
    auto twice = DeviceUri::parse("sigrok:demo?gain_pct=1&gain_pct=2").value();
    EXPECT_EQ(takeStatement(twice).error().message,
              "device \"sigrok:demo\": gain_pct is given twice; once is expected");
}

TEST(StatementKeys, BelongToAnOscilloscope) {
    RecordProperty("hazard", "H9");
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSimulatedDriver());
    Registry registry(std::move(drivers));
    const VirtualClock clock;
    const auto open = [&](const char* text) {
        const std::vector<DeviceUri> uris{DeviceUri::parse(text).value()};
        return registry.open(uris, {}, OpenContext{clock});
    };
    EXPECT_THAT(open("sim:stimulator?gain_pct=1"), refusedSaying("is not an oscilloscope"));
    const auto scope = accepted(open("sim:oscilloscope?accuracy=unknown&gain_pct=1"));
    EXPECT_DOUBLE_EQ(scope.scopeStatement.voltage.gain.value, 0.01);
    EXPECT_EQ(scope.scopeStatement.voltage.gain.by, "the device's address");
    ASSERT_EQ(scope.identities().size(), 1U);
    EXPECT_EQ(scope.identities()[0].uri, "sim:oscilloscope?accuracy=unknown&gain_pct=1") << "what repeats the run";
}

}  // namespace
}  // namespace tacto::test
