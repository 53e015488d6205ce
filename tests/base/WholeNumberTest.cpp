// Whole numbers: all of a text, or nothing.
#include <cstdint>
#include <gtest/gtest.h>

#include "core/base/WholeNumber.h"

namespace tacto::test {
namespace {

TEST(WholeNumber, IsTheWholeText) {
    EXPECT_EQ(parseWhole<int>("42"), 42);
    EXPECT_EQ(parseWhole<int>("-42"), -42);
    EXPECT_EQ(parseWhole<std::uint8_t>("fF", 16), 255);
    for (const auto* text : {"", " 1", "1 ", "+1", "1.0", "0x1", "1e3"}) EXPECT_FALSE(parseWhole<int>(text)) << text;
}

TEST(WholeNumber, IsNothingWhereTheTypeCannotHoldIt) {
    EXPECT_FALSE(parseWhole<std::uint8_t>("256"));
    EXPECT_FALSE(parseWhole<std::uint16_t>("-1"));
    EXPECT_FALSE(parseWhole<std::uint64_t>("18446744073709551616"));
}

}  // namespace
}  // namespace tacto::test
