// The control loop in its steady state takes no memory. A program of its own: it replaces operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "core/bench/ControlLoop.h"
#include "core/bench/Profile.h"
#include "tests/bench/FakeStimulator.h"

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
    allocations.fetch_add(1, std::memory_order_relaxed);
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace tacto {
namespace {

using namespace std::chrono_literals;

/// A finger that slides for ever: what it reads was made before.
class TapedFinger final : public TactileSensor {
public:
    explicit TapedFinger(const Clock& clock) : clock_(clock) {}
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    std::span<const StreamInfo> streams() const noexcept override { return streams_; }
    Result<void> read(std::span<SampleBlock> blocks) override {
        const double now = toSeconds(clock_.now());
        for (std::size_t s = 0; s < streams_.size(); ++s) {
            for (; static_cast<double>(next_[s]) / streams_[s].rate_hz <= now; ++next_[s]) {
                const double t = static_cast<double>(next_[s]) / streams_[s].rate_hz;
                blocks[s].t_s.push_back(t);
                for (std::size_t c = 0; c < streams_[s].channels; ++c) {
                    noise_ = noise_ * 6364136223846793005ULL + 1442695040888963407ULL;
                    const double n = static_cast<double>(noise_ >> 40U) * 0x1.0p-24 - 0.5;
                    const bool touching = t > 0.5;
                    const double value = s == 0   ? (touching ? 3 * n : 0.01 * n)
                                         : s == 1 ? (touching ? 1000.0 * static_cast<double>(c + 1) + 20 * n : 2 * n)
                                                  : (touching ? 2.0 : 0.0);
                    blocks[s].values.push_back(value);
                }
            }
        }
        return {};
    }

private:
    const Clock& clock_;
    DeviceIdentity identity_{"taped:", Role::Sensor, "Taped finger", "", "", true};
    std::vector<StreamInfo> streams_{
        {StreamKind::Acceleration, StreamUnit::MetresPerSecondSquared, 3, 4000, "acceleration"},
        {StreamKind::Taxels, StreamUnit::Pascals, 8, 200, "taxels"},
        {StreamKind::Force, StreamUnit::Newtons, 1, 200, "force"}};
    std::uint64_t next_[3] = {0, 0, 0};
    std::uint64_t noise_ = 1;
};

TEST(ControlLoop, TakesNoMemoryInItsSteadyState) {
    VirtualClock clock;
    SafetyGate gate(clock);
    Interlock interlock;
    Heartbeat heartbeat;
    test::FakeStimulator device(clock);
    StimulatorSession stimulator(device, gate, heartbeat, clock, {});
    TapedFinger finger(clock);
    auto sensor = SensorSession::create(finger).value();
    const Profile profile;
    ControlLoop loop({clock, gate, interlock, heartbeat, OutputMode::BenchLoad, &stimulator, nullptr, 0, {}},
                     FingerInput::create(*sensor, profile.roughness).value(),
                     std::make_unique<TrainPlanner>(profile.encoding, device.traits(), gate));
    ASSERT_TRUE(interlock.connect());
    const auto ticket = interlock.requestArming(clock.now()).value();
    ASSERT_TRUE(interlock.confirmArming(ticket, clock.now()));
    ArmCommand command;
    command.setup = test::benchSetup(device.traits());
    command.evidence = {.limitsLoaded = true,
                        .deviceIdentified = true,
                        .operatorConfirmed = true,
                        .impedanceLow = Ohms(800),
                        .impedanceHigh = Ohms(1200)};
    command.impedanceRange = [](std::optional<double>) { return std::pair(Ohms(800), Ohms(1200)); };
    loop.arm(std::move(command));
    loop.drive({DriveSource::Sensor, 0, 0});

    const auto turn = [&] {
        clock.advanceTo(clock.now() + ControlLoop::kPeriod);
        sensor->serve(clock.now());
        loop.step(clock.now());
        stimulator.serve(clock.now());
        stimulator.serve(clock.now());
    };
    for (int i = 0; i < 1000; ++i) turn();  // 5 s: baseline, contact, the first trains
    ASSERT_GT(loop.telemetry().trainsDelivered, 1U) << loop.telemetry().lastRefusal.view();

    const auto deliveredBefore = loop.telemetry().trainsDelivered;
    const long before = allocations.load();
    for (int i = 0; i < 2000; ++i) turn();
    EXPECT_EQ(allocations.load() - before, 0);
    EXPECT_GT(loop.telemetry().trainsDelivered, deliveredBefore);
}

}  // namespace
}  // namespace tacto
