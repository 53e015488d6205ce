#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "core/base/Printable.h"

namespace tacto {
namespace {

TEST(Printable, LeavesTextAsItIs) {
    for (const char* text : {"", "1 kohm", "µ Ω ± 20 % – „ü“", "日本", "a\\x1b"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, SpellsOutWhatATerminalActsOn) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(printable("a\x1b[2Jb"), "a\\x1b[2Jb");
    EXPECT_EQ(printable("a\rb\tc\x7f\a"), "a\\x0db\\x09c\\x7f\\x07");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("a\u009b2Jb\u0085"), "a\\x9b2Jb\\x85") << "a C1 control in UTF-8";
    EXPECT_EQ(printable("a\x9b"
                        "2J"),
              "a\\x9b2J")
        << "and as a byte of its own";
}

TEST(Printable, SpellsOutWhatTurnsOrHidesText) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(printable("pass\u202efail\u2066\u200b\ufeff"), "pass\\u202efail\\u2066\\u200b\\ufeff");
}

TEST(Printable, KeepsNewlinesOnlyWhereAsked) {
    EXPECT_EQ(printable("a\nb"), "a\\x0ab");
    EXPECT_EQ(printable("a\nb\r\n", Newlines::Keep), "a\nb\\x0d\n");
}

TEST(Printable, TakesOnlyTheShortestFormForACharacter) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "an overlong escape is none";
    EXPECT_EQ(printable("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a pair";
    EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
    EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80") << "cut short";
}

TEST(WithoutNumbers, TheSameSentenceWithOtherNumbersIsTheSame) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(withoutNumbers("6.5 mA is above 6 mA, row 3."), "… mA is above … mA, row ….");
    EXPECT_EQ(withoutNumbers("no number at all"), "no number at all");
    std::mt19937 random(471);
    std::set<std::string> all;
    for (int i = 0; i < 1000; ++i) {
        const double level = std::ldexp(double(random() % 100'000 + 1) / 7, int(random() % 60) - 30);
        all.insert(withoutNumbers(fmt::format("pulse {} of {}: {:g} A, {:.3f} V and {:E} C", random() % 9,
                                              random() % 1000, level, level, level)));
    }
    EXPECT_EQ(all.size(), 1U) << *all.begin() << " and " << *all.rbegin();
}

}  // namespace
}  // namespace tacto
