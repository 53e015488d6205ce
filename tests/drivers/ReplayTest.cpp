// Recordings and captures as devices: the suites that every device must pass, and behaviour that only files have.
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tuple>

#include "core/devices/Device.h"
#include "core/measure/CaptureFile.h"
#include "core/measure/PulseMeasurement.h"
#include "drivers/replay/ReplayDrivers.h"
#include "tests/drivers/conformance/OscilloscopeConformance.h"
#include "tests/drivers/conformance/SensorConformance.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// Writes 2 s of acceleration at 1 kHz and taxels at 50 Hz; their own clock starts at 100 s.
void writeRecording(const ScratchDir& folder, const std::string& origin = {}) {
    std::string acceleration = "time,X\n";
    for (int i = 0; i < 2000; ++i) acceleration += fmt::format("{:.3f},{}\n", 100 + i * 0.001, i);
    std::string taxels = "ms,a,b\n";
    for (int i = 0; i < 100; ++i) taxels += fmt::format("{},{},1\n", 100'000 + i * 20, i);
    folder.write("a.csv", acceleration);
    folder.write("t.csv", taxels);
    folder.write("recording.json",
                 "{" + origin + R"("title": "made up", "baseline": [100, 100.5], "contact": [[101, 102]], "streams": [
        {"kind": "acceleration", "file": "a.csv", "time_column": "time", "time_unit": "s", "columns": ["X"],
         "unit": "m/s2"},
        {"kind": "taxels", "file": "t.csv", "time_column": "ms", "time_unit": "ms", "columns": ["a", "b"],
         "unit": "count"}]})");
}

Capture pulseCapture(double start_s) {
    Capture capture;
    capture.rate_hz = 100'000;
    capture.start_s = start_s;
    capture.channels = {{"voltage", "V", std::vector<float>(200, 0)}, {"current", "A", std::vector<float>(200, 0)}};
    for (std::size_t i = 50; i < 70; ++i) capture.channels[0].samples[i] = 10;
    for (std::size_t i = 80; i < 100; ++i) capture.channels[0].samples[i] = -10;
    return capture;
}

class FileBench {
public:
    Result<void> open(Driver& driver, const std::string& uri) {
        const auto parsed = DeviceUri::parse(uri);
        return driver.open(*parsed, {}, OpenContext{clock, 1, "1 kohm"}, devices);
    }
    void wait(Seconds duration) { clock.advanceTo(clock.now() + toInstant(duration)); }
    VirtualClock clock;
    DeviceSet devices;
};

class RecordingRig final : public SensorRig {
public:
    RecordingRig() {
        writeRecording(folder_);
        bench_.wait(Seconds(3));
        const auto opened = bench_.open(*makeRecordingDriver(), "recording:" + folder_.path().string());
        if (!opened) throw std::runtime_error(opened.error().message);
    }
    TactileSensor& device() override { return *bench_.devices.sensor; }
    const Clock& clock() const override { return bench_.clock; }
    void wait(Seconds duration) override { bench_.wait(duration); }
    bool unplug() override { return false; }

private:
    ScratchDir folder_;
    FileBench bench_;
};

class CaptureRig final : public OscilloscopeRig {
public:
    CaptureRig() {
        EXPECT_TRUE(writeCapture(folder_.path() / "1.csv", pulseCapture(1.0)));
        const auto opened = bench_.open(*makeCaptureDriver(), "capture:" + folder_.path().string());
        if (!opened) throw std::runtime_error(opened.error().message);
    }
    Oscilloscope& device() override { return *bench_.devices.oscilloscope; }
    const Clock& clock() const override { return bench_.clock; }
    // A folder's first record is due once it would have ended, so time must not pass until a test needs it to.
    void wait(Seconds) override {}
    bool pulse() override { return false; }
    bool unplug() override { return false; }

private:
    ScratchDir folder_;
    FileBench bench_;
};

INSTANTIATE_TEST_SUITE_P(Replay, SensorConformance,
                         testing::Values(SensorKind{"recording", [] { return std::make_unique<RecordingRig>(); }}),
                         [](const auto& each) { return each.param.name; });
INSTANTIATE_TEST_SUITE_P(Replay, OscilloscopeConformance,
                         testing::Values(OscilloscopeKind{"capture", [] { return std::make_unique<CaptureRig>(); }}),
                         [](const auto& each) { return each.param.name; });

TEST(ReplayedRecording, StartsWhenItIsOpenedAndKeepsItsIntervals) {
    const ScratchDir folder;
    writeRecording(folder);
    FileBench bench;
    bench.wait(Seconds(10));
    ASSERT_TRUE(bench.open(*makeRecordingDriver(), "recording:" + folder.path().string()));
    auto& sensor = *bench.devices.sensor;
    EXPECT_FALSE(sensor.identity().simulated);
    EXPECT_EQ(sensor.identity().name, "recording: made up");
    EXPECT_NEAR(sensor.declared().baseline->end_s, 10.5, 1e-9);
    EXPECT_NEAR(sensor.declared().contact->front().begin_s, 11, 1e-9);
    std::vector<SampleBlock> blocks(2);
    bench.wait(Seconds(0.1));
    ASSERT_TRUE(sensor.read(blocks));
    EXPECT_NEAR(blocks[0].t_s.front(), 10, 1e-9);
    EXPECT_NEAR(blocks[0].t_s.back(), 10.1, 0.0011);
    EXPECT_FALSE(sensor.finished());
    bench.wait(Seconds(5));
    ASSERT_TRUE(sensor.read(blocks));
    EXPECT_EQ(blocks[0].samples(), 2000U);
    EXPECT_EQ(blocks[1].samples(), 100U);
    EXPECT_TRUE(sensor.finished());
}

TEST(ReplayedRecording, PlaysFaster) {
    const ScratchDir folder;
    writeRecording(folder);
    FileBench bench;
    ASSERT_TRUE(bench.open(*makeRecordingDriver(), "recording:" + folder.path().string() + "?speed=2"));
    auto& sensor = *bench.devices.sensor;
    EXPECT_NEAR(sensor.streams()[0].rate_hz, 2000, 1e-6);
    std::vector<SampleBlock> blocks(2);
    bench.wait(Seconds(1.01));
    ASSERT_TRUE(sensor.read(blocks));
    EXPECT_EQ(blocks[0].samples(), 2000U);
    EXPECT_TRUE(sensor.finished());
}

StatedOrigin originOf(const Device& device) { return dynamic_cast<const ReplayedDevice&>(device).statedOrigin(); }

TEST(ReplayedRecording, StaysWhatItIsStatedToBe) {
    RecordProperty("hazard", "H9");
    for (const auto& [text, origin, simulated] : {std::tuple{"", StatedOrigin::NotStated, false},
                                                  {R"("simulated": true, )", StatedOrigin::Simulated, true},
                                                  {R"("simulated": false, )", StatedOrigin::Measured, false}}) {
        const ScratchDir folder;
        writeRecording(folder, text);
        FileBench bench;
        ASSERT_TRUE(bench.open(*makeRecordingDriver(), "recording:" + folder.path().string()));
        EXPECT_EQ(originOf(*bench.devices.sensor), origin) << text;
        EXPECT_EQ(bench.devices.sensor->identity().simulated, simulated) << text;
    }
}

TEST(ReplayedRecording, RefusesWhatItCannotOpen) {
    FileBench bench;
    auto driver = makeRecordingDriver();
    const ScratchDir folder;
    writeRecording(folder);
    const auto uri = "recording:" + folder.path().string();
    EXPECT_THAT(bench.open(*driver, "recording:").error().message, HasSubstr("names no recording"));
    EXPECT_THAT(bench.open(*driver, "recording:/no/such").error().message, HasSubstr("/no/such"));
    for (const char* bad : {"?speed=0", "?speed=nan", "?speed=fast"}) {
        EXPECT_THAT(bench.open(*driver, uri + bad).error().message, HasSubstr("is not accepted: 0.01 to 100")) << bad;
    }
    EXPECT_THAT(bench.open(*driver, uri + "?loop=1").error().message, HasSubstr("it takes speed"));
    EXPECT_TRUE(bench.open(*driver, uri));
    EXPECT_THAT(bench.open(*driver, uri).error().message, HasSubstr("open already"));
    EXPECT_TRUE(driver->runsOnVirtualClock());
}

TEST(ReplayedCaptures, ComeInOrderFromArmingOnAtTheirOwnDistances) {
    const ScratchDir folder;
    ASSERT_TRUE(writeCapture(folder.path() / "a.csv", pulseCapture(20.0)));
    ASSERT_TRUE(writeCapture(folder.path() / "b.csv", pulseCapture(20.5)));
    ASSERT_TRUE(writeCapture(folder.path() / "c.csv", pulseCapture(1000)));
    FileBench bench;
    ASSERT_TRUE(bench.open(*makeCaptureDriver(), "capture:" + folder.path().string()));
    auto& scope = *bench.devices.oscilloscope;
    ScopeSettings settings;
    settings.triggerLevel = 5;
    ASSERT_TRUE(scope.configure(settings));
    bench.wait(Seconds(1));
    EXPECT_FALSE(scope.poll()->has_value()) << "not armed";
    ASSERT_TRUE(scope.arm());
    EXPECT_FALSE(scope.poll()->has_value()) << "the record is not yet complete";
    bench.wait(Seconds(0.1));
    const auto first = scope.poll();
    ASSERT_TRUE(first->has_value());
    EXPECT_FALSE((*first)->simulated);
    EXPECT_NEAR((*first)->start_s, 1.0, 1e-6);
    EXPECT_NEAR((*first)->trigger_s, 1.0005, 2e-5);
    EXPECT_FALSE(scope.poll()->has_value()) << "the second is half a second later";
    bench.wait(Seconds(0.5));
    EXPECT_NEAR((*scope.poll())->trigger_s, 1.5005, 2e-5);
    scope.disarm();
    ASSERT_TRUE(scope.arm());
    bench.wait(Seconds(0.4));
    EXPECT_NEAR((*scope.poll())->trigger_s, 1.6005, 2e-5) << "armed at 1.6 s: the gap between files is not waited out";
    bench.wait(Seconds(5));
    EXPECT_FALSE(scope.poll()->has_value());
}

TEST(ReplayedCaptures, StayWhatTheyAreStatedToBe) {
    RecordProperty("hazard", "H9");
    for (const auto& [text, origin, simulated] :
         {std::tuple{"", StatedOrigin::NotStated, false},
          {R"({"simulated": true})", StatedOrigin::Simulated, true},
          {R"({"simulated": false})", StatedOrigin::Measured, false},
          {R"({"simulated": "no"})", StatedOrigin::NotStated, false},
          {R"({"simulated": true, "simulated": false})", StatedOrigin::NotStated, false}}) {
        const ScratchDir folder;
        ASSERT_TRUE(writeCapture(folder.path() / "a.csv", pulseCapture(20.0)));
        if (*text != '\0') folder.write("origin.json", text);
        FileBench bench;
        ASSERT_TRUE(bench.open(*makeCaptureDriver(), "capture:" + folder.path().string()));
        auto& scope = *bench.devices.oscilloscope;
        EXPECT_EQ(originOf(scope), origin) << text;
        EXPECT_EQ(scope.identity().simulated, simulated) << text;
        ASSERT_TRUE(scope.arm());
        bench.wait(Seconds(0.1));
        const auto capture = scope.poll();
        ASSERT_TRUE(capture->has_value());
        EXPECT_EQ((*capture)->simulated, simulated) << text;
    }
}

TEST(ReplayedCaptures, OneThatIsSimulatedMakesThemSoAndOneThatSaysNothingLeavesThemUnknown) {
    RecordProperty("hazard", "H9");
    for (const bool twin : {true, false}) {
        const ScratchDir folder;
        ASSERT_TRUE(writeCapture(folder.path() / "a.csv", pulseCapture(20.0)));
        auto second = pulseCapture(21.0);
        second.simulated = twin;
        ASSERT_TRUE(writeCapture(folder.path() / "b.csv", second));
        if (!twin) folder.write("b.csv", "time_s,voltage_v\n0,0\n1e-6,1\n2e-6,0\n");
        FileBench bench;
        ASSERT_TRUE(bench.open(*makeCaptureDriver(), "capture:" + folder.path().string()));
        EXPECT_EQ(originOf(*bench.devices.oscilloscope), twin ? StatedOrigin::Simulated : StatedOrigin::NotStated);
    }
}

TEST(ReplayedCaptures, SayWhatWasToleratedWhenTheyWereRead) {
    const ScratchDir folder;
    const auto file = folder.path() / "a.csv";
    ASSERT_TRUE(writeCapture(file, pulseCapture(20.0)));
    std::ofstream(file, std::ios::app) << ",,\n";
    FileBench bench;
    ASSERT_TRUE(bench.open(*makeCaptureDriver(), "capture:" + folder.path().string()));
    auto& scope = *bench.devices.oscilloscope;
    ASSERT_TRUE(scope.arm());
    bench.wait(Seconds(0.1));
    const auto capture = scope.poll();
    ASSERT_TRUE(capture->has_value());
    ASSERT_EQ((*capture)->warnings.size(), 1U);
    EXPECT_THAT((*capture)->warnings[0], HasSubstr("a.csv:202: a row without values at the end left out"));
    const std::vector<Capture> all{**capture};
    EXPECT_THAT(measureTrains(all, "voltage")->warnings, testing::Contains((*capture)->warnings[0]));
}

TEST(ReplayedCaptures, RefusesFoldersWithoutCaptures) {
    FileBench bench;
    auto driver = makeCaptureDriver();
    const ScratchDir folder;
    const auto uri = "capture:" + folder.path().string();
    EXPECT_THAT(bench.open(*driver, uri).error().message, HasSubstr("holds no capture"));
    EXPECT_THAT(bench.open(*driver, "capture:/no/such").error().message, HasSubstr("is not a folder"));
    folder.write("x.csv", "time_s,voltage_v\n0,zero\n");
    EXPECT_THAT(bench.open(*driver, uri).error().message, HasSubstr("x.csv"));
    EXPECT_THAT(bench.open(*driver, uri + "?a=1").error().message, HasSubstr("takes none"));
}

}  // namespace
}  // namespace tacto::test
