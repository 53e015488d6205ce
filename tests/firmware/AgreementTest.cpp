// The board's encoder gives the bench's R, P and trains, on every recording here and on the simulated finger.
#include <gtest/gtest.h>
#include <iostream>

#include "app/run/EncoderComparison.h"
#include "core/acquisition/Recording.h"
#include "drivers/replay/ReplayDrivers.h"
#include "drivers/sensor_board/SimulatedBoard.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

struct Trains {
    std::size_t trains = 0, refused = 0;
};

/// What issue 51 asks for, until the sensor has finished or for `seconds`.
Trains expectAgreement(Driver& driver, const DeviceUri& uri, const Profile& profile, const std::string& what,
                       double seconds = 1e9, const EncoderOutput& output = idealOutput()) {
    VirtualClock clock;
    DeviceSet devices;
    const auto opened = driver.open(uri, {}, OpenContext{clock, 3, "1 kohm"}, devices);
    EXPECT_TRUE(opened) << opened.error().message;
    if (!opened) return {};
    auto comparison = EncoderComparison::create(*devices.sensor, profile, output, limitSets(), clock);
    EXPECT_TRUE(comparison) << what << ": " << comparison.error().message;
    if (!comparison) return {};
    for (bool last = false; !last && toSeconds(clock.now()) < seconds;) {
        last = devices.sensor->finished();
        const auto turned = (*comparison)->turn();
        EXPECT_TRUE(turned) << turned.error().message;
        clock.advanceTo(clock.now() + EncoderComparison::kTurn);
    }
    const auto found = (*comparison)->agreement();
    EXPECT_TRUE(found.refusedAlike) << what << ": " << found.unlike;
    EXPECT_EQ(found.unlike, "");
    EXPECT_EQ(found.acceptedR, 0.01);
    EXPECT_EQ(found.acceptedP, 0.002);
    EXPECT_EQ(found.acceptedAmplitude, 0.005);
    EXPECT_LE(found.acceptedOnset_s, 0.0102);
    EXPECT_EQ(found.lost, 0U);
    EXPECT_LE(found.maxR, found.acceptedR) << what;
    EXPECT_LE(found.maxP, found.acceptedP) << what;
    EXPECT_LE(found.maxOnset_s, found.acceptedOnset_s) << what;
    if (output.source.amplitudeStep == 0)
        EXPECT_LE(found.maxAmplitude, found.acceptedAmplitude) << what;
    else
        EXPECT_LE(found.maxAmplitudeSteps, 1.0001) << what;
    EXPECT_TRUE(found.holds()) << what;
    std::cout << what << ": " << found.frames << " frames, " << found.trains << " trains; differences: R " << found.maxR
              << ", P " << found.maxP << ", onset " << found.maxOnset_s << " s, amplitude " << 100 * found.maxAmplitude
              << " %, refused " << (*comparison)->board().refused_s.size() << "\n";
    return {found.trains, (*comparison)->board().refused_s.size()};
}

std::size_t expectAgreementOnEach(const fs::path& folder) {
    const auto driver = makeRecordingDriver();
    std::size_t found = 0, trains = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        if (!Recording::open(entry.path())) continue;  // others' refusals have their own tests
        ++found;
        const auto what = fs::relative(entry.path(), folder.parent_path()).string();
        for (const auto taxel : {TaxelFeature::Static, TaxelFeature::Dynamic}) {
            Profile profile;
            profile.roughness.taxel = taxel;
            if (taxel == TaxelFeature::Dynamic) profile.roughness.spectral = SpectralFeature::Absolute;
            trains += expectAgreement(*driver, {"recording", entry.path().string(), {}}, profile, what).trains;
        }
    }
    EXPECT_GT(found, 0U) << folder;
    return trains;
}

Trains expectAgreementOn(const std::string& uri, const EncodingProfile& encoding,
                         const EncoderOutput& output = idealOutput()) {
    Profile profile;
    profile.encoding = encoding;
    const auto driver =
        makeSimulatedDriver(SimulatedBoards{sensorboard::SimulatedBoard::isOwn, sensorboard::SimulatedBoard::open});
    return expectAgreement(*driver, DeviceUri::parse(uri).value(), profile, uri, 12, output);
}

}  // namespace

TEST(EncoderOnBoard, AgreesWithTheBenchOnShippedRecordings) {
    RecordProperty("hazard", "H1");
    EXPECT_GT(expectAgreementOnEach(sourceDir() / "resources" / "examples"), 40U);
}

TEST(EncoderOnBoard, AgreesWithTheBenchOnRealRecordings) {
    std::size_t trains = 0;
    for (const char* folder : {"biotac", "fabric_slide", "hapmat", "cases"}) {
        const auto path = sharedData(folder);
        if (!path) GTEST_SKIP() << kNoSharedData;
        trains += expectAgreementOnEach(*path);
    }
    EXPECT_GT(trains, 200U);
}

TEST(EncoderOnBoard, AgreesWithTheBenchOnTheSimulatedFinger) {
    EncodingProfile shipped;
    shipped.amplitudeRatioPerTrain = 1.2;
    shipped.intervalRatioPerTrain = 1.34;
    EncodingProfile curved = shipped;
    curved.amplitudeCurve.kind = CurveKind::Logarithmic;
    curved.intervalCurve.kind = CurveKind::Power;
    curved.assignment = Assignment::Swapped;
    curved.amplitudeSlew_V_per_s = 8;
    std::size_t trains = 0;
    for (const char* material : {"P60", "P120", "plastic", "denim"}) {
        for (const char* force : {"0.4N", "3N"}) {
            const auto uri = fmt::format("sim:finger?material={}&force={}", material, force);
            trains += expectAgreementOn(uri, shipped).trains;
            trains += expectAgreementOn(uri, curved).trains;
        }
    }
    for (const char* more : {"rate=2000", "dropouts=0.02", "speed=5mm/s", "fault=stale@3s..3.5s", "fault=nan@3s..3.2s",
                             "fault=stuck@3s..4s"})
        trains += expectAgreementOn(fmt::format("sim:finger?material=P120&{}", more), shipped).trains;
    EXPECT_GT(trains, 150U);
}

TEST(EncoderOnBoard, RefusesTheTrainsThatTheBenchRefuses) {
    RecordProperty("hazard", "H1");
    EncodingProfile encoding;
    encoding.train.pulses = 12;
    encoding.intervalMin = Seconds(0.3);
    auto stepped = idealOutput();
    stepped.source.drive = Drive::Current;
    stepped.source.amplitudeStep = 0.25;
    EXPECT_GT(expectAgreementOn("sim:finger?material=P60&force=3N", encoding, stepped).trains, 3U);
    stepped.source.amplitudeStep = 8;  // too coarse for the weaker trains
    const auto made = expectAgreementOn("sim:finger?material=plastic&force=1N", encoding, stepped);
    EXPECT_GT(made.refused, 3U);
}

TEST(EncoderOnBoard, AgreesWithTheBenchThroughItsLine) {
    RecordProperty("hazard", "H1");
    std::size_t trains = 0;
    for (const char* more : {"material=P60&force=0.4N", "material=P120&force=3N", "material=denim&force=1N&drift=50",
                             "material=plastic&rate=2000&drift=-50", "material=P120&dropouts=0.02"})
        trains += expectAgreementOn(fmt::format("sim:board?{}", more), {}).trains;
    EXPECT_GT(trains, 20U);
}

TEST(EncoderAgreement, FindsWhatOneSideAloneHas) {
    EncoderSide bench;
    for (int k = 0; k < 10; ++k) {
        bench.frames.push_back({.t_s = 0.016 * k, .contact = true, .sliding = true, .h = 1, .v = 1, .R = 0.5});
        bench.trains.push_back({2.0 * k, 20});
    }
    bench.refused_s = {30};
    const auto unlike = [&](auto change) {
        EncoderSide board = bench;
        change(board);
        return agreementOf(bench, board, 0).unlike;
    };
    EXPECT_EQ(unlike([](auto&) {}), "");
    EXPECT_EQ(unlike([](auto& board) { board.frames.erase(board.frames.begin() + 2); }),
              "the bench alone has a frame at 0.032 s");
    EXPECT_EQ(unlike([](auto& board) { board.frames[3].R = kNaN; }), "one side alone has R at 0.048 s");
    EXPECT_EQ(unlike([](auto& board) { board.frames[3].contact = false; }), "one side alone has contact at 0.048 s");
    EXPECT_EQ(unlike([](auto& board) { board.trains[4].onset_s += 0.026; }), "the bench alone has a train at 8.000 s");
    EXPECT_EQ(unlike([](auto& board) { board.trains.push_back({40, 20}); }), "the board alone has a train at 40.000 s");
    EXPECT_EQ(unlike([](auto& board) { board.refused_s.clear(); }), "the bench alone refuses a train at 30.000 s");
    EncoderSide board = bench;
    board.frames[1].R = 0.48;
    board.trains[1] = {2.001, 20.3};
    const auto found = agreementOf(bench, board, 0.25);
    EXPECT_NEAR(found.maxR, 0.02, 1e-9);
    EXPECT_NEAR(found.maxOnset_s, 0.001, 1e-9);
    EXPECT_NEAR(found.maxAmplitude, 0.015, 1e-9);
    EXPECT_NEAR(found.maxAmplitudeSteps, 1.2, 1e-9);
    EXPECT_TRUE(found.refusedAlike);
    EXPECT_FALSE(found.holds());
}

}  // namespace tacto::test
