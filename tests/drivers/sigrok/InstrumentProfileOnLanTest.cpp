// From data sheet to uncertainty: an emulated instrument states its name, its profile states its gain, and a figure has
// no expanded uncertainty U until the probe's is stated too (hazard H9).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run/OpenDevices.h"
#include "core/devices/Device.h"
#include "core/measure/PulseMeasurement.h"
#include "drivers/sigrok/driver/SigrokDriver.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/drivers/sigrok/ScopeOnLan.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Returns the statement that openDevices() makes about the instrument under `uri`.
Result<InstrumentStatement> statementUnder(const std::string& uri, const Clock& clock) {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSigrokDriver({}));
    drivers.push_back(makeSimulatedDriver());
    Registry registry(std::move(drivers));
    const std::vector<DeviceUri> uris{DeviceUri::parse(uri).value()};
    auto devices = openDevices(registry, uris, {Role::Oscilloscope}, OpenContext{clock, 1});
    if (!devices) return failure(devices);
    return devices->scopeStatement;
}

/// Returns a pulse of 10 V captured by a `model`, with the statements for its address and the additional `keys`.
Capture captured(const std::string& model, const std::string& keys) {
    ScopeOnLan lan("", "sim:stimulator", model);
    ScopeSettings settings;
    settings.sampleRate = Hertz(1e6);
    settings.samples = 7000;
    settings.triggerLevel = 5;
    settings.voltageRange = Volts(13);
    settings.currentRange = Milliamps(13);
    lan.arm(settings);
    auto pulse = voltagePulse(10);
    pulse.pulses = 2;
    pulse.rate = Hertz(400);
    lan.bench().deliver(pulse, Seconds(0));
    lan.pass(Seconds(0.06));
    auto capture = lan.poll();
    EXPECT_IN_TIME(capture.has_value() && capture->has_value());
    lan.close();
    const auto statement = statementUnder(lan.uri() + keys, lan.bench().clock);
    EXPECT_IN_TIME(statement);
    if (!capture || !*capture || !statement) return {};
    applyStatement(**capture, *statement);  // as Bench does
    return std::move(**capture);
}

TEST(InstrumentProfileOnLan, ACaptureHasTheSheetsGainAndNoProbe) {
    const auto capture = captured("DS2072", "");
    ASSERT_EQ(capture.channels.size(), 2U);
    const auto& voltage = capture.channels[0];
    EXPECT_DOUBLE_EQ(voltage.gainTolerance, 0);
    EXPECT_DOUBLE_EQ(voltage.linearityTolerance, 0.02 * (voltage.high - voltage.low));
    EXPECT_GT(voltage.linearityTolerance, 0.5) << "2 % of ten divisions of 5 V";
    EXPECT_THAT(voltage.statedBy, HasSubstr("data sheet of the Rigol DS2000"));
    EXPECT_DOUBLE_EQ(capture.timeBaseTolerance, 75e-6);
    EXPECT_TRUE(std::isnan(capture.stampTolerance_s)) << "libsigrok stamps records when they arrive";
    EXPECT_THAT(notStated(capture), ElementsAre("the probe of voltage", "the shunt of current"));
    const auto volts = measureChannel(capture, 0);
    ASSERT_EQ(volts.measuredPulses, 2U);
    EXPECT_TRUE(std::isnan(volts.uncertainty.amplitude)) << "an unknown probe leaves no U";
    EXPECT_TRUE(std::isfinite(volts.uncertainty.width_s));
}

TEST(InstrumentProfileOnLan, AStatedProbeGivesTheBudgetItsU) {
    const auto capture = captured("DS2072", "&probe_pct=1&shunt_pct=0.1");
    ASSERT_EQ(capture.channels.size(), 2U);
    EXPECT_THAT(notStated(capture), IsEmpty());
    EXPECT_THAT(capture.channels[0].statedBy, HasSubstr("probe: the device's address"));
    const auto volts = measureChannel(capture, 0);
    const auto amps = measureChannel(capture, 1);
    // Rectangular distributions: 2 % of 50 V, and 1 % of 10 V for the probe.
    EXPECT_NEAR(volts.uncertainty.amplitude, std::hypot(1.0, 0.1) / std::sqrt(3.0), 0.1);
    EXPECT_TRUE(std::isfinite(amps.uncertainty.amplitude));
}

TEST(InstrumentProfileOnLan, TheAddressOverridesTheSheet) {
    const auto capture = captured("DS2072", "&gain_pct=0.5&timebase_ppm=3");
    ASSERT_EQ(capture.channels.size(), 2U);
    EXPECT_DOUBLE_EQ(capture.channels[0].gainTolerance, 0.005);
    EXPECT_DOUBLE_EQ(capture.channels[0].linearityTolerance, 0);
    EXPECT_THAT(capture.channels[0].statedBy, Not(HasSubstr("data sheet")));
    EXPECT_DOUBLE_EQ(capture.timeBaseTolerance, 3e-6);
}

TEST(InstrumentProfileOnLan, AnInstrumentWithoutAProfileStatesNothing) {
    const auto capture = captured("DS2072A", "");
    EXPECT_THAT(notStated(capture), ElementsAre("the gain of voltage", "the probe of voltage", "the gain of current",
                                                "the shunt of current", "the time base"));
}

/// An oscilloscope with the name that a driver would give it.
class NamedScope : public Oscilloscope {
public:
    explicit NamedScope(bool simulated) { identity_.simulated = simulated; }
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    const ScopeTraits& traits() const noexcept override { return traits_; }
    Result<void> configure(const ScopeSettings& /*settings*/) override { return {}; }
    Result<void> arm() override { return {}; }
    void disarm() noexcept override {}
    Result<std::optional<Capture>> poll() override { return std::optional<Capture>{}; }

private:
    DeviceIdentity identity_{"test:", Role::Oscilloscope, "Rigol DS2072", "", ""};
    ScopeTraits traits_;
};
class ReplayedScope final : public NamedScope, public ReplayedDevice {
public:
    ReplayedScope() : NamedScope(false) {}
    StatedOrigin statedOrigin() const noexcept override { return StatedOrigin::Measured; }
};

bool statesGain(std::unique_ptr<Oscilloscope> scope) {
    DeviceSet devices;
    devices.oscilloscope = std::move(scope);
    EXPECT_TRUE(addInstrumentProfile(devices));
    return devices.scopeStatement.voltage.gain.known();
}

TEST(InstrumentProfileOnLan, NeitherSimulatedNorReplayedOnesHaveOne) {
    EXPECT_TRUE(statesGain(std::make_unique<NamedScope>(false)));
    EXPECT_FALSE(statesGain(std::make_unique<NamedScope>(true)));
    EXPECT_FALSE(statesGain(std::make_unique<ReplayedScope>()));
    DeviceSet none;
    EXPECT_TRUE(addInstrumentProfile(none));
    EXPECT_FALSE(none.scopeStatement.voltage.gain.known());
}

}  // namespace
}  // namespace tacto::test
