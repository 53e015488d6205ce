// BenchOutput.h - the one output of a bench: a stimulator, a massager in its place, or none. Its callers switch it off,
// serve it and name it without knowing which kind it is.
//
// Thread-safety: open() comes before all other threads. serve() has one caller, the device's thread (on the virtual
// clock, the bench); the rest any thread.
#pragma once

#include <functional>
#include <memory>

#include "core/bench/delivery/OutputSession.h"
#include "core/bench/delivery/StimulatorSession.h"
#include "core/devices/DeviceSet.h"

namespace tacto {

class BenchOutput {
public:
    /// `devices` outlives the output. Nothing is open after construction.
    explicit BenchOutput(const DeviceSet& devices);

    /// Opens the stimulator, or a massager only if there is no stimulator. All arguments outlive the output; `wake` is
    /// passed to OutputSession.
    void open(SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock, std::function<void()> wake);
    [[nodiscard]] bool isOpen() const noexcept { return stimulator_ || massager_; }
    /// Null if the output is of another kind, or there is none.
    [[nodiscard]] StimulatorSession* stimulator() const noexcept { return stimulator_.get(); }
    [[nodiscard]] MassagerSession* massager() const noexcept { return massager_.get(); }

    /// Switches off now, and again after a write in progress; also a massager that is connected but not open.
    void off() noexcept;
    /// True while an order is with the output's session.
    [[nodiscard]] bool busy() const noexcept;
    /// Does what is due and returns the time of the next call. Requires isOpen().
    Instant serve(Instant now) noexcept;

    /// The source that the bench encodes for: the stimulator; without one a source without limits, for display only.
    [[nodiscard]] const SourceTraits& source() const noexcept { return source_; }
    /// Null without an output.
    [[nodiscard]] const Device* device() const noexcept;
    /// True for a real device, false for a simulated one.
    [[nodiscard]] bool isReal() const noexcept;

private:
    const DeviceSet& devices_;
    const SourceTraits source_;
    std::unique_ptr<StimulatorSession> stimulator_;
    std::unique_ptr<MassagerSession> massager_;
};

}  // namespace tacto
