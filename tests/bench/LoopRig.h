// LoopRig.h - a control loop alone: recorded samples in, a null stimulator out, armed and driven by the finger.
//
// Thread-safety: the test's own thread.
#pragma once

#include "core/bench/ControlLoop.h"
#include "core/bench/Profile.h"
#include "tests/bench/FakeStimulator.h"
#include "tests/bench/TapedFinger.h"

namespace tacto::test {

struct LoopRig {
    explicit LoopRig(bool readsBack = true) {
        device.traits_.readsBack = readsBack;
        armFake(loop, interlock, device, clock);
        loop.drive({DriveSource::Sensor, 0, 0});
    }
    /// Advances one period, so that new samples of the finger are available.
    void nextSamples() {
        clock.advanceTo(clock.now() + ControlLoop::kPeriod);
        sensor->serve(clock.now());
    }
    /// Writes pending trains, then reads their status.
    void serveStimulator() {
        stimulator.serve(clock.now());
        stimulator.serve(clock.now());
    }

    VirtualClock clock;
    SafetyGate gate{clock};
    Interlock interlock;
    Heartbeat heartbeat;
    FakeStimulator device{clock};
    StimulatorSession stimulator{device, gate, heartbeat, clock, {}};
    TapedFinger finger{clock};
    std::unique_ptr<SensorSession> sensor = SensorSession::create(finger).value();
    Profile profile;
    ControlLoop loop{{clock, gate, interlock, heartbeat, OutputMode::BenchLoad, &stimulator, nullptr, 0, {}},
                     FingerInput::create(*sensor, profile.roughness).value(),
                     std::make_unique<TrainPlanner>(profile.encoding, device.traits(), gate)};
};

}  // namespace tacto::test
