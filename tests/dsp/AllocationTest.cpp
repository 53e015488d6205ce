#include <gtest/gtest.h>

#include "core/acquisition/StreamHealth.h"
#include "core/dsp/RoughnessChain.h"
#include "tests/dsp/RoughnessOracle.h"
#include "tests/support/Allocations.h"

using namespace tacto;
using namespace tacto::test;

TEST(Allocation, FeedingBlocksMakesNone) {
    if (!countsAllocations()) GTEST_SKIP() << kNotCounted;
    const auto slide = makeSlide(4000, 3, 200, 200, 8);
    RoughnessSettings settings;
    settings.taxel = TaxelFeature::Dynamic;
    auto chain = RoughnessChain::create(slide.streams, settings);
    std::vector<std::vector<SampleBlock>> steps;
    std::vector<std::size_t> taken(3);
    for (double until = 0.005; until < 6; until += 0.005) {
        auto& step = steps.emplace_back(3);
        for (std::size_t s = 0; s < 3; ++s) {
            for (; taken[s] < slide.blocks[s].samples() && slide.blocks[s].t_s[taken[s]] < until; ++taken[s]) {
                step[s].t_s.push_back(slide.blocks[s].t_s[taken[s]]);
                const auto* row = slide.blocks[s].values.data() + taken[s] * slide.streams[s].channels;
                step[s].values.insert(step[s].values.end(), row, row + slide.streams[s].channels);
            }
        }
    }
    std::vector<StreamHealth> health(3, StreamHealth(200));
    std::vector<RoughnessFrame> frames;
    frames.reserve(1000);
    const auto before = allocationsOfThisThread();
    for (const auto& step : steps) {
        for (std::size_t s = 0; s < 3; ++s) health[s].feed(step[s], slide.streams[s].channels);
        (*chain)->feed(step, frames);
    }
    EXPECT_EQ(allocationsOfThisThread() - before, 0U);
    EXPECT_GT(frames.size(), 360U);
    ::operator delete(::operator new(8));  // checks that the counter counts
    EXPECT_GT(allocationsOfThisThread(), before);
}
