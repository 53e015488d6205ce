// SensorConformance.h - tests that every tactile sensor must pass. A driver's tests give a factory, see
// StimulatorConformance.h.
//
// Thread-safety: the test's own thread.
#pragma once

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/TactileSensor.h"

namespace tacto::test {

class SensorRig {
public:
    virtual ~SensorRig() = default;
    [[nodiscard]] virtual TactileSensor& device() = 0;
    [[nodiscard]] virtual const Clock& clock() const = 0;
    virtual void wait(Seconds duration) = 0;
    /// Pulls the plug; returns false if the rig cannot.
    [[nodiscard]] virtual bool unplug() = 0;
};

struct SensorKind {
    std::string name;
    std::function<std::unique_ptr<SensorRig>()> make;
};

class SensorConformance : public testing::TestWithParam<SensorKind> {
protected:
    void SetUp() override;
    /// Reads every `step` for `duration` and collects everything.
    void collect(Seconds duration, Seconds step);
    [[nodiscard]] TactileSensor& device() { return rig_->device(); }

    std::unique_ptr<SensorRig> rig_;
    std::vector<SampleBlock> blocks_;
};

}  // namespace tacto::test
