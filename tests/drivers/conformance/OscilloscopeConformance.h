// OscilloscopeConformance.h - tests that every oscilloscope must pass. A driver's tests give a factory, see
// StimulatorConformance.h.
//
// Thread-safety: the test's own thread.
#pragma once

#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>

#include "core/base/Clock.h"
#include "core/devices/Oscilloscope.h"

namespace tacto::test {

class OscilloscopeRig {
public:
    virtual ~OscilloscopeRig() = default;
    [[nodiscard]] virtual Oscilloscope& device() = 0;
    [[nodiscard]] virtual const Clock& clock() const = 0;
    virtual void wait(Seconds duration) = 0;
    /// Puts a biphasic pulse of 10 V, 200 µs a phase, on the voltage channel within 50 ms; false if the rig cannot.
    [[nodiscard]] virtual bool pulse() = 0;
    /// Pulls the plug; returns false if the rig cannot.
    [[nodiscard]] virtual bool unplug() = 0;
};

struct OscilloscopeKind {
    std::string name;
    std::function<std::unique_ptr<OscilloscopeRig>()> make;
};

class OscilloscopeConformance : public testing::TestWithParam<OscilloscopeKind> {
protected:
    void SetUp() override;
    [[nodiscard]] Oscilloscope& device() { return rig_->device(); }
    /// Settings: 2 ms at up to 1 MS/s, trigger at 5 V.
    [[nodiscard]] ScopeSettings usual() const;
    [[nodiscard]] std::optional<Capture> captured();

    std::unique_ptr<OscilloscopeRig> rig_;
};

}  // namespace tacto::test
