// BenchOutput.h - the one output of a bench: a stimulator, a massager in its place, or none. Its callers
// switch it off, serve it and name it without knowing which of them it is.
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
    /// `devices` outlive the output. Nothing is open yet.
    explicit BenchOutput(const DeviceSet& devices);

    /// There is one output at a time: a massager is opened only where there is no stimulator. All outlive the output;
    /// `wake` is OutputSession's.
    void open(SafetyGate& gate, const Heartbeat& heartbeat, const Clock& clock, std::function<void()> wake);
    [[nodiscard]] bool isOpen() const noexcept { return stimulator_ || massager_; }
    /// Null where the output is of another kind, or there is none.
    [[nodiscard]] StimulatorSession* stimulator() const noexcept { return stimulator_.get(); }
    [[nodiscard]] MassagerSession* massager() const noexcept { return massager_.get(); }

    /// Switches off now, and again after a write that is in flight; a massager that is plugged in and not open, too.
    void off() noexcept;
    /// An order is with its session.
    [[nodiscard]] bool busy() const noexcept;
    /// Does what is due and returns when it wants to be called again. Requires isOpen().
    Instant serve(Instant now) noexcept;

    /// The source that the bench encodes for: the stimulator; without one no limit, for display alone.
    [[nodiscard]] const SourceTraits& source() const noexcept { return source_; }
    /// Null without an output.
    [[nodiscard]] const Device* device() const noexcept;
    /// A device and no simulation.
    [[nodiscard]] bool isReal() const noexcept;

private:
    const DeviceSet& devices_;
    const SourceTraits source_;
    std::unique_ptr<StimulatorSession> stimulator_;
    std::unique_ptr<MassagerSession> massager_;
};

}  // namespace tacto
