// ScopeOnLan.h - the whole way to an oscilloscope on the network, on one machine: a simulated stimulator drives a
// simulated load, an emulated instrument measures that, libsigrok reads it over TCP, and the bench gets captures.
//
// The signal lives on a virtual clock; the conversation takes the real time that it takes.
//
// Thread-safety: the test's own thread; the emulated instrument serves on another.
#pragma once

#include "core/devices/Oscilloscope.h"
#include "tests/drivers/SimBench.h"
#include "tests/support/emulated/sigrok/CircuitInput.h"
#include "tests/support/emulated/sigrok/EmulatedScopeServer.h"

namespace tacto::test {

class ScopeOnLan {
public:
    static constexpr double kShuntOhm = 10;

    /// `parameters` are the URI's besides the channels'; `model` is what the instrument calls itself.
    explicit ScopeOnLan(const std::string& parameters = "", const std::string& stimulator = "sim:stimulator",
                        const std::string& model = "DS2072A");

    [[nodiscard]] Oscilloscope& scope() { return *opened_.oscilloscope; }
    [[nodiscard]] sigrok_driver::EmulatedScopeServer& instrument() { return *server_; }
    [[nodiscard]] SimBench& bench() { return bench_; }
    [[nodiscard]] std::string uri() const;

    /// Settings applied, armed, the instrument waiting.
    void arm(const ScopeSettings& settings);
    /// Signal time passes; then the instrument's record, if one is complete, is read out.
    void pass(Seconds duration);
    /// The next capture, at most `timeout` of real time later.
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
