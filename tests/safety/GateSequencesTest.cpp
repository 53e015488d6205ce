// H1: no sequence of commands delivers above a limit.
#include <cstdlib>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <set>

#include "tests/safety/GateSequences.h"
#include "tests/support/Trials.h"

namespace tacto::test {

namespace {
/// A million before a change is merged; fewer with sanitizers, which look for other faults than rare sequences.
/// TACTOSCOPE_H1_SEQUENCES overrides the number.
std::uint64_t wantedSequences() {
    if (const char* text = std::getenv("TACTOSCOPE_H1_SEQUENCES")) return std::strtoull(text, nullptr, 10);
#ifdef TACTOSCOPE_SANITIZED
    return 10'000;
#else
    return trials<std::uint64_t>({.local = 100'000, .ci = 1'000'000, .campaign = 10'000'000});
#endif
}
constexpr std::uint64_t kCases = 100;  // RapidCheck's default number of successes
}  // namespace

TEST(GateSequences, NeverDeliverAboveALimit) {
    RecordProperty("hazard", "H1");
    const std::uint64_t perCase = (wantedSequences() + kCases - 1) / kCases;
    SequenceCount total;
    std::set<std::uint64_t> seeds;
    const bool held = rc::check("no sequence of commands delivers above a limit", [&] {
        const auto seed = *rc::gen::noShrink(rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()));
        seeds.insert(seed);
        SequenceCount one;
        runSequences(seed, perCase, one);
        total.sequences += one.sequences;
        total.delivering += one.delivering;
        total.close += one.close;
        total.edges += one.edges;
        total.trains += one.trains;
        total.refused += one.refused;
        for (std::size_t k = 0; k < one.near.size(); ++k) total.near[k] += one.near[k];
        if (!one.violation.empty()) RC_FAIL(one.violation);
    });
    EXPECT_TRUE(held);
    const auto fraction = [&](std::uint64_t n) {
        return static_cast<double>(n) / static_cast<double>(total.sequences);
    };
    RecordProperty("sequences", std::to_string(total.sequences));
    RecordProperty("trains", std::to_string(total.trains));
    std::cout << total.sequences << " sequences, " << total.trains << " trains delivered, " << total.refused
              << " refused; " << 100 * fraction(total.delivering) << " % deliver, " << 100 * fraction(total.close)
              << " % come within 5 % of a limit, " << 100 * fraction(total.edges) << " % to the gate's edge; by kind:";
    for (const auto n : total.near) std::cout << ' ' << n;
    std::cout << '\n';
    if (!held) return;
    EXPECT_EQ(seeds.size(), kCases) << "a seed drawn twice repeats its sequences";
    EXPECT_GE(total.sequences, wantedSequences());
    EXPECT_GE(fraction(total.delivering), 0.30);
    EXPECT_GE(fraction(total.close), 0.10);
    EXPECT_GE(fraction(total.edges), 0.01);
    // Every kind of limit must have been approached; otherwise its check was not really tried.
    for (std::size_t k = 0; k < total.near.size(); ++k)
        EXPECT_GT(total.near[k], total.sequences / 5000) << "kind " << k;
}

}  // namespace tacto::test
