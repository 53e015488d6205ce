// LabVIEW measurement files, following NI's specification.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/formats/CaptureFormats.h"
#include "core/formats/csv/CsvFormat.h"

namespace tacto::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

struct Lvm {
    bool commas = false;       // between columns
    bool decimalComma = true;  // decimal commas, unless commas separate columns
    std::string xColumns = "One";
    std::string dimension = "Time";
    std::size_t channels = 1;
    int segments = 1;
    double start_s = 0, step_s = 1e-5;
};

/// Returns sample i of channel c in a segment.
double valueOf(int segment, std::size_t c, std::size_t i) {
    return std::round(1e4 * std::sin(static_cast<double>(i * (c + 1)) + segment)) / 1e4;
}

std::string textOf(const Lvm& lvm, std::size_t rows) {
    const std::string gap = lvm.commas ? "," : "\t";
    const auto number = [&](double value) {
        auto text = fmt::format("{:.6f}", value);
        if (lvm.decimalComma && !lvm.commas) std::ranges::replace(text, '.', ',');
        return text;
    };
    std::string text;
    const auto key = [&](const std::string& name, const std::string& value) { text += name + gap + value + "\n"; };
    const auto keyOfAll = [&](const std::string& name, const std::string& value) {
        text += name;
        for (std::size_t c = 0; c < lvm.channels; ++c) text += gap + value;
        text += gap + "\n";
    };
    key("LabVIEW Measurement", "");
    key("Writer_Version", "2");
    key("Reader_Version", "2");
    key("Separator", lvm.commas ? "Comma" : "Tab");
    key("Decimal_Separator", lvm.decimalComma && !lvm.commas ? "," : ".");
    key("Multi_Headings", lvm.segments > 1 ? "Yes" : "No");
    key("X_Columns", lvm.xColumns);
    key("Operator", "al");
    key("Date", "2026/11/29");
    key("***End_of_Header***", "");
    key("", "");
    for (int segment = 0; segment < lvm.segments; ++segment) {
        key("Channels", fmt::format("{}", lvm.channels) + gap);
        keyOfAll("Samples", fmt::format("{}", rows));
        keyOfAll("Date", "2026/11/29");
        keyOfAll("Y_Unit_Label", "Volts");
        keyOfAll("X_Dimension", lvm.dimension);
        keyOfAll("X0", number(lvm.start_s));
        keyOfAll("Delta_X", number(lvm.step_s));
        key("***End_of_Header***", gap);
        text += "X_Value";
        for (std::size_t c = 0; c < lvm.channels; ++c) text += gap + fmt::format("Voltage_{}", c);
        text += gap + "Comment\n";
        for (std::size_t i = 0; i < rows; ++i) {
            if (lvm.xColumns == "One") text += number(lvm.start_s + static_cast<double>(i) * lvm.step_s);
            for (std::size_t c = 0; c < lvm.channels; ++c) text += gap + number(valueOf(segment, c, i));
            text += i == 0 && segment == 0 ? gap + "begun by hand\n" : "\n";
        }
        text += "\n";
    }
    return text;
}

TEST(LabView, MeasurementFilesAreReadInEveryForm) {
    std::mt19937 random(20261129);
    for (int k = 0; k < 200; ++k) {
        const Lvm lvm{.commas = random() % 3 == 0,
                      .decimalComma = random() % 2 == 0,
                      .xColumns = random() % 2 == 0 ? "One" : "No",
                      .channels = 1 + random() % 4,
                      .segments = random() % 4 == 0 ? 2 : 1,
                      .start_s = random() % 2 == 0 ? 0 : -0.125,
                      .step_s = std::pow(10.0, -static_cast<double>(random() % 6))};
        const std::size_t rows = 10 + random() % 200;
        const auto text = textOf(lvm, rows);
        const auto read = parseCapture(text, "in.lvm");
        ASSERT_TRUE(read) << read.error().message << "\n" << text;
        EXPECT_EQ(read->formatId, "csv-labview");
        EXPECT_NEAR(read->capture.rate_hz * lvm.step_s, 1, 1e-6);
        EXPECT_NEAR(read->capture.start_s, lvm.start_s, 1e-9);
        ASSERT_EQ(read->capture.channels.size(), lvm.channels);
        for (std::size_t c = 0; c < lvm.channels; ++c) {
            const auto& channel = read->capture.channels[c];
            EXPECT_EQ(channel.name, fmt::format("Voltage_{}", c));
            EXPECT_EQ(channel.unit, "V");
            ASSERT_EQ(channel.samples.size(), rows);
            for (std::size_t i = 0; i < rows; ++i) ASSERT_EQ(channel.samples[i], static_cast<float>(valueOf(0, c, i)));
        }
        if (lvm.segments > 1) {
            EXPECT_THAT(read->warnings, Contains(HasSubstr("another segment begins here")));
        } else {
            EXPECT_TRUE(read->warnings.empty()) << read->warnings.front();
        }
    }
}

TEST(LabView, WhatIsNotReadIsNamed) {
    const auto refusal = [](const Lvm& lvm) {
        const auto read = parseCapture(textOf(lvm, 20), "in.lvm");
        return read ? "accepted" : read.error().message;
    };
    EXPECT_THAT(refusal({.xColumns = "Multi"}), HasSubstr("in.lvm:7: X_Columns is 'Multi'; No or One"));
    EXPECT_THAT(refusal({.dimension = "Frequency"}), HasSubstr("X_Dimension is 'Frequency'; Time was expected"));
    EXPECT_TRUE(ownCaptureFormats()->knowsSuffix("a.LVM"));
}

}  // namespace
}  // namespace tacto::test
