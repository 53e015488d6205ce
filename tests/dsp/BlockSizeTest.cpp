// Any block size gives the same numbers, bit for bit, as the whole file, even with gaps, NaN, repeats and silences.
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

#include "core/base/Random.h"
#include "core/dsp/RoughnessChain.h"
#include "tests/dsp/RoughnessOracle.h"

using namespace tacto;
using namespace tacto::test;

namespace {

/// Drops the samples from `begin` to before `end`, in seconds.
void silence(SampleBlock& block, std::size_t channels, double begin, double end) {
    SampleBlock kept;
    for (std::size_t i = 0; i < block.samples(); ++i) {
        if (block.t_s[i] >= begin && block.t_s[i] < end) continue;
        kept.t_s.push_back(block.t_s[i]);
        for (std::size_t c = 0; c < channels; ++c) kept.values.push_back(block.values[i * channels + c]);
    }
    block = kept;
}

/// Returns a slide with all faults that occur on a bench.
Slide damaged(std::size_t axes) {
    auto slide = makeSlide(2000, axes, 200, 100, 6);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (axes > 0) {
        silence(slide.blocks[0], axes, 2.0, 2.03);
        slide.blocks[0].values[axes * 5200] = nan;
        slide.blocks[0].t_s[7000] = slide.blocks[0].t_s[6999];
        slide.blocks[0].t_s[8000] -= 1;
    }
    auto& force = slide.blocks[slide.blocks.size() - 2];
    auto& taxels = slide.blocks.back();
    force.values[410] = nan;
    silence(force, 1, 2.5, 2.75);  // longer than a sample stays fresh, shorter than the longest bridge
    silence(force, 1, 3.2, 4.35);  // longer than the longest bridge
    silence(taxels, 6, 2.6, 2.8);
    silence(taxels, 6, 3.7, 4.2);
    taxels.values[6 * 150 + 2] = nan;
    taxels.t_s[170] = taxels.t_s[169];
    return slide;
}

/// Feeds the whole slide; `step` returns the length of the next block in seconds.
template <class Step>
std::vector<RoughnessFrame> fedInBlocks(const Slide& slide, Step step, double skew_s = 0) {
    auto chain = RoughnessChain::create(slide.streams, {});
    std::vector<RoughnessFrame> frames;
    std::vector<std::size_t> taken(slide.streams.size());
    double last = 0;
    for (double until = 0; last < 7.5; until += step()) {
        last = until - skew_s * 2;
        std::vector<SampleBlock> blocks(slide.streams.size());
        for (std::size_t s = 0; s < slide.streams.size(); ++s) {
            const auto& whole = slide.blocks[s];
            const double limit = until - skew_s * static_cast<double>(s);
            for (; taken[s] < whole.samples() && whole.t_s[taken[s]] < limit; ++taken[s]) {
                blocks[s].t_s.push_back(whole.t_s[taken[s]]);
                const auto* row = whole.values.data() + taken[s] * slide.streams[s].channels;
                blocks[s].values.insert(blocks[s].values.end(), row, row + slide.streams[s].channels);
            }
        }
        (*chain)->feed(blocks, frames);
    }
    (*chain)->finish(frames);
    return frames;
}

std::vector<RoughnessFrame> fedWhole(const Slide& slide) {
    auto chain = RoughnessChain::create(slide.streams, {});
    std::vector<RoughnessFrame> frames;
    (*chain)->feed(slide.blocks, frames);
    (*chain)->finish(frames);
    return frames;
}

void expectBitEqual(const std::vector<RoughnessFrame>& a, const std::vector<RoughnessFrame>& b, const char* what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    const auto same = [](double x, double y) {
        return (std::isnan(x) && std::isnan(y)) || std::memcmp(&x, &y, 8) == 0;
    };
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_TRUE(same(a[i].t_s, b[i].t_s) && a[i].contact == b[i].contact && a[i].sliding == b[i].sliding &&
                    same(a[i].h, b[i].h) && same(a[i].v, b[i].v) && same(a[i].R, b[i].R) &&
                    same(a[i].pressure_pa, b[i].pressure_pa) && same(a[i].P, b[i].P))
            << what << ": frame " << i << " at " << a[i].t_s << " s";
    }
}

void expectAnyBlockSize(const Slide& slide) {
    const auto whole = fedWhole(slide);
    ASSERT_GT(whole.size(), 100U);
    const double rate = slide.streams[0].rate_hz;
    for (const double samples : {1.0, 7.0, 64.0, 1000.0}) {
        expectBitEqual(fedInBlocks(slide, [&] { return samples / rate; }), whole, "fixed blocks");
    }
    expectBitEqual(fedInBlocks(
                       slide, [] { return 0.005; }, 0.09),
                   whole, "streams 90 ms behind each other");
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed, "blocks");
        expectBitEqual(fedInBlocks(slide, [&] { return std::pow(10, -3.3 + 3 * random.uniform()); }), whole, "random");
    }
}

}  // namespace

TEST(BlockSize, DoesNotMatterOnACleanSlide) { expectAnyBlockSize(makeSlide(4000, 3, 200, 200, 8)); }
TEST(BlockSize, DoesNotMatterOnADamagedSlide) {
    RecordProperty("hazard", "H7");
    expectAnyBlockSize(damaged(3));
    expectAnyBlockSize(damaged(1));
}
TEST(BlockSize, DoesNotMatterWithoutAcceleration) {
    expectAnyBlockSize(makeSlide(0, 0, 0, 200, 8));
    expectAnyBlockSize(makeSlide(0, 0, 0, 35.6, 8));
    expectAnyBlockSize(damaged(0));
}
TEST(BlockSize, DoesNotMatterWithoutForce) { expectAnyBlockSize(makeSlide(1000, 2, 0, 50, 4)); }

TEST(BlockSize, DoesNotMatterWhereTheSensorsClockRunsWrong) {
    for (const double rate : {0.98, 1.02}) {
        auto slide = makeSlide(4000, 3, 200, 200, 8);
        for (double& t_s : slide.blocks[0].t_s) t_s *= rate;
        expectAnyBlockSize(slide);
    }
}

TEST(BlockSize, AResetChainIsANewOne) {
    const auto slide = damaged(3);
    auto chain = RoughnessChain::create(slide.streams, {});
    std::vector<RoughnessFrame> first;
    (*chain)->feed(slide.blocks, first);
    (*chain)->finish(first);
    (*chain)->reset();
    std::vector<RoughnessFrame> second;
    (*chain)->feed(slide.blocks, second);
    (*chain)->finish(second);
    expectBitEqual(second, first, "after reset()");
}

TEST(BlockSize, FramesComeOutPromptly) {
    const auto slide = makeSlide(4000, 3, 200, 200, 8);
    auto chain = RoughnessChain::create(slide.streams, {});
    std::vector<RoughnessFrame> frames;
    std::vector<std::size_t> taken(3);
    double worst = 0;
    for (double now = 0; now < 6; now += 0.001) {
        std::vector<SampleBlock> blocks(3);
        for (std::size_t s = 0; s < 3; ++s) {
            for (; taken[s] < slide.blocks[s].samples() && slide.blocks[s].t_s[taken[s]] <= now; ++taken[s]) {
                blocks[s].t_s.push_back(slide.blocks[s].t_s[taken[s]]);
                const auto* row = slide.blocks[s].values.data() + taken[s] * slide.streams[s].channels;
                blocks[s].values.insert(blocks[s].values.end(), row, row + slide.streams[s].channels);
            }
        }
        const auto before = frames.size();
        (*chain)->feed(blocks, frames);
        for (auto i = before; i < frames.size() && now > 0.3; ++i) worst = std::max(worst, now - frames[i].t_s);
    }
    EXPECT_GT(frames.size(), 360U);
    EXPECT_LE(worst, 0.032 + 0.005 + 0.002) << "half a window, the next force sample, this loop's step";
}

TEST(BlockSize, AForceSampleOfTheLastStampEndsTheWaitHoweverBothWereRounded) {
    RecordProperty("hazard", "H7");
    // Windows of 64 ms end 63.75 ms after their first sample, so that force at 3.75 ms + k * 5 ms meets every fifth.
    auto slide = makeSlide(4000, 3, 200, 200, 8);
    Random random(5, "stamps");
    for (int time = 0; time < 200; ++time) {
        const auto begin_us = static_cast<std::uint64_t>(1e9 * random.uniform());
        const auto stampsFrom = [&](std::size_t s, double first_us, double step_us) {
            SampleBlock block;
            for (int i = 0; first_us + i * step_us <= 143'750; ++i)
                block.t_s.push_back((static_cast<double>(begin_us) + first_us + i * step_us) * 1e-6);
            const auto values = slide.blocks[s].values.begin();
            const auto count = static_cast<std::ptrdiff_t>(block.samples() * slide.streams[s].channels);
            block.values.assign(values, values + count);
            return block;
        };
        const std::vector<SampleBlock> blocks{stampsFrom(0, 0, 250), stampsFrom(1, 3750, 5000)};
        const auto chain = RoughnessChain::create(std::span(slide.streams).first(2), {}).value();
        std::vector<RoughnessFrame> frames;
        chain->feed(blocks, frames);
        ASSERT_EQ(frames.size(), 6U) << begin_us << " us";
    }
}
