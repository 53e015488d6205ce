#include <thread>

#include "tests/drivers/conformance/OscilloscopeConformance.h"
#include "tests/drivers/sigrok/ScopeOnLan.h"

namespace tacto::test {
namespace {

class LanRig final : public OscilloscopeRig {
public:
    Oscilloscope& device() override { return lan_.scope(); }
    const Clock& clock() const override { return lan_.bench().clock; }
    /// Lets signal time pass, and as much real time, in which a complete record reaches the bench.
    void wait(Seconds duration) override {
        lan_.pass(duration);
        std::this_thread::sleep_for(duration);
    }
    bool pulse() override {
        if (!lan_.instrument().waits(Seconds(5))) return true;  // disarmed: no wait for a trigger, but there is a pulse
        lan_.bench().wait(Seconds(0.02));                       // the part before the trigger must fill
        lan_.bench().deliver(voltagePulse(10), Seconds(0));
        lan_.pass(Seconds(0.01));
        return true;
    }
    bool unplug() override {
        lan_.instrument().unplug();
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        while (lan_.scope().poll() && std::chrono::steady_clock::now() < until) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }

private:
    mutable ScopeOnLan lan_;
};

INSTANTIATE_TEST_SUITE_P(Sigrok, OscilloscopeConformance,
                         testing::Values(OscilloscopeKind{"RigolOnLan", [] { return std::make_unique<LanRig>(); }}),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace tacto::test
