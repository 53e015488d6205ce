// The stored data about the open stimulator, as a bench gets them.
#include <chrono>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run/KnownCalibration.h"
#include "app/run/ScopeStatement.h"
#include "core/calibration/CalibrationStore.h"
#include "core/calibration/CertificateStore.h"
#include "core/devices/DeviceUri.h"
#include "core/devices/Registry.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/scripting/DataHome.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Known : public DataHome {
protected:
    Known() {
        std::filesystem::create_directories(calibrationFile().parent_path());
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        Registry registry(std::move(drivers));
        const std::vector<DeviceUri> uris{DeviceUri::parse("sim:").value()};
        devices_ = registry.open(uris, {Role::Stimulator}, OpenContext{*clock_, 1, "1 kohm"}).value();
    }

    /// Keeps a calibration of the open stimulator that was made `made` days and is valid until `until` days from now.
    void keep(double gain, int made, int until, const std::string& output = "SIM-1", const char* unit = "V") {
        const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
        StoredCalibration c;
        c.serial = output;
        c.device = "simulated stimulator";
        c.unit = unit;
        c.amplitude = {{gain, 0, 10, 40}, 0.5, 0.02};
        c.interval = {{1.001, 0, 0.5, 2}, 0.01, 1e-6};
        c.phaseWidth = {{1, 2e-6, 100e-6, 400e-6}, 0.2, 1e-7};
        c.gap = {{1, 1e-6, 100e-6, 400e-6}, 0.3};
        c.made = today + std::chrono::days(made);
        c.validUntil = today + std::chrono::days(until);
        c.simulated = true;
        c.session = "run.tacto";
        c.sessionHead = std::string(64, '0');
        c.readings = 440;
        c.instruments = {{"simulated oscilloscope", "", std::nullopt, 0.01, "the instrument"}};
        auto store = CalibrationStore::open(calibrationFile());
        ASSERT_TRUE(store) << store.error().message;
        const auto added = store->add(c);
        ASSERT_TRUE(added) << added.error().message;
    }

    std::shared_ptr<VirtualClock> clock_ = std::make_shared<VirtualClock>();
    DeviceSet devices_;
};

TEST_F(Known, NothingIsKnownOfAStimulatorThatWasNeverCalibrated) {
    RecordProperty("hazard", "H9");
    const auto known = knownCalibration(devices_);
    EXPECT_FALSE(known.calibration);
    EXPECT_FALSE(known.holds);
    EXPECT_THAT(known.text, HasSubstr("not calibrated: stimulator SIM-1"));
}

TEST_F(Known, AValidOneHoldsOnItsLastDayToo) {
    keep(1.02, -10, 0);
    const auto known = knownCalibration(devices_);
    ASSERT_TRUE(known.calibration);
    EXPECT_EQ(*known.calibration,
              (StimulatorCalibration{{1.02, 0, 10, 40, Spread{0.5 / 100, 0.02}},
                                     CalibrationLine{1.001, 0, 0.5, 2, Spread{0.01 / 100, 1e-6}},
                                     CalibrationLine{1, 2e-6, 100e-6, 400e-6, Spread{0.2 / 100, 1e-7}},
                                     CalibrationLine{1, 1e-6, 100e-6, 400e-6, kUnknownSpread}}));
    EXPECT_TRUE(known.holds);
    EXPECT_THAT(known.text, HasSubstr("amplitude gain 1.02, offset 0 V, U 0.5 %; interval gain 1.001"));
    EXPECT_THAT(known.text, HasSubstr("phase width gain 1, offset 2 us, U 0.2 %; inter-phase gap gain 1, offset 1 us"));
}

TEST_F(Known, AnExpiredOneIsKnownAndDoesNotHold) {
    RecordProperty("hazard", "H1");
    keep(1.19, -300, -1);
    const auto known = knownCalibration(devices_);
    ASSERT_TRUE(known.calibration) << "the gate judges by it";
    EXPECT_FALSE(known.holds);
    EXPECT_THAT(known.text, HasSubstr("a newer one is expected"));
}

TEST_F(Known, OneThatIsOutOfOrderReachesTheGateWhichArmsNothing) {
    RecordProperty("hazard", "H1");
    keep(1.3, 0, 100);
    auto known = knownCalibration(devices_);
    ASSERT_TRUE(known.calibration);
    EXPECT_THAT(known.text, HasSubstr("out of order"));

    BenchConfig config;
    config.devices = std::move(devices_);
    config.clock = clock_;
    config.limits = limitSets();
    applyKnown(std::move(known), config);
    auto bench = Bench::create(std::move(config));
    ASSERT_TRUE(bench) << bench.error().message;
    const auto armed = (*bench)->arm({"1 kohm", true, true});
    ASSERT_FALSE(armed);
    EXPECT_THAT(armed.error().message, HasSubstr("out of order"));
    // Without the calibration, the stimulator may be calibrated again and is judged by what it delivers.
    ASSERT_TRUE((*bench)->useCalibration(false));
    const auto again = (*bench)->arm({"1 kohm", true, true});
    EXPECT_TRUE(again) << again.error().message;
}

TEST_F(Known, AnotherOutputOrUnitOfTheSameStimulatorIsAnother) {
    RecordProperty("hazard", "H4");
    keep(1.05, 0, 100, "SIM-1 channel=2");
    keep(1.05, 0, 100, "SIM-1", "mA");
    EXPECT_FALSE(knownCalibration(devices_).calibration);
    EXPECT_EQ(calibratedOutput("PP-7", "pulsepal:PP-7?channel=2"), "PP-7 channel=2");
    EXPECT_EQ(calibratedOutput("S1", "sciencemode:S1?channel=2&connector=yellow&keep=1"),
              "S1 connector=yellow channel=2");
    EXPECT_EQ(calibratedOutput("SIM-1", "sim:stimulator?gain=0.97"), "SIM-1");
    EXPECT_EQ(calibratedOutput("", "pulsepal:1-1.2?channel=2"), "") << "a socket is not a serial number";
}

TEST_F(Known, ADamagedStoreIsNoCalibration) {
    RecordProperty("hazard", "H9");
    keep(1.02, 0, 100);
    std::ofstream(calibrationFile(), std::ios::app) << "{}\n{}\n";
    const auto known = knownCalibration(devices_);
    EXPECT_FALSE(known.calibration);
    EXPECT_FALSE(known.holds);
    EXPECT_THAT(known.text, HasSubstr("not calibrated: "));
}

/// Certified figures of an oscilloscope, as its captures get them.
class KnownCertificates : public Known {
protected:
    static void enter(const std::string& serial) {
        auto store = CertificateStore::open(certificateFile());
        ASSERT_TRUE(store) << store.error().message;
        const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
        Certificate one{"Scope X", serial, "4711", "Lab", today, today, 2.0, {}, {}, {}};
        ASSERT_TRUE(store->add(one, today));
    }
    static KnownCertificate of(const std::string& uri, const std::string& serial, bool simulated = false) {
        return knownCertificate({uri, Role::Oscilloscope, "Scope X", serial, "", simulated});
    }
};

TEST_F(KnownCertificates, CountForTheirSerialNumberAlone) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(of("sigrok:rigol-ds", "A1").text, "");
    enter("A1");
    EXPECT_TRUE(of("sigrok:rigol-ds", "A1").used);
    EXPECT_TRUE(of("sigrok:rigol-ds", "A1").statement.voltage.gain.known());
    EXPECT_FALSE(of("sigrok:rigol-ds", "A2").used);
    EXPECT_FALSE(of("sigrok:rigol-ds", "").used);
    EXPECT_THAT(of("sigrok:rigol-ds", "").text, HasSubstr("no serial number"));
    EXPECT_FALSE(of("capture:/data/captures", "A1").used);  // the instrument that took them is unknown
}

TEST_F(KnownCertificates, OfASimulatedOscilloscopeCountForNoOther) {
    RecordProperty("hazard", "H9");
    enter("SIM-1");
    EXPECT_TRUE(of("sim:oscilloscope", "SIM-1", true).used);
    const auto real = of("sigrok:rigol-ds", "SIM-1");
    EXPECT_FALSE(real.used);
    EXPECT_FALSE(real.statement.voltage.gain.known());
    EXPECT_THAT(real.text, HasSubstr("is of a simulated one"));
}

TEST_F(KnownCertificates, WinOverTheAddressFigureByFigure) {
    RecordProperty("hazard", "H9");
    enter("SIM-1");
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSimulatedDriver());
    Registry registry(std::move(drivers));
    const std::vector<DeviceUri> uris{
        DeviceUri::parse("sim:oscilloscope?accuracy=unknown&gain_pct=9&fs_pct=3&shunt_pct=0.4").value()};
    auto devices = registry.open(uris, {Role::Oscilloscope}, OpenContext{*clock_, 1, "1 kohm"}).value();
    EXPECT_TRUE(stateOscilloscope(devices).used);
    const auto& stated = devices.scopeStatement;
    EXPECT_NEAR(stated.voltage.gain.value, 0.02 / 0.95, 1e-9);
    EXPECT_FALSE(stated.voltage.linearity.known());  // a certified gain already includes linearity
    EXPECT_DOUBLE_EQ(stated.current.probe.value, 0.004);
    EXPECT_EQ(stated.current.probe.by, "the device's address");
    EXPECT_FALSE(stated.timeBase.known());
}

}  // namespace
}  // namespace tacto::test
