// MassagerConformance.h - tests for every massager. A driver's tests give a factory, see StimulatorConformance.h.
//
// Thread-safety: the suite calls from its own thread, but forceOff() from other threads too.
#pragma once

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>

#include "core/devices/Stimulator.h"

namespace tacto::test {

class MassagerRig {
public:
    virtual ~MassagerRig() = default;
    [[nodiscard]] virtual Massager& device() = 0;
    [[nodiscard]] virtual const Clock& clock() const = 0;
    virtual void wait(Seconds duration) = 0;
    /// True if the motor vibrates perceptibly; nothing if the rig cannot tell.
    [[nodiscard]] virtual std::optional<bool> vibrating() = 0;
    /// Pulls the plug; returns false if the rig cannot.
    [[nodiscard]] virtual bool unplug() = 0;
};

struct MassagerKind {
    std::string name;
    std::function<std::unique_ptr<MassagerRig>()> make;
};

class MassagerConformance : public testing::TestWithParam<MassagerKind> {
protected:
    void SetUp() override;
    [[nodiscard]] ApprovedBurst approved(double intensity, Seconds duration);
    void expectVibration(bool on);
    [[nodiscard]] Massager& device() { return rig_->device(); }

    std::unique_ptr<MassagerRig> rig_;
    std::unique_ptr<SafetyGate> gate_;
};

}  // namespace tacto::test
