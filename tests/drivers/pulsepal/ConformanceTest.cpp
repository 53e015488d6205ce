// Runs the suite that every stimulator must pass on the Pulse Pal driver with the emulated device.
#include "tests/drivers/conformance/StimulatorConformance.h"
#include "tests/drivers/pulsepal/PulsePalLine.h"

namespace tacto::test {
namespace {

class PulsePalRig final : public StimulatorRig {
public:
    explicit PulsePalRig(int channel) : bench_(channel) {}
    Stimulator& device() override { return *bench_.stimulator; }
    const Clock& clock() const override { return bench_.clock; }
    void wait(Seconds duration) override { bench_.wait(duration); }
    std::optional<bool> outputOn() override { return bench_.line->active(); }
    void close() override { bench_.stimulator.reset(); }
    bool unplug() override {
        bench_.line->unplug();
        return true;
    }

private:
    PulsePalBench bench_;
};

INSTANTIATE_TEST_SUITE_P(PulsePal, StimulatorConformance,
                         testing::Values(StimulatorKind{"Channel1", [] { return std::make_unique<PulsePalRig>(1); }},
                                         StimulatorKind{"Channel4", [] { return std::make_unique<PulsePalRig>(4); }}),
                         [](const testing::TestParamInfo<StimulatorKind>& kind) { return kind.param.name; });

}  // namespace
}  // namespace tacto::test
