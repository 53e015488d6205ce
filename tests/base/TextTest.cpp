#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "core/base/LocaleFreeText.h"

namespace tacto {
namespace {

TEST(ParseNumber, ReadsAWholeNumberAndNothingElse) {
    EXPECT_EQ(parseNumber("1e-3"), 1e-3);
    EXPECT_EQ(parseNumber("  -4\t"), -4.0);
    EXPECT_EQ(parseNumber("+2.5"), 2.5);
    for (const char* bad : {"", "  ", "1,5", "1 2", "4x", "0x10", "--4", "+-4", "e3", ".", "1e999", "1e-400"}) {
        EXPECT_FALSE(parseNumber(bad)) << '"' << bad << '"';
    }
}

TEST(ParseNumber, PassesNanAndInfinityOnToTheCaller) {
    EXPECT_TRUE(std::isnan(parseNumber("nan").value_or(0)));
    EXPECT_EQ(parseNumber("-inf"), -std::numeric_limits<double>::infinity());
}

TEST(TakeNumber, LeavesWhatFollows) {
    std::string_view text = "2.5 kHz";
    EXPECT_EQ(takeNumber(text), 2.5);
    EXPECT_EQ(text, " kHz");
    EXPECT_FALSE(takeNumber(text));
    EXPECT_EQ(text, " kHz");
}

TEST(ParseQuantity, ReadsEngineeringPrefixes) {
    EXPECT_EQ(parseQuantity("1.5 kohm", "ohm"), 1500.0);
    EXPECT_EQ(parseQuantity("500ohm", "ohm"), 500.0);
    EXPECT_EQ(parseQuantity("50 nF", "F"), 50e-9);
    EXPECT_EQ(parseQuantity("200 µs", "s"), 200e-6);
    EXPECT_EQ(parseQuantity("200 μs", "s"), 200e-6);
    EXPECT_EQ(parseQuantity("3M", "ohm"), 3e6);
    EXPECT_EQ(parseQuantity("500", "ohm"), 500.0);
}

TEST(ParseQuantity, RefusesSomethingElse) {
    for (const char* bad : {"", "ohm", "kohm", "five ohm", "5 xohm", "1,5 kohm", "5 kk", "5 ohm ohm"}) {
        EXPECT_FALSE(parseQuantity(bad, "ohm")) << '"' << bad << '"';
    }
}

TEST(Split, KeepsEmptyParts) {
    const auto parts = split("a,,b,", ',');
    ASSERT_EQ(parts.size(), 4U);
    EXPECT_EQ(parts[0], "a");
    EXPECT_EQ(parts[1], "");
    EXPECT_EQ(parts[2], "b");
    EXPECT_EQ(parts[3], "");
    EXPECT_EQ(split("", ',').size(), 1U);
}

TEST(Trimmed, RemovesBlanksAtBothEnds) {
    EXPECT_EQ(trimmed(" \t a b \r\n"), "a b");
    EXPECT_EQ(trimmed(" \n"), "");
}

}  // namespace
}  // namespace tacto

namespace tacto::test {
namespace {

TEST(Ascii, FoldsTheLettersAToZAndNoOtherByte) {
    const std::string small = "abcdefghijklmnopqrstuvwxyz", large = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    for (int code = 0; code < 256; ++code) {
        const char byte = static_cast<char>(code);
        const auto isSmall = small.find(byte), isLarge = large.find(byte);
        EXPECT_EQ(lowered(byte), isLarge == std::string::npos ? byte : small[isLarge]) << code;
        EXPECT_EQ(capital(byte), isSmall == std::string::npos ? byte : large[isSmall]) << code;
    }
    EXPECT_EQ(lowered("TIME, CH1 (V) ÄÖÜ İI"), "time, ch1 (v) ÄÖÜ İi");
    EXPECT_EQ(capitals("dışçi, 2.000v/div"), "DışçI, 2.000V/DIV");
}

TEST(Ascii, TwoTextsAreTheSameButForCapitals) {
    EXPECT_TRUE(sameLetters("Isense", "ISENSE"));
    EXPECT_TRUE(sameLetters("RIGOL DS1054Z", "Rigol ds1054z"));
    EXPECT_TRUE(sameLetters("", ""));
    EXPECT_FALSE(sameLetters("Isense", "Isens"));
    EXPECT_FALSE(sameLetters("ı", "i"));
    EXPECT_FALSE(sameLetters("[", "{")) << "what stands 32 beside another is not its capital";
}

}  // namespace
}  // namespace tacto::test

// Whole numbers: the whole text is read, or nothing.
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
