// Numbers as people type them, against how they were made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <locale>
#include <sstream>

#include "core/base/Random.h"
#include "core/base/TypedNumber.h"

namespace tacto {
namespace {

using testing::HasSubstr;

TEST(TypedNumber, ReadsADecimalCommaWhereItCanMeanNothingElse) {
    for (const auto& [text, value] : {std::pair("4,5", 4.5),
                                      {"4,0", 4.0},
                                      {"0,250", 0.25},
                                      {"-0,125", -0.125},
                                      {"+2,75", 2.75},
                                      {",5", 0.5},
                                      {"1234,567", 1234.567},
                                      {"1,0000", 1.0},
                                      {"12,5e-3", 0.0125},
                                      {" 3,14 ", 3.14},
                                      {"4.5", 4.5},
                                      {"1e3", 1000}}) {
        EXPECT_EQ(typedNumber(text), value) << text;
        EXPECT_EQ(typedTrouble(text), "") << text;
    }
    EXPECT_EQ(typedNumber("1,5 kohm", "ohm"), 1500);
    EXPECT_EQ(typedNumber("0,5mA", "mA"), 0.5);
}

TEST(TypedNumber, RefusesWhatMayBeTwoNumbersAndSaysWhy) {
    for (const char* text : {"1,000", "-12,500", "999,999", "1,000e3", "1,000 V"}) {
        EXPECT_FALSE(typedNumber(text, "V")) << text;
        EXPECT_THAT(typedTrouble(text), HasSubstr("write one of these")) << text;
    }
    EXPECT_THAT(typedTrouble("-1,250"), HasSubstr("may be -1.250 or -1250"));
    for (const char* text : {"1,000,000", "1.234,5", "1,234.5", "1,2,3", "4,5.6"}) {
        EXPECT_FALSE(typedNumber(text)) << text;
        EXPECT_THAT(typedTrouble(text), HasSubstr("without commas")) << text;
    }
    for (const char* text : {"", "5,", ",", "a,b", "4,5x", "1 ,5"}) EXPECT_FALSE(typedNumber(text)) << text;
}

/// Reads a number with a point, whatever the locale of the test.
double inPlainC(const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    double value = 0;
    in >> value;
    return value;
}

/// Numbers are made of their digits, so that what they mean is known without reading them.
TEST(TypedNumber, MeansTheSameWithACommaAsWithAPointOrNothing) {
    Random random(48, "typed numbers");
    for (int i = 0; i < 20'000; ++i) {
        const auto digits = [&](int count) {
            std::string all;
            for (int k = 0; k < count; ++k) all += static_cast<char>('0' + random.below(10));
            return all;
        };
        const auto whole = digits(1 + static_cast<int>(random.below(6))),
                   part = digits(1 + static_cast<int>(random.below(6)));
        const std::string sign = random.below(3) == 0 ? "-" : "";
        const bool ambiguous = whole.size() <= 3 && part.size() == 3 && whole.front() != '0';
        const auto read = typedNumber(sign + whole + ',' + part);
        ASSERT_EQ(read.has_value(), !ambiguous) << whole << ',' << part;
        if (read) {
            EXPECT_EQ(*read, inPlainC(sign + whole + '.' + part));
        }
        EXPECT_EQ(typedTrouble(sign + whole + ',' + part).empty(), !ambiguous);
    }
}

}  // namespace
}  // namespace tacto
