// A curve drawn with characters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "app/cli/TextPlot.h"

namespace tacto::test {
namespace {

using cli::TextPlot;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// 128 samples of 4 us: two phases of 200 us at `height`, 100 us apart.
std::vector<float> pulse(float height) {
    std::vector<float> values;
    for (int i = 0; i < 128; ++i) {
        const int t = 4 * i;
        values.push_back(t < 200 || (t >= 300 && t < 500) ? height : 0.0F);
    }
    return values;
}

TextPlot plotOf(const std::vector<float>& values) {
    TextPlot plot;
    plot.title = "voltage magnitude (V)";
    plot.xTitle = "time (us)";
    plot.step = 4;
    plot.values = values;
    return plot;
}

TEST(TextPlot, HasAxesWithUnitsAndRoundNumbers) {
    const auto values = pulse(5);
    const auto lines = linesOf(draw(plotOf(values)));
    ASSERT_EQ(lines.size(), 1U + 13 + 3);
    EXPECT_EQ(lines.front(), "voltage magnitude (V)");
    EXPECT_TRUE(lines[1].starts_with("  5 +**")) << lines[1];
    EXPECT_TRUE(lines[7].starts_with("2.5 +")) << lines[7];
    EXPECT_TRUE(lines[13].starts_with("  0 +")) << lines[13];
    EXPECT_TRUE(lines[14].starts_with("    +---")) << lines[14];
    for (const auto* tick : {"0", "100", "200", "300", "400", "500"}) EXPECT_THAT(lines[15], HasSubstr(tick));
    EXPECT_EQ(lines[16], "    time (us)");
}

TEST(TextPlot, TheCurveStandsWhereItsValuesAre) {
    const auto values = pulse(5);
    const auto lines = linesOf(draw(plotOf(values)));
    // 75 columns for 512 us: the leading phase takes the first 200 us, the second begins at 300 us.
    const auto columnOf = [](double us) { return 5 + static_cast<std::size_t>(us / 512 * 75); };
    const auto& top = lines[1];
    const auto& bottom = lines[13];
    for (const double us : {20.0, 100.0, 180.0, 320.0, 480.0}) {
        EXPECT_EQ(top.at(columnOf(us)), '*') << us;
        EXPECT_EQ(bottom.at(columnOf(us)), ' ') << us;
    }
    for (const double us : {220.0, 250.0, 280.0}) {
        EXPECT_EQ(top.at(columnOf(us)), ' ') << us;
        EXPECT_EQ(bottom.at(columnOf(us)), '*') << us;
    }
    // The edges are drawn as lines, without gaps.
    const auto edge = bottom.find('*');
    for (std::size_t row = 1; row <= 13; ++row) EXPECT_EQ(lines[row].at(edge), '*') << row;
    EXPECT_NEAR(static_cast<double>(edge), static_cast<double>(columnOf(200)), 1);
}

TEST(TextPlot, NoLineIsLongerThanTheTerminal) {
    const auto values = pulse(123.4F);
    for (int columns = 1; columns < 200; ++columns) {
        auto plot = plotOf(values);
        plot.title += std::string(100, 'x');
        plot.mark = 200;
        plot.markText = "|Z| 1.00 kohm";
        const auto widest = static_cast<std::size_t>(std::clamp(columns, 40, 80));
        for (const auto& line : linesOf(draw(plot, columns))) {
            EXPECT_LE(line.size(), widest) << columns << ": " << line;
            EXPECT_TRUE(line.empty() || line.back() != ' ') << "blanks at the end of a line";
        }
    }
}

TEST(TextPlot, AMarkPointsAtItsTimeFromEitherSide) {
    const auto values = pulse(5);
    auto plot = plotOf(values);
    plot.markText = "end of the leading phase";
    plot.mark = 200;
    auto line = linesOf(draw(plot))[15];
    EXPECT_NEAR(static_cast<double>(line.find('^')), 5 + 200.0 / 512 * 75, 1);
    EXPECT_THAT(line, HasSubstr("^ end of the leading phase"));
    plot.mark = 500;
    line = linesOf(draw(plot))[15];
    EXPECT_NEAR(static_cast<double>(line.find('^')), 5 + 500.0 / 512 * 75, 1);
    EXPECT_THAT(line, HasSubstr("end of the leading phase ^"));
    plot.mark = 5000;
    EXPECT_THAT(draw(plot), Not(HasSubstr("^"))) << "outside";
}

TEST(TextPlot, TheLastTickHasItsLabelToo) {
    const auto values = pulse(5);
    auto plot = plotOf(values);
    plot.step = 47;
    const auto line = linesOf(draw(plot))[15];
    for (const auto* tick : {"2000", "4000", "6000"}) EXPECT_THAT(line, HasSubstr(tick));
}

TEST(TextPlot, FewValuesAreStairs) {
    const std::vector<float> values{1, 0, 1};
    const auto lines = linesOf(draw(plotOf(values)));
    EXPECT_GE(std::count(lines[1].begin(), lines[1].end(), '*'), 48);
    EXPECT_GE(std::count(lines[13].begin(), lines[13].end(), '*'), 24);
}

TEST(TextPlot, WhatIsNoNumberLeavesItsPlaceBlank) {
    auto values = pulse(5);
    for (std::size_t i = 0; i < 25; ++i) values[i] = i % 2 == 0 ? std::nanf("") : -1.0F;
    const auto lines = linesOf(draw(plotOf(values)));
    const auto first = lines[1].find('*');
    EXPECT_NEAR(static_cast<double>(first), 5 + 100.0 / 512 * 75, 1);
    values.assign(128, std::numeric_limits<float>::infinity());
    EXPECT_THAT(draw(plotOf(values)), Not(HasSubstr("*")));
}

TEST(TextPlot, NothingAndZeroesAreDrawnToo) {
    const std::vector<float> zeroes(128, 0.0F);
    const auto flat = linesOf(draw(plotOf(zeroes)));
    EXPECT_EQ(std::count(flat[13].begin(), flat[13].end(), '*'), 75);
    EXPECT_TRUE(flat[1].starts_with("  1 +"));
    const auto empty = linesOf(draw(plotOf({})));
    EXPECT_EQ(empty.size(), 17U);
    EXPECT_THAT(empty, Each(Not(HasSubstr("*"))));
}

TEST(TextPlotText, LabelsQuotedFromElsewhereAreSpelledOut) {
    RecordProperty("hazard", "H10");
    const auto values = pulse(5);
    auto plot = plotOf(values);
    plot.title = "volt\x1b[2Jage\n";
    plot.xTitle = "time\r";
    plot.mark = 200;
    plot.markText = "|Z| \x9b";
    const auto text = cli::draw(plot);
    for (const char c : text) EXPECT_FALSE(c >= 0 && c < 0x20 && c != '\n') << static_cast<int>(c);
    EXPECT_THAT(text, HasSubstr("volt\\x1b[2Jage\\x0a"));
    EXPECT_THAT(text, HasSubstr("time\\x0d"));
    EXPECT_THAT(text, HasSubstr("|Z| \\x9b"));
}

}  // namespace
}  // namespace tacto::test
