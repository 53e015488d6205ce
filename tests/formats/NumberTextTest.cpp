// takeNumber() against the C library: whatever it gives is the double that strtod gives.
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/Random.h"
#include "core/formats/FieldNumber.h"

namespace tacto::test {
namespace {

struct Taken {
    bool taken;
    double value;
    std::size_t length;
};
Taken take(std::string text, char point = '.') {
    const auto length = text.size();
    text.append(kNumberPadding, '\0');
    Taken result{false, 0, 0};
    if (const char* behind = takeNumber(text.data(), point, result.value)) {
        result.taken = true;
        result.length = static_cast<std::size_t>(behind - text.data());
    }
    EXPECT_LE(result.length, length);
    return result;
}

/// Both ways, which must agree, with `around` before and behind the field.
bool isField(const std::string& text, double& value, char around, char point = '.') {
    const std::string margin(kNumberPadding, around);
    const auto whole = margin + text + margin;
    const char* const begin = whole.data() + kNumberPadding;
    double other = 0;
    const bool plain = plainFieldNumber(begin, begin + text.size(), point, other);
    const bool taken = fieldNumber(begin, begin + text.size(), point, value);
    EXPECT_EQ(plain, taken) << text;
    if (plain && taken) {
        EXPECT_EQ(other, value) << text;
    }
    return taken;
}

TEST(NumberText, TakesWhatOscilloscopesWrite) {
    const std::pair<const char*, double> written[] = {{"0", 0},
                                                      {"-0.0025", -0.0025},
                                                      {"+1.20E-01", 0.12},
                                                      {"4.40000e+00", 4.4},
                                                      {"5.", 5},
                                                      {".5", 0.5},
                                                      {"-5.9999998e-06", -5.9999998e-06},
                                                      {"12345678", 12345678},
                                                      {"123456789.125", 123456789.125},
                                                      {"0.000000000001", 1e-12},
                                                      {"-00.000250000000", -0.00025},
                                                      {"9007199254740992", 9007199254740992.0}};
    for (const auto& [text, value] : written) {
        const auto taken = take(text);
        ASSERT_TRUE(taken.taken) << text;
        EXPECT_EQ(taken.value, value) << text;
        EXPECT_EQ(taken.length, std::string_view(text).size()) << text;
    }
    EXPECT_EQ(take("1.5,2").length, 3U);
    EXPECT_EQ(take("1,5;2", ',').value, 1.5);
    EXPECT_TRUE(std::signbit(take("-0").value));
}

TEST(NumberText, LeavesToAnotherWhatItCannotDoExactly) {
    for (const auto* text : {"", "-", "+", ".", "e5", "1e", "1e+", "nan", "inf", "abc", "9007199254740993", "1e23",
                             "1e-23", "123456789012345678901234567890", "0.12345678901234567"}) {
        EXPECT_FALSE(take(text).taken) << text;
    }
}

TEST(NumberText, GivesTheNearestDoubleOrNone) {
    Random random(20261121, "numbers");
    std::size_t taken = 0;
    std::size_t fields = 0;
    for (int k = 0; k < 200'000; ++k) {
        std::string text = random.below(2) == 0 ? "-" : "";
        for (auto digits = random.below(11); digits > 0; --digits) text += static_cast<char>('0' + random.below(10));
        if (random.below(4) != 0) {
            text += '.';
            for (auto digits = random.below(14); digits > 0; --digits)
                text += static_cast<char>('0' + random.below(10));
        }
        if (random.below(2) == 0) text += fmt::format("e{}", static_cast<int>(random.below(40)) - 20);
        const auto ours = take(text);
        double field = 0;
        if (isField(text, field, k % 2 == 0 ? '.' : '7')) {
            ++fields;
            ASSERT_EQ(field, std::strtod(text.c_str(), nullptr)) << text;
        }
        if (!ours.taken) continue;
        ++taken;
        char* end = nullptr;
        const double truth = std::strtod(text.c_str(), &end);
        ASSERT_EQ(ours.value, truth) << text;
        ASSERT_EQ(ours.length, static_cast<std::size_t>(end - text.c_str())) << text;
    }
    EXPECT_GT(taken, 80'000U);
    EXPECT_GT(fields, 40'000U);
}

TEST(NumberText, AFieldIsANumberFromItsBeginToItsEnd) {
    for (const std::string text : {"", "-", "+", ".", "-.", "1.2.3", "1 ", " 1", "1e5", "nan", "12a", "1..", "--1",
                                   "12345678901234567", "99999999999999.99", "1,5", "123456789.1x", "+1"}) {
        double value = 0;
        EXPECT_FALSE(isField(text, value, '1')) << text;
    }
    double value = 0;
    ASSERT_TRUE(isField("12345,678", value, ',', ','));
    EXPECT_EQ(value, 12345.678);
}

}  // namespace
}  // namespace tacto::test
