// ScopeOnLan.h - an oscilloscope "on the network", on one computer: a simulated stimulator drives a simulated load, an
// emulated instrument measures it, libsigrok reads the instrument over TCP, and the bench gets captures.
//
// The signal runs on a virtual clock; the conversation takes real time.
//
// Thread-safety: the test's own thread; the emulated instrument has its own thread.
#pragma once

#include "core/devices/Oscilloscope.h"
#include "tests/drivers/SimBench.h"
#include "tests/support/emulated/sigrok/CircuitInput.h"
#include "tests/support/emulated/sigrok/EmulatedScopeServer.h"

namespace tacto::test {

class ScopeOnLan {
public:
    static constexpr double kShuntOhm = 10;

    /// `parameters` are the URI's parameters except the channels; `model` is the name that the instrument states.
    explicit ScopeOnLan(const std::string& parameters = "", const std::string& stimulator = "sim:stimulator",
                        const std::string& model = "DS2072A");

    [[nodiscard]] Oscilloscope& scope() { return *opened_.oscilloscope; }
    [[nodiscard]] sigrok_driver::EmulatedScopeServer& instrument() { return *server_; }
    [[nodiscard]] SimBench& bench() { return bench_; }
    [[nodiscard]] std::string uri() const;

    /// Applies the settings, arms, and waits until the instrument waits for a trigger.
    void arm(const ScopeSettings& settings);
    /// Lets signal time pass, then waits until a complete record, if there is one, has been read out.
    void pass(Seconds duration);
    /// Returns the next capture; waits at most `timeout` of real time.
    [[nodiscard]] Result<std::optional<Capture>> poll(Seconds timeout = Seconds(5));
    /// Closes the device.
    void close() { opened_.oscilloscope.reset(); }
    [[nodiscard]] Result<void> open();

private:
    SimBench bench_;
    const std::string parameters_;
    std::unique_ptr<sigrok_driver::EmulatedScopeServer> server_;
    std::unique_ptr<Driver> driver_;
    DeviceSet opened_;
};

}  // namespace tacto::test
