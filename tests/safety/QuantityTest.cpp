#include <gtest/gtest.h>

#include "core/safety/FixedText.h"
#include "core/safety/Quantity.h"

namespace tacto {

TEST(Quantity, KeysAreReadBack) {
    for (std::size_t k = 0; k < kQuantityCount; ++k) {
        const auto q = static_cast<Quantity>(k);
        EXPECT_EQ(quantityOf(keyOf(q)), q);
        EXPECT_FALSE(titleOf(q).empty());
        EXPECT_FALSE(unitOf(q).empty());
    }
    EXPECT_EQ(quantityOf("rms"), std::nullopt);
}

TEST(Quantity, MilliampsRmsAreOverFiveSeconds) {
    EXPECT_EQ(windowOf(Quantity::RmsCurrent5s), 5);
    EXPECT_EQ(windowOf(Quantity::PowerDensity), 1);
    EXPECT_TRUE(needsArea(Quantity::CurrentDensity));
    EXPECT_FALSE(needsArea(Quantity::RmsCurrent5s));
}

TEST(FixedText, CutsAtAWholeCharacter) {
    EXPECT_EQ(FixedText<4>("abcdef").view(), "abcd");
    EXPECT_EQ(FixedText<4>("abcµ").view(), "abc");  // µ is two bytes
    EXPECT_EQ(FixedText<5>("abcµ").view(), "abcµ");
    EXPECT_TRUE(FixedText<4>(static_cast<const char*>(nullptr)).empty());
    EXPECT_EQ(std::string(FixedText<4>("abcdef").c_str()), "abcd");
}

}  // namespace tacto
