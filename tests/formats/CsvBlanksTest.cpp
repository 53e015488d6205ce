// Columns separated by blanks, as numpy.savetxt, Octave and gnuplot write them.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/formats/csv/CsvFormat.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

TEST(CsvBlanks, HoldWhatTheSameTableWithCommasHolds) {
    std::mt19937 random(20261129);
    const auto among = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    for (int k = 0; k < 300; ++k) {
        const auto channels = 1 + among(4);
        const bool decimalComma = among(3) == 0;
        const auto number = [&](double value) {
            return among(2) == 0 ? fmt::format("{:.6e}", value) : fmt::format("{:g}", value);
        };
        const auto blanks = [&](bool mayBeNone) {
            std::string text;
            for (auto n = (mayBeNone ? 0 : 1) + among(5); n > 0; --n) text += among(4) == 0 ? '\t' : ' ';
            return text;
        };
        std::string text = among(2) == 0 ? "# written by a program\n% by hand\n\n" : "";
        std::string names = "time", commas = "time_s";
        for (std::size_t c = 1; c <= channels; ++c) {
            names += blanks(false) + fmt::format("x{}", c);
            commas += fmt::format(",x{}", c);
        }
        const std::string marks[] = {"# ", "% ", "#", "", "  "};
        text += marks[among(std::size(marks))] + names + "\n";
        commas += "\n";
        const auto rows = 3 + among(60);
        const double step = std::pow(10.0, -static_cast<double>(among(6)));
        for (std::size_t i = 0; i < rows; ++i) {
            std::string row = blanks(true), plain;
            for (std::size_t c = 0; c <= channels; ++c) {
                const auto written = c == 0 ? fmt::format("{:.10g}", static_cast<double>(i) * step)
                                            : number(static_cast<double>(random()) / 1e8 - 20);
                row += (c == 0 ? "" : blanks(false)) + written;
                plain += (c == 0 ? "" : ",") + written;
            }
            if (decimalComma) std::ranges::replace(row, '.', ',');
            text += row + blanks(true) + (among(2) == 0 ? "\r\n" : "\n");
            commas += plain + "\n";
            if (among(10) == 0) text += "\n";
        }
        const auto read = parseCapture(text, "t.txt");
        const auto same = accepted(parseCapture(commas, "t.csv"));
        ASSERT_TRUE(read) << read.error().message << "\n" << text;
        EXPECT_DOUBLE_EQ(read->capture.rate_hz, same.capture.rate_hz);
        ASSERT_EQ(read->capture.channels.size(), channels) << text;
        for (std::size_t c = 0; c < channels; ++c) {
            EXPECT_EQ(read->capture.channels[c].name, fmt::format("x{}", c + 1));
            EXPECT_EQ(read->capture.channels[c].samples, same.capture.channels[c].samples) << text;
        }
    }
}

TEST(CsvBlanks, NamesMayHaveBlanksAndUnits) {
    for (const auto* names :
         {"Time (s)  Channel A (mV)  I (A)", "Time (s) CHA (mV) I (A)", "t [s]\tChannel A [mV]\tI [A]"}) {
        const auto read = accepted(parseCapture(std::string(names) + "\n 0 1000 1\n 1 2000 2\n 2 3000 3\n", "t.txt"));
        ASSERT_EQ(read.capture.channels.size(), 2U);
        EXPECT_EQ(read.capture.channels[0].unit, "V") << names;
        EXPECT_EQ(read.capture.channels[1].unit, "A") << names;
        EXPECT_EQ(read.capture.channels[0].samples[2], 3);
    }
}

TEST(CsvBlanks, WithoutNamesAnOptionGivesTheTime) {
    const std::string text = "# Created by Octave\n# type: matrix\n 0 0\n 0.5 1\n 1 0.25\n";
    const auto read = accepted(parseCapture(text, "t.txt", {.timeColumn = "1"}));
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 2);
    EXPECT_FALSE(parseCapture(text, "t.txt"));
    EXPECT_THAT(parseCapture(text + " 1.5 0 3\n", "t.txt", {.timeColumn = "1"}),
                test::refusedSaying("t.txt:6: 3 fields; 2 were expected"));
}

}  // namespace
}  // namespace tacto::test
