// Measures how soon libusb has an approved train, and how late a keep-alive becomes while both cores are busy: the real
// libusb with an emulated stimulator. Started through with-emulated-usb.
//
// Baseline of the latency: the same bytes written to the transport without driver, gate or protocol.
#include <algorithm>
#include <fmt/format.h>
#include <thread>

#include "core/bench/delivery/StimulatorSession.h"
#include "core/safety/SafetyGate.h"
#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "drivers/usb/UsbPorts.h"
#include "tests/drivers/sciencemode/EmulatedOnUsb.h"
#include "tests/perf/Verdict.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

constexpr int kTrains = 200;
constexpr auto kUnderLoad = 10s;

/// The ports of the bus, and the last transport opened.
class WatchedPorts final : public TransportPorts {
public:
    explicit WatchedPorts(std::shared_ptr<TransportPorts> ports) : ports_(std::move(ports)) {}
    std::vector<TransportPort> list() const override { return ports_->list(); }
    Result<std::unique_ptr<Transport>> open(const TransportPort& port) override {
        auto opened = ports_->open(port);
        if (opened) transport = dynamic_cast<UsbBulkTransport*>(opened->get());
        return opened;
    }
    UsbBulkTransport* transport = nullptr;

private:
    const std::shared_ptr<TransportPorts> ports_;
};

double microseconds(Steady::duration d) { return std::chrono::duration<double, std::micro>(d).count(); }

/// Prints the median and the 99 % value; returns the median in microseconds.
double print(const char* what, std::vector<double> us) {
    std::ranges::sort(us);
    fmt::print("{:<58} median {:7.1f} us   99 % {:7.1f} us\n", what, us[us.size() / 2], us[us.size() * 99 / 100]);
    return us[us.size() / 2];
}

GateSetup setupFor(const SourceTraits& source) {
    GateSetup setup;
    setup.source = source;
    setup.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    setup.limits = test::limitSets();
    return setup;
}

TrainRequest requestFor(Instant now) {
    TrainRequest request;
    request.train.amplitude = Milliamps(5);
    request.interval = Seconds(0.5);
    request.onset = now;
    return request;
}

/// Measures from the gate's approval to the last byte in libusb.
void latency(Stimulator& device, const UsbBulkTransport& transport, SafetyGate& gate, const Clock& clock) {
    std::vector<double> whole, bare;
    for (int i = 0; i < kTrains; ++i) {
        auto approved = gate.approve(requestFor(clock.now()));
        if (!approved) {
            fmt::print("MISSED: the gate refuses: {}\n", approved.error().message);
            return;
        }
        const auto begin = Steady::now();
        if (const auto sent = device.deliver(std::move(*approved)); !sent) {
            fmt::print("MISSED: not delivered: {}\n", sent.error().message);
            return;
        }
        whole.push_back(microseconds(transport.submittedAt() - begin));
        std::this_thread::sleep_for(12ms);  // the pulse ends, and its period of 10 ms is over
        static_cast<void>(device.status());
    }
    auto& wire = const_cast<UsbBulkTransport&>(transport);
    const std::array<std::uint8_t, 24> bytes{};  // not a valid frame: the device drops these bytes
    for (int i = 0; i < kTrains; ++i) {
        const auto begin = Steady::now();
        if (!wire.write(bytes, Seconds(1))) return;
        bare.push_back(microseconds(wire.submittedAt() - begin));
        std::this_thread::sleep_for(2ms);
    }
    const double median_us = print("approved train to libusb", whole);
    const double bare_us = print("  baseline: the bytes alone to libusb", bare);
    fmt::print("  {}{}\n", verdict(median_us / bare_us, "the bytes alone", 3), ofLimit(median_us, 200, "us wanted"));
}

/// Measures keep-alives during a train, while the loop beats and both cores are busy.
void keepAlive(Stimulator& device, SafetyGate& gate, const Clock& clock) {
    Heartbeat heartbeat;
    StimulatorSession session(device, gate, heartbeat, clock, {});
    std::atomic<bool> quit{false};
    std::vector<std::thread> busy;
    for (unsigned i = 0; i < 2 * std::max(1U, std::thread::hardware_concurrency()); ++i) {
        busy.emplace_back([&quit, x = 1.0]() mutable {
            while (!quit) x = x * 1.0000001 + 1e-9;
        });
    }
    std::thread loop([&] {
        while (!quit) {
            heartbeat.beat(clock.now());
            std::this_thread::sleep_for(5ms);
        }
    });
    std::this_thread::sleep_for(50ms);
    auto request = requestFor(clock.now());
    request.train.pulses = 600;
    request.train.rate = Hertz(50);
    request.interval = Seconds(14);  // the device's clock may be 5 % off
    auto approved = gate.approve(request);
    const auto begun = approved ? device.deliver(std::move(*approved)) : Result<void>(failure(approved));
    const auto end = Steady::now() + kUnderLoad;
    while (begun && Steady::now() < end) {
        const auto next = session.serve(clock.now());
        std::this_thread::sleep_for(std::min(next - clock.now(), Instant(20ms)));
    }
    const auto worst = session.longestKeepAliveGap();
    quit = true;
    loop.join();
    for (auto& thread : busy) thread.join();
    device.forceOff();
    if (!begun) {
        fmt::print("MISSED: not delivered: {}\n", begun.error().message);
        return;
    }
    const double worst_ms = std::chrono::duration<double, std::milli>(worst).count();
    fmt::print("{:<58} {:.0f} ms in {} s{}\n",
               fmt::format("longest time between keep-alives, {} busy threads", busy.size()), worst_ms,
               kUnderLoad.count(), ofLimit(worst_ms, 2000, "ms of its dead-man"));
}

int run() {
    test::UsbTestbed bed;
    SteadyClock clock;
    test::EmulatedOnUsb plugged(bed, clock);
    auto ports = std::make_shared<WatchedPorts>(makeUsbPorts(makeUsbProvider(), {{0x0483, 0x5740}}, {}));
    for (int i = 0; i < 500 && ports->list().empty(); ++i) std::this_thread::sleep_for(10ms);
    const auto opened = sciencemode::ScienceModeStimulator::open([&] { return ports->open(ports->list().at(0)); },
                                                                 "sciencemode:", {}, {}, clock);
    if (!opened) {
        fmt::print(stderr, "{}\n", opened.error().message);
        return 1;
    }
    SafetyGate gate(clock);
    if (const auto configured = gate.configure(setupFor((*opened)->traits())); !configured) {
        fmt::print(stderr, "{}\n", configured.error().message);
        return 1;
    }
    fmt::print("USB, emulated by umockdev\n");
    latency(**opened, *ports->transport, gate, clock);
    keepAlive(**opened, gate, clock);
    return 0;
}

}  // namespace
}  // namespace tacto

int main() { return tacto::run(); }
