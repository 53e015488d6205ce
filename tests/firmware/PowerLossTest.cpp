// A board whose power goes at any instruction of a train (hazard H2), on a Cortex-M4F under QEMU: what came out before
// is the beginning of that train, the first thing after is that output is off, and nothing comes again.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <map>

#include "tests/firmware/ProfileOnQemu.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

constexpr std::uint32_t kLosses = 1100;
constexpr double kClock_MHz = 25;
constexpr double kLate_us = 10;  // from the timer's interrupt to the edge, and to the timer's next start

/// What board/PowerLoss.c keeps.
enum class Kept : std::uint32_t { Boot, Train, Edge, Fault };
struct Entry {
    Kept kind;
    std::uint32_t loss, ticks;
    float level;
};

std::vector<Entry> entriesOf(const std::string& bytes) {
    std::vector<Entry> entries(bytes.size() / sizeof(Entry));
    std::memcpy(entries.data(), bytes.data(), entries.size() * sizeof(Entry));
    return entries;
}

/// Returns how many edges of the train came out before the power went.
std::size_t expectBeginningOfATrain(const std::vector<Entry>& all, const te_profile& profile) {
    std::size_t edges = 0, trains = 0;
    float amplitude = 0;
    std::vector<Entry> train;
    EXPECT_TRUE(!all.empty() && all.front().kind == Kept::Edge && all.front().level == 0) << "output is off first";
    for (const auto& entry : all) {
        EXPECT_NE(entry.kind, Kept::Fault);
        if (entry.kind == Kept::Train) {
            EXPECT_EQ(++trains, 1U);
            amplitude = entry.level;
        } else if (entry.kind == Kept::Edge && trains == 0) {
            EXPECT_EQ(entry.level, 0) << "nothing comes out by itself after a start";
        } else if (entry.kind == Kept::Edge) {
            train.push_back(entry);
        }
    }
    EXPECT_LE(amplitude, profile.amplitude_max_v);
    const double widths[] = {profile.width_us, profile.gap_us, profile.width_us};
    for (const auto& edge : train) {
        const std::size_t step = edges % 4;
        const float expected = step == 0 ? amplitude : step == 2 ? -amplitude : 0;
        EXPECT_EQ(edge.level, profile.negative != 0 ? -expected : expected) << "edge " << edges;
        if (step > 0) {
            const double us = static_cast<double>(train[edges - 1].ticks - edge.ticks) / kClock_MHz;
            EXPECT_GE(us, widths[step - 1] - kLate_us) << "edge " << edges;
            EXPECT_LE(us, widths[step - 1] + kLate_us) << "edge " << edges;
        }
        ++edges;
    }
    EXPECT_LE(edges, 4U * profile.pulses);
    return edges;
}

}  // namespace

TEST(PowerLoss, LeavesTheBeginningOfATrainAndNothingAfterIt) {
    if (std::string_view(TACTO_POWER_BOARD).empty()) GTEST_SKIP() << "no compiler, C library and QEMU for a Cortex-M";
    RecordProperty("hazard", "H2");
    const ScratchDir scratch;
    const auto line = "cd '" + scratch.path().string() + "' && timeout 600 qemu-system-arm -M mps2-an386 -kernel '" +
                      TACTO_POWER_BOARD +
                      "' -nographic -monitor none -serial none -semihosting-config enable=on,target=native -icount "
                      "shift=6,sleep=off </dev/null";
    ASSERT_EQ(std::system(line.c_str()), 0);
    std::ifstream in(scratch.path() / "edges", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::map<std::uint32_t, std::vector<Entry>> byLoss;
    for (const auto& entry : entriesOf(bytes)) byLoss[entry.loss].push_back(entry);
    EXPECT_EQ(byLoss.size(), kLosses + 2);  // the first train, each loss, and the start after the last one
    const te_profile profile = profileOnQemu();
    std::map<std::size_t, int> cut;
    for (const auto& [loss, entries] : byLoss) {
        SCOPED_TRACE(testing::Message() << "loss " << loss);
        if (loss > 0) ++cut[expectBeginningOfATrain(entries, profile)];
        if (testing::Test::HasFailure()) break;
    }
    for (const auto& [edges, times] : cut) std::cout << times << " times after " << edges << " edges\n";
    EXPECT_GE(cut[0], 100);
    EXPECT_GE(cut[1], 100);
    EXPECT_EQ(cut.rbegin()->first, 4U * profile.pulses) << "a whole train, too";
    EXPECT_GE(cut.size(), 10U);
}

}  // namespace tacto::test
