#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "core/devices/Oscilloscope.h"
#include "core/measure/PulseMeasurement.h"
#include "drivers/sigrok/driver/SigrokDriver.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

Result<DeviceSet> openDemo(const std::string& uri, const Clock& clock) {
    DeviceSet devices;
    const auto opened = makeSigrokDriver({})->open(DeviceUri::parse(uri).value(), {}, OpenContext{clock, 1}, devices);
    if (!opened) return failure(opened);
    return devices;
}

Result<Capture> captured(Oscilloscope& scope) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    for (;;) {
        auto found = scope.poll();
        if (!found) return failure(found);
        if (*found) return std::move(**found);
        if (std::chrono::steady_clock::now() > until) return fail(ErrorCode::Timeout, "no capture within 5 s");
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

ScopeSettings demoSettings() {
    ScopeSettings s;
    s.sampleRate = Hertz(100e3);
    s.samples = 5000;
    s.triggerLevel = 2;
    return s;
}

TEST(SigrokDemo, IsListedAsSimulatedAndNothingIsTouched) {
    const auto listed = makeSigrokDriver({})->list();
    ASSERT_EQ(listed.size(), 2U);
    EXPECT_EQ(listed[0].uri, "sigrok:demo");
    EXPECT_TRUE(listed[0].simulated);
    EXPECT_TRUE(listed[1].placeholder);
}

TEST(SigrokDriver, RefusesAnUnknownDriverWithoutWaitingForItself) {
    const SteadyClock clock;
    const auto since = std::chrono::steady_clock::now();
    const auto devices = openDemo("sigrok:no-such-driver", clock);
    const Seconds took = std::chrono::steady_clock::now() - since;
    ASSERT_FALSE(devices.has_value());
    EXPECT_EQ(devices.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(devices.error().message, HasSubstr("\"no-such-driver\""));
    EXPECT_IN_TIME(took.count() < 3) << "a turn in libsigrok is waited for for 5 s";
}

TEST(SigrokDemo, ItsSquareAndSineAreCapturedAndMeasured) {
    const SteadyClock clock;
    auto devices = openDemo("sigrok:demo?voltage=A0&current=A1&shunt=100", clock);
    ASSERT_IN_TIME(devices);
    auto& scope = *devices->oscilloscope;
    EXPECT_TRUE(scope.identity().simulated);
    ASSERT_IN_TIME(scope.configure(demoSettings()));
    ASSERT_IN_TIME(scope.arm());
    double last = -1;
    for (int i = 0; i < 3; ++i) {
        const auto capture = captured(scope);
        ASSERT_IN_TIME(capture);
        EXPECT_TRUE(capture->simulated);
        EXPECT_DOUBLE_EQ(capture->rate_hz, 100e3);
        EXPECT_GT(capture->trigger_s, last);
        last = capture->trigger_s;
        ASSERT_EQ(capture->channels.size(), 2U);
        EXPECT_EQ(capture->samples(), 5000U);
        // A0 is a square wave of ±10 V, A1 a sine of ±10 V over 100 ohm.
        const auto& volts = capture->channels[0].samples;
        EXPECT_EQ(*std::ranges::max_element(volts), 10.0F);
        EXPECT_EQ(*std::ranges::min_element(volts), -10.0F);
        EXPECT_LT(volts[499], 2.0F);
        EXPECT_GE(volts[500], 2.0F) << "a tenth of the record before the trigger";
        const auto& amps = capture->channels[1].samples;
        EXPECT_EQ(capture->channels[1].unit, "A");
        EXPECT_NEAR(static_cast<double>(*std::ranges::max_element(amps)), 0.1, 1e-6);
        double squares = 0;
        for (const float one : amps) squares += static_cast<double>(one) * static_cast<double>(one);
        EXPECT_NEAR(std::sqrt(squares / 5000), 0.1 / std::numbers::sqrt2, 1e-4);
    }
    scope.disarm();
    EXPECT_FALSE(scope.poll()->has_value());
    ASSERT_IN_TIME(scope.arm()) << "armed again after disarming";
    EXPECT_IN_TIME(captured(scope));
}

TEST(SigrokDemo, ItsSquareIsMeasuredLikeAPulseTrain) {
    const SteadyClock clock;
    auto devices = openDemo("sigrok:demo", clock);
    ASSERT_IN_TIME(devices);
    ASSERT_IN_TIME(devices->oscilloscope->configure(demoSettings()));
    ASSERT_IN_TIME(devices->oscilloscope->arm());
    const auto capture = captured(*devices->oscilloscope);
    ASSERT_IN_TIME(capture);
    ASSERT_EQ(capture->channels.size(), 1U) << "no current channel was named";
    const auto& volts = capture->channels[0].samples;
    // The phases are equal, so each rising edge comes one period, as libsigrok's demo sets it, after the one before.
    std::vector<std::size_t> edges;
    for (std::size_t i = 1; i < volts.size(); ++i) {
        if (volts[i - 1] < 0 && volts[i] > 0) edges.push_back(i);
    }
    ASSERT_GT(edges.size(), 10U);
    for (std::size_t i = 2; i < edges.size(); ++i) EXPECT_EQ(edges[i] - edges[i - 1], edges[1] - edges[0]);
}

TEST(SigrokDemo, ARecordIsForcedWhereNothingTriggers) {
    const SteadyClock clock;
    auto devices = openDemo("sigrok:demo", clock);
    ASSERT_IN_TIME(devices);
    auto& scope = *devices->oscilloscope;
    auto* forced = dynamic_cast<ForcedTrigger*>(&scope);
    ASSERT_NE(forced, nullptr);
    EXPECT_EQ(forced->forceTrigger().error().code, ErrorCode::Unsupported) << "not armed";
    auto high = demoSettings();
    high.triggerLevel = 40;  // the signal is ±10 V
    ASSERT_IN_TIME(scope.configure(high));
    ASSERT_IN_TIME(scope.arm());
    EXPECT_FALSE(scope.poll()->has_value());
    ASSERT_IN_TIME(forced->forceTrigger());
    const auto capture = captured(scope);
    ASSERT_IN_TIME(capture);
    EXPECT_TRUE(capture->untriggered);
    EXPECT_TRUE(std::isnan(capture->trigger_s));
}

TEST(SigrokDemo, RefusalsNameWhatThereIs) {
    const SteadyClock clock;
    EXPECT_THAT(openDemo("sigrok:demo?voltage=B7", clock).error().message,
                testing::AllOf(HasSubstr("B7"), HasSubstr("A0, A1")));
    EXPECT_THAT(openDemo("sigrok:demo?probe=10", clock).error().message, HasSubstr("probe=10"));
    EXPECT_THAT(openDemo("sigrok:demo?record=live", clock).error().message, HasSubstr("streams"));
    EXPECT_THAT(openDemo("sigrok:demo:colour=red", clock).error().message,
                testing::AllOf(HasSubstr("colour"), HasSubstr("analog_channels")));
    const auto unknown = openDemo("sigrok:no-such-driver", clock);
    EXPECT_EQ(unknown.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(unknown.error().message, HasSubstr("no-such-driver"));
    EXPECT_IN_TIME(openDemo("sigrok:demo:analog_channels=2", clock));
}

TEST(SigrokDemo, TwoAreOpenAtOnceAndCloseWhileTheyRun) {
    const SteadyClock clock;
    auto first = openDemo("sigrok:demo", clock);
    auto second = openDemo("sigrok:demo?voltage=A1", clock);
    ASSERT_IN_TIME(first.has_value() && second.has_value());
    for (auto* one : {&*first, &*second}) {
        ASSERT_IN_TIME(one->oscilloscope->configure(demoSettings()));
        ASSERT_IN_TIME(one->oscilloscope->arm());
    }
    EXPECT_IN_TIME(captured(*first->oscilloscope));
    EXPECT_IN_TIME(captured(*second->oscilloscope));
    const auto before = std::chrono::steady_clock::now();
    first->oscilloscope.reset();
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - before < std::chrono::seconds(2));
    EXPECT_IN_TIME(captured(*second->oscilloscope)) << "the other goes on";
}

}  // namespace
}  // namespace tacto::test
