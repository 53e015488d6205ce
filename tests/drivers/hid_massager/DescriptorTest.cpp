// HidDescriptor and Haptics: at which positions a device's controls are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "drivers/hid_massager/Haptics.h"
#include "tests/drivers/hid_massager/FakeHid.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using hid::parseHidDescriptor;
using hid::ReportKind;
using testing::HasSubstr;

hid::HidDescriptor parsed(const Bytes& bytes) {
    auto result = parseHidDescriptor(bytes);
    EXPECT_TRUE(result) << result.error().message;
    return result.value_or(hid::HidDescriptor{});
}

std::string refusal(const Bytes& bytes) {
    const auto result = parseHidDescriptor(bytes);
    EXPECT_FALSE(result);
    if (result) return {};
    EXPECT_EQ(result.error().code, ErrorCode::ParseError);
    return result.error().message;
}

TEST(HidDescriptor, FindsEachControlWithItsReportOffsetSizeAndRange) {
    RecordProperty("hazard", "H4");
    const auto descriptor = parsed(hapticDescriptor());
    const auto find = [&](ReportKind kind, hid::Usage usage) {
        for (const auto& field : descriptor.fields) {
            if (field.kind == kind && field.usage == usage) return field;
        }
        ADD_FAILURE() << "no usage " << usage;
        return hid::HidField{};
    };
    const auto intensity = find(ReportKind::Output, 0x000E0023);
    EXPECT_EQ(intensity.report, 1);
    EXPECT_EQ(intensity.bit, 8u);
    EXPECT_EQ(intensity.bits, 16);
    EXPECT_EQ(intensity.min, 0);
    EXPECT_EQ(intensity.max, 65535);
    const auto trigger = find(ReportKind::Output, 0x000E0021);
    EXPECT_EQ(trigger.bit, 24u);
    EXPECT_EQ(trigger.bits, 8);
    EXPECT_EQ(trigger.min, 1);
    EXPECT_EQ(trigger.max, 4);
    const auto fourth = find(ReportKind::Feature, 0x000A0004);
    EXPECT_EQ(fourth.report, 2);
    EXPECT_EQ(fourth.bit, 24u);
    EXPECT_TRUE(descriptor.isInside(fourth.collection, 0x000E0010));
    EXPECT_EQ(descriptor.lengthOf(ReportKind::Output, 1), 5u);
    EXPECT_EQ(descriptor.lengthOf(ReportKind::Feature, 2), 9u);
    EXPECT_EQ(descriptor.lengthOf(ReportKind::Output, 2), std::nullopt);
}

TEST(HidDescriptor, PaddingMovesWhatFollowsAndIsNoControl) {
    // 3 constant bits, then a 5-bit control, then a control of another report, which begins at that report's start.
    const auto descriptor =
        parsed({0x06, 0x00, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x85, 0x01, 0x75, 0x03, 0x95, 0x01, 0x91, 0x01, 0x09, 0x02,
                0x15, 0x00, 0x25, 0x1F, 0x75, 0x05, 0x91, 0x02, 0x85, 0x02, 0x09, 0x03, 0x75, 0x08, 0x91, 0x02, 0xC0});
    ASSERT_EQ(descriptor.fields.size(), 2u);
    EXPECT_EQ(descriptor.fields[0].bit, 11u);
    EXPECT_EQ(descriptor.fields[0].bits, 5);
    EXPECT_EQ(descriptor.fields[0].max, 31);
    EXPECT_EQ(descriptor.fields[1].report, 2);
    EXPECT_EQ(descriptor.fields[1].bit, 8u);
}

TEST(HidDescriptor, AMaximumIsUnsignedUnlessTheMinimumIsNegative) {
    const auto range = [](Bytes middle) {
        Bytes bytes{0x05, 0x0E, 0x09, 0x01, 0xA1, 0x01, 0x09, 0x23};
        bytes.insert(bytes.end(), middle.begin(), middle.end());
        bytes.insert(bytes.end(), {0x75, 0x08, 0x95, 0x01, 0x91, 0x02, 0xC0});
        const auto field = parsed(bytes).fields.at(0);
        return std::pair(field.min, field.max);
    };
    EXPECT_EQ(range({0x15, 0x00, 0x25, 0xFF}), (std::pair<std::int64_t, std::int64_t>(0, 255)));
    EXPECT_EQ(range({0x15, 0x81, 0x25, 0x7F}), (std::pair<std::int64_t, std::int64_t>(-127, 127)));
    EXPECT_EQ(range({0x15, 0x00, 0x27, 0xFF, 0xFF, 0xFF, 0xFF}),
              (std::pair<std::int64_t, std::int64_t>(0, 4294967295)));
}

TEST(HidDescriptor, PushKeepsAndPopBringsBackTheGlobalItems) {
    const auto descriptor =
        parsed({0x05, 0x0E, 0x09, 0x01, 0xA1, 0x01, 0x15, 0x00, 0x25, 0x0F, 0x75, 0x04, 0x95, 0x01, 0xA4, 0x05,
                0x01, 0x25, 0x7F, 0x75, 0x08, 0x09, 0x30, 0x91, 0x02, 0xB4, 0x09, 0x23, 0x91, 0x02, 0xC0});
    ASSERT_EQ(descriptor.fields.size(), 2u);
    EXPECT_EQ(descriptor.fields[0].usage, 0x00010030u);
    EXPECT_EQ(descriptor.fields[1].usage, 0x000E0023u);
    EXPECT_EQ(descriptor.fields[1].bits, 4);
    EXPECT_EQ(descriptor.fields[1].max, 15);
}

TEST(HidDescriptor, WhatLiesOrGoesBeyondTheTablesIsRefused) {
    RecordProperty("hazard", "H10");
    EXPECT_THAT(refusal({}), HasSubstr("1 to 4096"));
    EXPECT_THAT(refusal(Bytes(4097, 0)), HasSubstr("4097 bytes"));
    EXPECT_THAT(refusal({0x26, 0xFF}), HasSubstr("byte 0: an item is cut off"));
    EXPECT_THAT(refusal({0xFE, 0x05, 0x01, 0x00}), HasSubstr("long item"));
    EXPECT_THAT(refusal({0xC0}), HasSubstr("not open"));
    EXPECT_THAT(refusal({0xA1, 0x01}), HasSubstr("inside a collection"));
    EXPECT_THAT(refusal({0xB4}), HasSubstr("pop"));
    EXPECT_THAT(refusal({0x85, 0x00}), HasSubstr("report number 0"));
    EXPECT_THAT(refusal({0x29, 0x04}), HasSubstr("minimum"));
    EXPECT_THAT(refusal({0x19, 0x00, 0x2A, 0xFF, 0xFF}), HasSubstr("at most"));
    EXPECT_THAT(refusal({0x15, 0x05, 0x25, 0x01, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02}), HasSubstr("empty"));
    // 65535 controls of 65535 bits: no report can be that long.
    EXPECT_THAT(refusal({0x76, 0xFF, 0xFF, 0x96, 0xFF, 0xFF, 0x91, 0x02}), HasSubstr("longer"));
    // Each report has a permitted length, but all together have too many controls.
    Bytes many{0x75, 0x01, 0x96, 0xFF, 0x0F};
    for (std::uint8_t report = 1; report < 6; ++report) many.insert(many.end(), {0x85, report, 0x91, 0x02});
    EXPECT_THAT(refusal(many), HasSubstr("4096 controls"));
    EXPECT_THAT(refusal(Bytes(33, 0xA0)), HasSubstr("inside each other"));
    EXPECT_THAT(refusal(Bytes(17, 0xA4)), HasSubstr("pushes"));
}

TEST(HidDescriptor, AnyPrefixAndAnyChangedByteIsReadOrRefusedAndFieldsStayInsideTheirReports) {
    RecordProperty("hazard", "H10");
    constexpr unsigned kSeed = 11;
    std::mt19937 random(kSeed);
    const auto whole = hapticDescriptor();
    int read = 0;
    for (int round = 0; round < 20'000; ++round) {
        Bytes bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(random() % (whole.size() + 1)));
        for (int i = static_cast<int>(random() % 4); i > 0 && !bytes.empty(); --i) {
            bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
        }
        const auto result = parseHidDescriptor(bytes);
        if (!result) continue;
        ++read;
        for (const auto& field : result->fields) {
            const auto length = accepted(result->lengthOf(field.kind, field.report));
            ASSERT_LE(field.bit + field.bits, 8 * length) << "seed " << kSeed;
        }
    }
    EXPECT_GT(read, 500);
}

/// Controls to follow intensity, trigger and repeat count of hapticDescriptor(): a u16 and a u8.
const Bytes kCutoffControl{0x05, 0x0E, 0x09, 0x28, 0x15, 0x00, 0x26, 0xE8, 0x03, 0x75, 0x10, 0x95, 0x01, 0x91, 0x02};
const Bytes kRetriggerControl{0x05, 0x0E, 0x09, 0x25, 0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02};

hid::VibrationReports hapticsOf(const Bytes& descriptor, const Bytes& list) {
    const auto controls = hid::findHaptics(parsed(descriptor));
    EXPECT_TRUE(controls) << controls.error().message;
    EXPECT_EQ(controls->report, 1);
    EXPECT_EQ(controls->listReport, 2);
    EXPECT_EQ(controls->listLength, 9u);
    const auto reports = hid::hapticReports(*controls, list);
    EXPECT_TRUE(reports) << reports.error().message;
    return reports.value_or(hid::VibrationReports{});
}

TEST(Haptics, TheWaveformThatLastsIsTriggeredByItsOrdinalAndStoppedByTwo) {
    RecordProperty("hazard", "H4");
    // Ordinal 3 is a click of unknown duration, ordinal 4 a rumble.
    const auto reports = hapticsOf(hapticDescriptor(), Bytes{2, 0x03, 0x10, 0x05, 0x10, 0, 0, 0, 0});
    EXPECT_EQ(hid::startBytes(reports, 1).value(), (Bytes{1, 0xFF, 0xFF, 4, 0}));
    EXPECT_EQ(hid::startBytes(reports, 0.5).value(), (Bytes{1, 0x00, 0x80, 4, 0}));
    EXPECT_EQ(reports.stop, (Bytes{1, 0, 0, 2, 0}));
    EXPECT_FALSE(reports.ends);
    // With the list reversed the rumble is ordinal 3.
    EXPECT_EQ(hapticsOf(hapticDescriptor(), Bytes{2, 0x04, 0x10, 0x03, 0x10, 0, 0, 0, 0}).start[3], 3);
}

TEST(Haptics, AWaveformOfKnownDurationIsRepeatedAsOftenAsTheBurstLastsAndEndsByItself) {
    RecordProperty("hazard", "H2");
    // Ordinal 3 is a click of 50 ms, ordinal 4 a rumble that lasts until it is stopped.
    const Bytes list{2, 0x03, 0x10, 0x05, 0x10, 50, 0, 0, 0};
    const auto reports = hapticsOf(hapticDescriptor(), list);
    EXPECT_EQ(hid::startBytes(reports, 1, Seconds(0.1)).value(), (Bytes{1, 0xFF, 0xFF, 3, 1}));  // plays twice
    EXPECT_EQ(hid::startBytes(reports, 1, Seconds(0.05)).value(), (Bytes{1, 0xFF, 0xFF, 3, 0}));
    EXPECT_EQ(hid::startBytes(reports, 1, Seconds(0.051)).value(), (Bytes{1, 0xFF, 0xFF, 3, 1}));
    EXPECT_EQ(hid::startBytes(reports, 0.5, Seconds(1)).value(), (Bytes{1, 0x00, 0x80, 3, 19}));
    EXPECT_EQ(reports.stop, (Bytes{1, 0, 0, 2, 0}));
    EXPECT_THAT(hid::startBytes(reports, 1, Seconds(12.9)),
                refused(ErrorCode::InvalidArgument, testing::AllOf(HasSubstr("12.9 s"), HasSubstr("12.8 s"))));
    for (const double wrong : {0.0, -1.0, std::nan(""), 1e300}) {
        EXPECT_FALSE(hid::startBytes(reports, 1, Seconds(wrong))) << wrong;
    }
    // With a retrigger period, one play follows the other without a pause.
    const auto spaced = hapticsOf(hapticDescriptor(kRetriggerControl), list);
    EXPECT_EQ(hid::startBytes(spaced, 1, Seconds(0.1)).value(), (Bytes{1, 0xFF, 0xFF, 3, 1, 50}));
}

TEST(Haptics, ACutoffTimeEndsTheWaveformThatLasts) {
    RecordProperty("hazard", "H2");
    const auto reports = hapticsOf(hapticDescriptor(kCutoffControl), Bytes{2, 0x03, 0x10, 0x05, 0x10, 50, 0, 0, 0});
    EXPECT_EQ(hid::startBytes(reports, 1, Seconds(0.1)).value(), (Bytes{1, 0xFF, 0xFF, 4, 0, 100, 0}));
    EXPECT_EQ(hid::startBytes(reports, 1, Seconds(1)).value(), (Bytes{1, 0xFF, 0xFF, 4, 0, 0xE8, 3}));
    EXPECT_EQ(hid::startBytes(reports, 1, Seconds(0.0101)).value(), (Bytes{1, 0xFF, 0xFF, 4, 0, 11, 0}));
    EXPECT_FALSE(hid::startBytes(reports, 1, Seconds(1.001)));
    EXPECT_EQ(reports.stop, (Bytes{1, 0, 0, 2, 0, 0, 0}));
}

TEST(Haptics, ADeviceThatOnlyClicksOrSendsTooLittleIsRefused) {
    const auto controls = accepted(hid::findHaptics(parsed(hapticDescriptor())));
    EXPECT_THAT(hid::hapticReports(controls, Bytes{2, 0x03, 0x10, 0x03, 0x10, 0, 0, 0, 0}),
                refused(ErrorCode::Unsupported, testing::AllOf(HasSubstr("1003"), HasSubstr("1004"))));
    // None, stop, a pen's ink waveform and a play of more than a second cannot be bursts, whatever their durations.
    for (const std::uint8_t waveform : Bytes{0x01, 0x02, 0x0B}) {
        EXPECT_FALSE(hid::hapticReports(controls, Bytes{2, waveform, 0x10, 0x02, 0x10, 50, 0, 50, 0})) << int{waveform};
    }
    EXPECT_FALSE(hid::hapticReports(controls, Bytes{2, 0x03, 0x10, 0x03, 0x10, 0xE9, 3, 0, 0}));
    EXPECT_THAT(hid::hapticReports(controls, Bytes{2, 0x04, 0x10}),
                refusedSaying(testing::AllOf(HasSubstr("3 bytes"), HasSubstr("9 were expected"))));
}

TEST(Haptics, ADescriptorWithoutAControllerSaysWhatIsMissing) {
    EXPECT_THAT(hid::findHaptics(parsed(outputDescriptor(5, 32))), refusedSaying("0E:01"));
    auto headless = hapticDescriptor();
    // Gives the manual trigger another usage.
    for (std::size_t i = 0; i + 1 < headless.size(); ++i) {
        if (headless[i] == 0x09 && headless[i + 1] == 0x21) headless[i + 1] = 0x22;
    }
    EXPECT_THAT(hid::findHaptics(parsed(headless)), refusedSaying("0E:21"));
}

}  // namespace
}  // namespace tacto::test
