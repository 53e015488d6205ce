// Tables of logic analysers, with one row for each change of a level.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "core/base/LocaleFreeText.h"
#include "core/formats/csv/CsvFormat.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using ::testing::HasSubstr;

/// Returns the times at which a straight line from sample to sample crosses the middle.
std::vector<double> crossings(const Capture& capture, std::size_t channel) {
    std::vector<double> times;
    const auto& samples = capture.channels[channel].samples;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const double a = samples[i - 1], b = samples[i];
        if ((a < 0.5) == (b < 0.5)) continue;
        times.push_back(capture.start_s + (static_cast<double>(i - 1) + (0.5 - a) / (b - a)) / capture.rate_hz);
    }
    return times;
}

TEST(CsvChanges, EveryEdgeIsAtItsOwnTime) {
    std::mt19937 random(20261129);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (int k = 0; k < 100; ++k) {
        const auto channels = 1 + random() % 4;
        const double unit = std::pow(10.0, -static_cast<double>(random() % 6));
        std::vector<std::vector<double>> edges(channels);
        std::set<double> stamps;
        const double start = random() % 2 == 0 ? 0 : -3 * unit;
        for (auto& of : edges) {
            double at = start;
            for (auto n = 2 + random() % 30; n > 0; --n) {
                at += unit * (random() % 3 == 0 ? 1 : 0.1 + 20 * uniform());
                of.push_back(*parseNumber(fmt::format("{:.9f}", at)));
            }
            stamps.insert(of.begin(), of.end());
        }
        std::string text = random() % 2 == 0 ? "Time [s]" : "time";
        for (std::size_t c = 0; c < channels; ++c) text += fmt::format(",Channel {}", c);
        stamps.insert(start);
        for (const double stamp : stamps) {
            text += fmt::format("\n{:.9f}", stamp);
            for (const auto& of : edges)
                text += fmt::format(",{}", std::ranges::count_if(of, [&](double edge) { return edge <= stamp; }) % 2);
        }
        const auto read = parseCapture(text + "\n", "digital.csv");
        ASSERT_TRUE(read) << read.error().message << "\n" << text;
        EXPECT_THAT(read->warnings, ::testing::Contains(HasSubstr("changes of level and not samples")));
        for (std::size_t c = 0; c < channels; ++c) {
            const auto found = crossings(read->capture, c);
            ASSERT_EQ(found.size(), edges[c].size()) << text;
            for (std::size_t i = 0; i < found.size(); ++i)
                EXPECT_NEAR(found[i], edges[c][i], 1e-5 / read->capture.rate_hz) << i << "\n" << text;
        }
    }
}

TEST(CsvChanges, ChannelsThatAreLetteredAreNoCurrents) {
    const auto read =
        accepted(parseCapture("Time [s],CH_A,CH_B\n1.0,0,0\n2.0,1,0\n3.0,0,0\n4.0,1,0\n6.0,0,0\n", "digital.csv"));
    EXPECT_EQ(read.capture.channels[0].name, "CH_A");
    const auto found = crossings(read.capture, 0);
    ASSERT_EQ(found.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], i == 3 ? 6 : static_cast<double>(i + 2), 1e-9);
}

TEST(CsvChanges, AnEvenClockIsNoRecordOfSamples) {
    std::string text = "Time [s],Channel 0\n";
    for (int i = 0; i < 10'000; ++i) text += fmt::format("{:.9f},{}\n", i * 1e-3, i % 2);
    const auto read = accepted(parseCapture(text, "digital.csv"));
    EXPECT_NEAR(read.capture.rate_hz, 100e3, 1e-3);
    EXPECT_EQ(crossings(read.capture, 0).size(), 9'999U);
}

TEST(CsvChanges, AColumnThatIsChosenKeepsItsEdges) {
    const std::string text = "Time [s],A,B\n0,0,0\n0.5,0,1\n2,1,1\n2.25,1,0\n7,0,0\n7.5,0,1\n9,1,1\n";
    const auto read = accepted(parseCapture(text, "digital.csv", {.columns = {"A"}}));
    const auto found = crossings(read.capture, 0);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_NEAR(found[0], 2, 1e-6);
    EXPECT_NEAR(found[1], 7, 1e-6);
    EXPECT_NEAR(found[2], 9, 1e-6);
}

TEST(CsvChanges, SamplesOfLevelsStaySamples) {
    std::string text = "Time [s],A\n";
    for (int i = 0; i < 100; ++i) text += fmt::format("{},{}\n", i, i / 10 % 2);
    const auto read = accepted(parseCapture(text, "digital.csv"));
    EXPECT_DOUBLE_EQ(read.capture.rate_hz, 1);
    EXPECT_EQ(read.capture.samples(), 100U);
    EXPECT_THAT(parseCapture(text + "200,0\n201,0\n", "digital.csv"), test::refusedSaying("even steps"))
        << "a record with a hole";
    EXPECT_EQ(parseCapture("time_s,a_v\n0,0\n1,1\n2,0\n3,1\n", "t.csv")->capture.samples(), 4U) << "volts";
}

TEST(CsvChanges, WhatCannotBeDrawnIsRefusedByName) {
    const auto refused = [](const char* rows, const ReadOptions& options = {}) {
        const auto read = parseCapture(std::string("Time [s],A\n") + rows, "digital.csv", options);
        return read ? Error{ErrorCode::Unsupported, "accepted"} : read.error();
    };
    const auto tooLong = refused("0,0\n1,1\n1.000000010,0\n2,1\n30,0\n").message;
    EXPECT_THAT(tooLong, HasSubstr("it lists changes of level and not samples"));
    EXPECT_THAT(tooLong, HasSubstr("original data"));
    const auto asSamples = refused("0,0\n1,1\n2,0\n4,1\n6,0\n", {.rate = Hertz(10)});
    EXPECT_EQ(asSamples.code, ErrorCode::InvalidArgument);
    EXPECT_THAT(asSamples.message, HasSubstr("changes of level"));
    EXPECT_THAT(refused("0,0\n3,1\n2,0\n4,1\n6,0\n").message, HasSubstr("2 s does not rise"));
}

}  // namespace
}  // namespace tacto::test
