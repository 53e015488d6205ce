// The shipped example, resources/examples/four-touches: four touches by the twin's fingertip, which use the whole
// chain. If TACTO_WRITE_EXAMPLE names a folder, the test writes the example's files there again.
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "core/acquisition/Recording.h"
#include "core/dsp/RoughnessAnalysis.h"
#include "tests/drivers/SimBench.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

using namespace tacto;
using tacto::test::accepted;
using tacto::test::SimBench;

namespace {

const auto kFourTouches = tacto::test::sourceDir() / "resources/examples/four-touches";

struct Touch {
    const char* material;
    double speed_mmps, force_n, until_s;
};
// Begins in the air, so that sliding differs from rest; then touches smooth and rough, lightly and firmly.
constexpr Touch kTouches[] = {
    {"plastic", 50, 0.3, 1.75}, {"P120", 50, 0.4, 2.75}, {"P60", 50, 4, 7}, {"plastic", 50, 4.5, 8.5}};
constexpr double kRest_s = 0.75, kEnd_s = 8.75;

/// Returns everything that the twin's fingertip measures, one block per stream.
std::vector<SampleBlock> feltByTheTwin() {
    SimBench bench;
    bench.open("sim:finger");
    auto& sensor = *bench.devices.sensor;
    std::vector<SampleBlock> blocks(sensor.streams().size());
    const auto present = [&](const char* material, double speed, double force) {
        const auto done = bench.devices.surface->present(material, MillimetresPerSecond(speed), Newtons(force));
        EXPECT_TRUE(done) << done.error().message;
    };
    const auto until = [&](double t_s) {
        while (toSeconds(bench.clock.now()) < t_s - 1e-9) {
            bench.wait(Seconds(0.05));
            EXPECT_TRUE(sensor.read(blocks));
        }
    };
    present("", 0, 0);
    until(kRest_s);
    for (const auto& touch : kTouches) {
        present(touch.material, touch.speed_mmps, touch.force_n);
        until(touch.until_s);
    }
    present("", 0, 0);
    until(kEnd_s);
    return blocks;
}

/// Formats the table as in the file: whole mg, Pa and mN.
std::string tableOf(const StreamInfo& info, const SampleBlock& block) {
    const bool fast = info.kind == StreamKind::Acceleration;
    std::string out = fast                             ? "x,y,z\n"
                      : info.kind == StreamKind::Force ? "time_ms,F\n"
                                                       : "time_ms,c1,c2,c3,c4,c5,c6,c7,c8\n";
    auto to = std::back_inserter(out);
    for (std::size_t i = 0; i < block.samples(); ++i) {
        if (!fast) fmt::format_to(to, "{}", std::lround(block.t_s[i] * 1000));
        for (std::size_t c = 0; c < info.channels; ++c) {
            const double value = block.values[i * info.channels + c];
            if (c > 0 || !fast) out += ',';
            const double whole = fast ? value / 9.80665e-3 : info.kind == StreamKind::Force ? value * 1000 : value;
            fmt::format_to(to, "{}", std::lround(whole));
        }
        out += '\n';
    }
    return out;
}

}  // namespace

TEST(ExampleRecording, IsWhatTheTwinFeels) {
    const auto blocks = feltByTheTwin();
    SimBench bench;
    bench.open("sim:finger");
    const auto infos = bench.devices.sensor->streams();
    if (const char* folder = std::getenv("TACTO_WRITE_EXAMPLE")) {
        for (std::size_t s = 0; s < infos.size(); ++s) {
            std::ofstream file(std::filesystem::path(folder) / fmt::format("{}.csv", nameOf(infos[s].kind)));
            file << tableOf(infos[s], blocks[s]);
            ASSERT_TRUE(file.flush());
        }
    }
    const auto shipped = accepted(Recording::open(kFourTouches));
    EXPECT_EQ(shipped.simulated, true);
    EXPECT_THAT(shipped.title, testing::HasSubstr("imulated"));
    for (std::size_t s = 0; s < infos.size(); ++s) {
        const auto* stream = shipped.find(infos[s].kind);
        ASSERT_NE(stream, nullptr);
        EXPECT_NEAR(stream->info.rate_hz, infos[s].rate_hz, 1e-6);
        ASSERT_EQ(stream->samples.samples(), blocks[s].samples());
        ASSERT_EQ(stream->info.channels, infos[s].channels);
        EXPECT_NEAR(stream->samples.t_s.front(), blocks[s].t_s.front(), 1e-6);
        // Another maths library may round differently: allow two steps of the sensor or of the file.
        const double step = infos[s].kind == StreamKind::Acceleration ? 0.02
                            : infos[s].kind == StreamKind::Force      ? 0.002
                                                                      : 2;
        std::size_t far = 0;
        for (std::size_t i = 0; i < blocks[s].values.size(); ++i)
            far += std::abs(stream->samples.values[i] - blocks[s].values[i]) <= step ? 0 : 1;
        EXPECT_EQ(far, 0U) << nameOf(infos[s].kind) << ": run with TACTO_WRITE_EXAMPLE=" << kFourTouches.string();
    }
}

TEST(ExampleRecording, MovesEverythingThatTheChainShows) {
    const auto shipped = accepted(Recording::open(kFourTouches));
    const auto found = accepted(analyseRoughness(shipped.infos(), shipped.blocks(), {}, shipped.declared));
    const auto& summary = found.summary;
    EXPECT_GT(summary.contactFrames, summary.frames / 2);
    EXPECT_THAT(summary.flags, testing::ElementsAre("uncalibrated R"));
    for (const auto* feature : {&summary.h, &summary.v}) {
        EXPECT_GT(feature->n, 100U);
        EXPECT_GT(feature->max, 3 * feature->min);
    }
    EXPECT_LT(summary.R.min, 0.25);
    EXPECT_GT(summary.R.max, 0.75);
    EXPECT_LT(summary.P.min, 0.1);
    EXPECT_GT(summary.P.max, 0.7);
    // Each of the four conditions must occur: smooth and rough, lightly and firmly.
    for (const bool rough : {false, true}) {
        for (const bool firm : {false, true}) {
            std::size_t frames = 0;
            for (const auto& frame : found.frames)
                frames +=
                    frame.sliding && (rough ? frame.R > 0.6 : frame.R < 0.4) && (firm ? frame.P > 0.5 : frame.P < 0.2)
                        ? 1
                        : 0;
            EXPECT_GT(frames, 20U) << (rough ? "rough" : "smooth") << (firm ? ", firmly" : ", lightly");
        }
    }
}
