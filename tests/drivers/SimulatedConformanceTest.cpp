// Runs the suites that every device must pass on the simulated devices.
#include "drivers/simulated/SimulatedMassager.h"
#include "tests/drivers/SimBench.h"
#include "tests/drivers/conformance/MassagerConformance.h"
#include "tests/drivers/conformance/OscilloscopeConformance.h"
#include "tests/drivers/conformance/SensorConformance.h"
#include "tests/drivers/conformance/StimulatorConformance.h"

namespace tacto::test {
namespace {

constexpr Seconds kPlugTime{1000};

/// Common part of all simulated rigs: a scheduled fault pulls the plug.
template <class Rig>
class SimRig : public Rig {
public:
    explicit SimRig(const std::vector<std::string>& uris) {
        for (const auto& uri : uris) bench_.open(uri);
    }
    const Clock& clock() const override { return bench_.clock; }
    void wait(Seconds duration) override { bench_.wait(duration); }
    bool unplug() override {
        bench_.clock.advanceTo(toInstant(kPlugTime));
        return true;
    }

protected:
    mutable SimBench bench_;
};

class SimStimulatorRig final : public SimRig<StimulatorRig> {
public:
    explicit SimStimulatorRig(const std::string& uri) : SimRig({uri}) {
        world_ = dynamic_cast<sim::WorldMember&>(*bench_.devices.stimulator).world();
    }
    Stimulator& device() override { return *bench_.devices.stimulator; }
    std::optional<bool> outputOn() override { return world_->circuit().active(bench_.clock.now()); }
    void close() override { bench_.devices.stimulator.reset(); }

private:
    std::shared_ptr<sim::World> world_;
};

class SimSensorRig final : public SimRig<SensorRig> {
public:
    explicit SimSensorRig(const std::string& uri) : SimRig({uri}) {}
    TactileSensor& device() override { return *bench_.devices.sensor; }
};

class SimOscilloscopeRig final : public SimRig<OscilloscopeRig> {
public:
    explicit SimOscilloscopeRig(const std::string& uri) : SimRig({uri, "sim:stimulator"}) {}
    Oscilloscope& device() override { return *bench_.devices.oscilloscope; }
    bool pulse() override {
        bench_.deliver(voltagePulse(10), Seconds(0.01));
        return true;
    }
};

class SimMassagerRig final : public SimRig<MassagerRig> {
public:
    SimMassagerRig() : SimRig({"sim:massager?fault=unplug@1000s"}) {}
    Massager& device() override { return *bench_.devices.massager; }
    std::optional<bool> vibrating() override {
        const auto& motor = dynamic_cast<const sim::SimulatedMassager&>(*bench_.devices.massager);
        return motor.vibrationAt(bench_.clock.now()).amplitude_m_s2 > 0.5;
    }
};

template <class Rig, class Kind>
Kind kind(const char* name, std::string uri) {
    return Kind{name, [uri = std::move(uri)] { return std::make_unique<Rig>(uri); }};
}

template <class Kind>
std::string nameOfKind(const testing::TestParamInfo<Kind>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(
    Simulated, StimulatorConformance,
    testing::Values(
        kind<SimStimulatorRig, StimulatorKind>("VoltageSource", "sim:stimulator?fault=unplug@1000s"),
        kind<SimStimulatorRig, StimulatorKind>("CurrentSource", "sim:stimulator?mode=current&fault=unplug@1000s"),
        kind<SimStimulatorRig, StimulatorKind>("FlawedSource",
                                               "sim:stimulator?gain=1.02&offset=0.1&rise=20us&jitter=1ms&gap=highz&"
                                               "imbalance=0.01&fault=unplug@1000s")),
    nameOfKind<StimulatorKind>);

INSTANTIATE_TEST_SUITE_P(
    Simulated, SensorConformance,
    testing::Values(kind<SimSensorRig, SensorKind>("Finger", "sim:finger?fault=unplug@1000s"),
                    kind<SimSensorRig, SensorKind>("SlowRates",
                                                   "sim:finger?rate=1kHz&taxelrate=100&fault=unplug@1000s"),
                    kind<SimSensorRig, SensorKind>("FastRates", "sim:finger?rate=20kHz&fault=unplug@1000s"),
                    kind<SimSensorRig, SensorKind>("LosingPackets", "sim:finger?dropouts=0.005&fault=unplug@1000s")),
    nameOfKind<SensorKind>);

INSTANTIATE_TEST_SUITE_P(
    Simulated, OscilloscopeConformance,
    testing::Values(kind<SimOscilloscopeRig, OscilloscopeKind>("Usual", "sim:oscilloscope?fault=unplug@1000s"),
                    kind<SimOscilloscopeRig, OscilloscopeKind>("EightBits",
                                                               "sim:oscilloscope?bits=8&fault=unplug@1000s")),
    nameOfKind<OscilloscopeKind>);

INSTANTIATE_TEST_SUITE_P(Simulated, MassagerConformance,
                         testing::Values(MassagerKind{"Motor", [] { return std::make_unique<SimMassagerRig>(); }}),
                         nameOfKind<MassagerKind>);

}  // namespace
}  // namespace tacto::test
