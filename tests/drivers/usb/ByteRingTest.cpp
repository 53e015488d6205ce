#include <deque>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

#include "drivers/usb/ByteRing.h"

namespace tacto::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(ByteRing, KeepsTheNewestAndCountsWhatItDropped) {
    ByteRing ring(4);
    ring.push(Bytes{1, 2, 3});
    ring.push(Bytes{4, 5, 6});
    EXPECT_EQ(ring.dropped(), 2u);
    Bytes out(8);
    ASSERT_EQ(ring.pop(out), 4u);
    EXPECT_EQ((Bytes{out.begin(), out.begin() + 4}), (Bytes{3, 4, 5, 6}));
    EXPECT_TRUE(ring.empty());
}

TEST(ByteRing, KeepsTheEndOfAPieceThatIsLargerThanIt) {
    ByteRing ring(3);
    ring.push(Bytes{9});
    ring.push(Bytes{1, 2, 3, 4, 5});
    EXPECT_EQ(ring.dropped(), 3u);
    Bytes out(3);
    ASSERT_EQ(ring.pop(out), 3u);
    EXPECT_EQ(out, (Bytes{3, 4, 5}));
}

TEST(ByteRing, GivesTheBytesOfANaiveQueueWhateverTheSizes) {
    constexpr unsigned kSeed = 7;
    std::mt19937 random(kSeed);
    ByteRing ring(97);
    std::deque<std::uint8_t> naive;
    std::uint64_t naiveDropped = 0;
    for (int round = 0; round < 20000; ++round) {
        Bytes in(random() % 150);
        std::iota(in.begin(), in.end(), static_cast<std::uint8_t>(round));
        ring.push(in);
        naive.insert(naive.end(), in.begin(), in.end());
        while (naive.size() > 97) {
            naive.pop_front();
            ++naiveDropped;
        }
        Bytes out(random() % 120);
        out.resize(ring.pop(out));
        ASSERT_LE(out.size(), naive.size());
        ASSERT_TRUE(std::equal(out.begin(), out.end(), naive.begin())) << "round " << round << ", seed " << kSeed;
        naive.erase(naive.begin(), naive.begin() + std::ssize(out));
        ASSERT_EQ(ring.size(), naive.size());
        ASSERT_EQ(ring.dropped(), naiveDropped);
    }
}

}  // namespace
}  // namespace tacto::test
