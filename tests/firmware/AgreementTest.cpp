// The board's encoder gives the bench's R, P and trains, on every recording here and on the simulated finger.
#include <gtest/gtest.h>
#include <iostream>

#include "drivers/simulated/SimulatedDriver.h"
#include "tests/firmware/BoardAndHost.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

/// What issue 51 asks for. Returns the number of trains.
std::size_t expectAgreement(const Samples& samples, const RoughnessSettings& roughness, const std::string& what,
                            const EncodingProfile& encoding = {}) {
    const auto found = compare(samples, roughness, encoding, what);
    EXPECT_LE(found.maxR, 0.01) << what;
    EXPECT_LE(found.maxP, 0.002) << what;
    double sample_s = 1e-3;  // without acceleration
    for (const auto& info : samples.streams)
        if (info.kind == StreamKind::Acceleration) sample_s = 1 / info.rate_hz;
    EXPECT_LE(found.maxOnset_s, sample_s) << what;
    EXPECT_LE(found.maxAmplitude, 0.005) << what;
    std::cout << what << ": " << found.board.frames.size() << " frames, " << found.board.trains.size()
              << " trains; differences: R " << found.maxR << ", P " << found.maxP << ", onset " << found.maxOnset_s
              << " s, amplitude " << 100 * found.maxAmplitude << " %\n";
    return found.board.trains.size();
}

std::size_t expectAgreementOnEach(const fs::path& folder) {
    std::size_t found = 0, trains = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        const auto recording = Recording::open(entry.path());
        if (!recording) continue;  // others' refusals have their own tests
        ++found;
        const Samples samples{recording->infos(), recording->blocks()};
        const auto what = fs::relative(entry.path(), folder.parent_path()).string();
        for (const auto taxel : {TaxelFeature::Static, TaxelFeature::Dynamic}) {
            RoughnessSettings roughness;
            roughness.taxel = taxel;
            if (taxel == TaxelFeature::Dynamic) roughness.spectral = SpectralFeature::Absolute;
            trains += expectAgreement(samples, roughness, what);
        }
    }
    EXPECT_GT(found, 0U) << folder;
    return trains;
}

Samples simulated(const std::string& uri, double seconds, std::uint64_t seed) {
    VirtualClock clock;
    DeviceSet devices;
    const auto driver = makeSimulatedDriver();
    const auto opened = driver->open(DeviceUri::parse(uri).value(), {}, OpenContext{clock, seed, "1 kohm"}, devices);
    EXPECT_TRUE(opened) << opened.error().message;
    Samples samples;
    const auto streams = devices.sensor->streams();
    samples.streams.assign(streams.begin(), streams.end());
    samples.blocks.resize(streams.size());
    while (toSeconds(clock.now()) < seconds) {
        clock.advanceTo(clock.now() + toInstant(0.01));
        EXPECT_TRUE(devices.sensor->read(samples.blocks));
    }
    return samples;
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
            const auto samples = simulated(uri, 12, 3);
            trains += expectAgreement(samples, {}, uri, shipped);
            trains += expectAgreement(samples, {}, uri + ", curved and swapped", curved);
        }
    }
    for (const char* more : {"rate=2000", "dropouts=0.02", "speed=5mm/s", "fault=stale@3s..3.5s", "fault=nan@3s..3.2s",
                             "fault=stuck@3s..4s"}) {
        const auto uri = fmt::format("sim:finger?material=P120&{}", more);
        trains += expectAgreement(simulated(uri, 12, 4), {}, uri, shipped);
    }
    EXPECT_GT(trains, 150U);
}

}  // namespace tacto::test
