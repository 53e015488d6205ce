#include <clocale>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/CsvStamp.h"
#include "core/base/Random.h"

namespace tacto::test {
namespace {

struct Taken {
    bool taken;
    double value;
    std::size_t length;
};
Taken take(std::string_view text, char point = '.') {
    double value = 0;
    const char* const behind = takeNumber(text.data(), text.data() + text.size(), point, value);
    return {behind != nullptr, value, behind != nullptr ? static_cast<std::size_t>(behind - text.data()) : 0};
}

TEST(CsvNumber, TakesWhatOscilloscopesWrite) {
    const std::pair<const char*, double> written[] = {{"0", 0},
                                                      {"-0.0025", -0.0025},
                                                      {"+1.20E-01", 0.12},
                                                      {"4.40000e+00", 4.4},
                                                      {"5.", 5},
                                                      {".5", 0.5},
                                                      {"-5.9999998e-06", -5.9999998e-06},
                                                      {"123456789.125", 123456789.125},
                                                      {"0.000000000001", 1e-12},
                                                      {"-00.000250000000", -0.00025},
                                                      {"9007199254740993", 9007199254740992.0},
                                                      {"1e-23", 1e-23}};
    for (const auto& [text, value] : written) {
        const auto taken = take(text);
        ASSERT_TRUE(taken.taken) << text;
        EXPECT_EQ(taken.value, value) << text;
        EXPECT_EQ(taken.length, std::string_view(text).size()) << text;
    }
    EXPECT_EQ(take("1.5,2").length, 3U);
    EXPECT_EQ(take("1,5;2", ',').value, 1.5);
    EXPECT_TRUE(std::signbit(take("-0").value));
    EXPECT_TRUE(std::isnan(take("nan").value));
    EXPECT_TRUE(std::isinf(take("-inf").value));
}

TEST(CsvNumber, ANumberBeginsWithASignADigitOrThePoint) {
    for (const auto* text : {"", "-", "+", ".", "e5", "abc", "-.", "--1", "+-1", "++1", " 1"}) {
        EXPECT_FALSE(take(text).taken) << text;
    }
}

TEST(CsvNumber, GivesTheNearestDouble) {
    Random random(20261121, "numbers");
    const auto plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
    for (int k = 0; k < 200'000; ++k) {
        std::string text = random.below(2) == 0 ? "-" : "";
        for (auto digits = 1 + random.below(11); digits > 0; --digits)
            text += static_cast<char>('0' + random.below(10));
        if (random.below(4) != 0) {
            text += '.';
            for (auto digits = random.below(14); digits > 0; --digits)
                text += static_cast<char>('0' + random.below(10));
        }
        if (random.below(2) == 0) text += fmt::format("e{}", static_cast<int>(random.below(40)) - 20);
        const auto taken = take(text);
        ASSERT_TRUE(taken.taken) << text;
        ASSERT_EQ(taken.value, ::strtod_l(text.c_str(), nullptr, plain)) << text;
        ASSERT_EQ(taken.length, text.size()) << text;
    }
    ::freelocale(plain);
}

}  // namespace
}  // namespace tacto::test
