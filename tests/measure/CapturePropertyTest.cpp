// Records of any instrument: each figure is right within its U, or is reported as not measured. CaptureProperty.h says
// what this means. There is one test per kind of record, so that a failure names kind and seed. This shows a draw and
// its result:
//   TACTO_DRAW=SEED build/release/bin/test_capture_properties --gtest_filter='*/KIND'
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/measure/CaptureProperty.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

struct Share {
    int inside = 0, given = 0;
};

class CaptureProperty : public ::testing::TestWithParam<CaptureKind> {};

void show(CaptureKind kind, std::uint64_t seed) {
    const auto draw = drawCapture(kind, seed);
    const auto m = measureChannel(draw.capture, 0, draw.options);
    fmt::print("{} {}: {}\n", nameOf(kind), seed, draw.text);
    for (const auto& pulse : draw.pulses) {
        fmt::print("  there   onset {:.9g} s, plateau {:.6g}, width {:.6g} s{}\n", pulse.leading.onset_s,
                   pulse.leading.plateau, pulse.leading.end_s - pulse.leading.onset_s,
                   pulse.presence == Presence::Whole ? "" : ", need not be measured");
    }
    for (const auto& pulse : m.pulses) {
        fmt::print("  {} onset {:.9g} s, plateau {:.6g}, width {:.6g} s, seen {:.6g} to {:.6g} s\n",
                   pulse.flags.measured() ? "measured" : "flagged ", pulse.onset_s(), pulse.leading.plateau,
                   pulse.leading.width_s, pulse.seenFrom_s, pulse.seenTo_s);
    }
    fmt::print("  states: {} baseline {:.6g}, low {:.6g}, high {:.6g}, noise {:.3g} {}\n",
               static_cast<int>(m.states.count), m.states.baseline, m.states.low, m.states.high, m.states.noise,
               m.states.why);
    for (const auto& warning : m.warnings) fmt::print("  said: {}\n", warning);
    for (const auto& sentence : judge(draw, m).wrong) fmt::print("  WRONG: {}\n", sentence);
}

TEST_P(CaptureProperty, EachFigureIsRightOrItIsSaidThatItWasNotMeasured) {
    RecordProperty("hazard", "H9");
    const auto kind = GetParam();
    if (const char* seed = std::getenv("TACTO_DRAW")) return show(kind, std::strtoull(seed, nullptr, 10));
    const int draws = trials<int>({.local = 600, .ci = 600, .campaign = 7200});
    int easy = 0, withPulses = 0, refused = 0, failed = 0, noisy = 0, failedInNoise = 0;
    std::array<Share, kFigures> shares;
    for (int seed = 1; seed <= draws; ++seed) {
        const auto draw = drawCapture(kind, static_cast<std::uint64_t>(seed));
        const auto judgement = judge(draw, measureChannel(draw.capture, 0, draw.options));
        easy += draw.easy ? 1 : 0;
        noisy += draw.noisy ? 1 : 0;
        withPulses += draw.pulses.empty() ? 0 : 1;
        refused += judgement.refused ? 1 : 0;
        for (std::size_t k = 0; k < kFigures; ++k) {
            if (!judgement.inside[k]) continue;
            ++shares[k].given;
            shares[k].inside += *judgement.inside[k] ? 1 : 0;
        }
        if (judgement.wrong.empty()) continue;
        ++(draw.noisy ? failedInNoise : failed);
        if (const char* every = std::getenv("TACTO_EVERY_DRAW")) {
            fmt::print("{} {}{} | {} | {} | {}\n", every, nameOf(kind), draw.noisy ? " (noisy)" : "", seed,
                       judgement.wrong.front(), draw.text);
        }
        if (draw.noisy || failed > 5) continue;
        ADD_FAILURE() << nameOf(kind) << ", seed " << seed << ": " << judgement.wrong.front()
                      << (judgement.wrong.size() > 1 ? fmt::format(" (and {} more)", judgement.wrong.size() - 1) : "")
                      << "\n  " << draw.text << "\n  said: " << (judgement.why.empty() ? "nothing" : judgement.why);
    }
    EXPECT_EQ(failed, 0) << "of " << draws;
    EXPECT_LE(refused, 0.2 * withPulses) << "what refuses everything is never wrong";
    EXPECT_LE(failedInNoise, 0.01 * noisy + 3 * std::sqrt(0.01 * noisy)) << "of " << noisy << " in much noise";
    std::string line = fmt::format(
        "{}: {} draws, {} with pulses, {} of them easy, {} refused in part or whole, {} of {} in much noise wrong",
        nameOf(kind), draws, withPulses, easy, refused, failedInNoise, noisy);
    for (std::size_t k = 0; k < kFigures; ++k) {
        const auto [inside, given] = shares[k];
        if (given == 0) continue;
        line += fmt::format(", {} {:.1f} % of {} in U", kFigureNames[k], 100.0 * inside / given, given);
        // 92 of 100, less three standard deviations for this number of draws.
        EXPECT_GE(inside, 0.92 * given - 3 * std::sqrt(0.92 * 0.08 * given)) << kFigureNames[k] << " of " << given;
    }
    fmt::print("{}\n", line);
}

TEST(NoisyRecord, APulseThatDrownedMakesNoIntervalOfTwice) {
    RecordProperty("hazard", "H9");
    const auto draw = drawCapture(CaptureKind::Unequal, 6771);  // the fourth pulse of seven is a quarter as high
    const auto m = measureChannel(draw.capture, 0, draw.options);
    ASSERT_EQ(draw.pulses.size(), 7U);
    ASSERT_EQ(m.measuredPulses, 6U);
    const double interval_s = draw.pulses[1].leading.onset_s - draw.pulses[0].leading.onset_s;
    EXPECT_NEAR(m.interval_s.max, interval_s, 0.01 * interval_s);
    EXPECT_THAT(m.warnings,
                ::testing::Contains(::testing::HasSubstr("1 interval not measured: longer than 1.5 times")));
}

INSTANTIATE_TEST_SUITE_P(Records, CaptureProperty, ::testing::ValuesIn(kCaptureKinds),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

}  // namespace
}  // namespace tacto::test
