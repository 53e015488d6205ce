// Runs the suite that every stimulator must pass on the ScienceMode driver with the emulated device.
#include "tests/drivers/conformance/StimulatorConformance.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"

namespace tacto::test {
namespace {

class ScienceModeRig final : public StimulatorRig {
public:
    explicit ScienceModeRig(sciencemode::StimulatorSettings settings = {}) : bench_({}, settings) {}
    Stimulator& device() override { return *bench_.stimulator; }
    const Clock& clock() const override { return bench_.clock; }
    void wait(Seconds duration) override { bench_.wait(duration); }
    /// Counts the output as on if a pulse comes within one and a half periods of 100 Hz.
    std::optional<bool> outputOn() override {
        const auto before = bench_.line->pulses();
        bench_.wait(Seconds(0.015));
        return bench_.line->pulses() > before;
    }
    void close() override { bench_.stimulator.reset(); }
    bool unplug() override {
        bench_.line->unplug();
        return true;
    }

private:
    ScienceModeBench bench_;
};

INSTANTIATE_TEST_SUITE_P(ScienceMode, StimulatorConformance,
                         testing::Values(StimulatorKind{"LowLevel", [] { return std::make_unique<ScienceModeRig>(); }},
                                         StimulatorKind{"CurrentReadBack",
                                                        [] {
                                                            sciencemode::StimulatorSettings settings;
                                                            settings.measurement = sciencemode::Measurement::Current;
                                                            return std::make_unique<ScienceModeRig>(settings);
                                                        }},
                                         StimulatorKind{"OtherChannel",
                                                        [] {
                                                            sciencemode::StimulatorSettings settings;
                                                            settings.channel = 3;
                                                            settings.connector = 1;
                                                            return std::make_unique<ScienceModeRig>(settings);
                                                        }}),
                         [](const testing::TestParamInfo<StimulatorKind>& kind) { return kind.param.name; });

}  // namespace
}  // namespace tacto::test
