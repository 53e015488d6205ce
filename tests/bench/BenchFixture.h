// BenchFixture.h - a whole bench of simulated devices, named by their URIs.
//
// Thread-safety: the test's own thread; the bench has its own rules.
#pragma once

#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>

#include "core/bench/Bench.h"
#include "core/devices/Registry.h"
#include "core/session/SessionWriter.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/support/Limits.h"
#include "tests/support/RealLookingStimulator.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {

class BenchFixture : public testing::Test {
protected:
    /// Opens `uris` on a virtual clock, or on a steady one if `realTime`. Uses sim: for roles of `needed` left open.
    void open(std::vector<std::string> uris, std::set<Role> needed = {Role::Stimulator, Role::Oscilloscope},
              bool realTime = false, const std::string& load = "1 kohm") {
        bench_.reset();
        clock_.reset();
        if (realTime)
            clock_ = std::make_shared<SteadyClock>();
        else
            clock_ = std::make_shared<VirtualClock>();
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        Registry registry(std::move(drivers));
        std::vector<DeviceUri> parsed;
        for (const auto& uri : uris) parsed.push_back(DeviceUri::parse(uri).value());
        parsed.push_back(DeviceUri::parse("sim:").value());
        auto devices = accepted(registry.open(parsed, needed, OpenContext{*clock_, seed_, load}));
        if (looksReal_ && devices.stimulator)
            devices.stimulator = std::make_unique<RealLookingStimulator>(std::move(devices.stimulator));
        if (wrap_) devices.stimulator = wrap_(std::move(devices.stimulator));
        if (wrapSensor_) devices.sensor = wrapSensor_(std::move(devices.sensor));
        BenchConfig config;
        config.devices = std::move(devices);
        config.clock = clock_;
        config.profile = profile_;
        config.limits = limitSets();
        config.session = session_;
        config.calibration = calibration_;
        config.calibrationHolds = calibrationHolds_;
        config.calibrationText = "as the test says";
        config.calibratedUntil = calibratedUntil_;
        config.today = today_;
        config.person = person_;
        config.boardProfile = boardProfile_;
        config.mode = person_ ? OutputMode::Person : OutputMode::BenchLoad;
        config.virtualParticipant = person_.has_value() && !looksReal_;  // the devices are simulated
        bench_ = accepted(Bench::create(std::move(config)));
    }

    [[nodiscard]] Result<void> arm(const std::string& load = "1 kohm") {
        return bench_->arm(ArmRequest{load, true, true});
    }
    /// Arms and drives by hand at roughness R and pressure P.
    [[nodiscard]] Result<void> armAndDrive(double R, double P, const std::string& load = "1 kohm") {
        if (auto armed = arm(load); !armed) return armed;
        return bench_->drive(DriveSource::Manual, R, P);
    }
    [[nodiscard]] InterlockState state() const { return bench_->telemetry().state; }

    std::uint64_t seed_ = 1;
    Profile profile_;
    SessionWriter* session_ = nullptr;
    KnownLines calibration_;
    bool calibrationHolds_ = true;
    std::optional<std::chrono::sys_days> calibratedUntil_;
    std::chrono::sys_days (*today_)() = nullptr;
    decltype(BenchConfig::boardProfile) boardProfile_;
    std::optional<PersonSetup> person_;  ///< if set, the bench is for a person
    bool looksReal_ = false;             ///< the next opened device is treated as a real one
    /// Wraps the next opened stimulator.
    std::function<std::unique_ptr<Stimulator>(std::unique_ptr<Stimulator>)> wrap_;
    std::function<std::unique_ptr<TactileSensor>(std::unique_ptr<TactileSensor>)> wrapSensor_;
    std::shared_ptr<Clock> clock_;
    std::unique_ptr<Bench> bench_;
};

}  // namespace tacto::test
