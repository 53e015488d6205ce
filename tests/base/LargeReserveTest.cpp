#include <gtest/gtest.h>
#include <numeric>

#include "core/base/LargeReserve.h"

namespace tacto::test {

TEST(LargeReserve, IsRoomThatNothingElseIsSeenOf) {
    for (const std::size_t elements : {std::size_t{0}, std::size_t{3}, std::size_t{40'000}, std::size_t{3'000'001}}) {
        std::vector<int> numbers;
        reserveLarge(numbers, elements);
        EXPECT_GE(numbers.capacity(), elements);
        EXPECT_TRUE(numbers.empty());
        numbers.resize(elements);
        std::iota(numbers.begin(), numbers.end(), 0);
        askForHugePages(numbers.data(), numbers.size() * sizeof(int));
        for (std::size_t k = 0; k < elements; k += 1009) ASSERT_EQ(numbers[k], static_cast<int>(k));
    }
    askForHugePages(nullptr, 1'000'000);
}

}  // namespace tacto::test
