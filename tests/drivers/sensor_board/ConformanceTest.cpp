// Runs what every tactile sensor and every sensor board must pass on the emulated board.
#include "resources/firmware/tactile_encoder/tactile_encoder.h"
#include "tests/drivers/conformance/SensorConformance.h"
#include "tests/drivers/sensor_board/BoardConformance.h"
#include "tests/drivers/sensor_board/SensorBoardBench.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sensorboard;

class EmulatedSensorRig final : public SensorRig {
public:
    EmulatedSensorRig(const EmulatedBoardSettings& settings, bool finger) {
        if (finger) {
            bench_.line = std::make_shared<EmulatedBoardLine>(bench_.clock, &bench_.clock, settings);
        } else {
            bench_.line = std::make_shared<EmulatedBoardLine>(bench_.clock, &bench_.clock, settings,
                                                              std::make_unique<CountingSignal>());
        }
        bench_.open();
    }
    TactileSensor& device() override { return *bench_.board; }
    const Clock& clock() const override { return bench_.clock; }
    void wait(Seconds duration) override { bench_.clock.advanceTo(bench_.clock.now() + toInstant(duration)); }
    bool unplug() override {
        bench_.line->unplug();
        return true;
    }

private:
    SensorBoardBench bench_;
};

SensorKind kind(const char* name, EmulatedBoardSettings settings, bool finger = false) {
    return {name,
            [settings = std::move(settings), finger] { return std::make_unique<EmulatedSensorRig>(settings, finger); }};
}

EmulatedBoardSettings drifting() {
    EmulatedBoardSettings settings;
    settings.drift_ppm = -120;
    settings.jitter = Seconds(0.5e-3);
    return settings;
}

EmulatedBoardSettings losing() {
    EmulatedBoardSettings settings;
    settings.flaws = {0.001, 0.01, 0.001, 0.001};
    settings.slowBlockSamples = 1;  // one lost block is then half a percent of a second
    return settings;
}

EmulatedBoardSettings slow() {
    EmulatedBoardSettings settings;
    settings.rate_hz = 1000;
    settings.slowRate_hz = 100;
    settings.blockSamples = 8;
    settings.slowBlockSamples = 1;
    settings.wideForce = true;
    return settings;
}

INSTANTIATE_TEST_SUITE_P(SensorBoard, SensorConformance,
                         testing::Values(kind("Counting", {}), kind("Finger", {}, true), kind("Drifting", drifting()),
                                         kind("LosingBlocks", losing()), kind("Slow", slow())),
                         [](const testing::TestParamInfo<SensorKind>& of) { return of.param.name; });

class EmulatedBoardRig final : public BoardRig {
public:
    EmulatedBoardRig() {
        EmulatedBoardSettings settings;
        settings.highestVersion = 2;
        settings.encoder = tsb_encoder{0, 0, TE_LAYOUT, 1};
        bench_.line = std::make_shared<EmulatedBoardLine>(bench_.clock, &bench_.clock, settings);
        line_ = accepted(bench_.line->connect());
    }
    Transport& line() override { return *line_; }
    const Clock& clock() const override { return bench_.clock; }
    void wait(Seconds duration) override { bench_.clock.advanceTo(bench_.clock.now() + toInstant(duration)); }

private:
    SensorBoardBench bench_;
    std::unique_ptr<Transport> line_;
};

INSTANTIATE_TEST_SUITE_P(SensorBoard, BoardConformance,
                         testing::Values(BoardKind{"Emulated", [] { return std::make_unique<EmulatedBoardRig>(); }}),
                         [](const testing::TestParamInfo<BoardKind>& of) { return of.param.name; });

}  // namespace
}  // namespace tacto::test
