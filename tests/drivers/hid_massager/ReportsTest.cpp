// VibrationReports: how a burst's intensity becomes bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "core/base/Statistics.h"
#include "tests/drivers/hid_massager/FakeHid.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using hid::ByteOrder;
using hid::ReportField;
using hid::startBytes;
using hid::VibrationRole;
using testing::HasSubstr;

TEST(VibrationReports, IntensityFollowsEachFieldsOwnRange) {
    auto reports = padReports();
    reports.fields[1].min = 20;
    reports.fields[1].max = 120;
    EXPECT_EQ(startBytes(reports, 0).value(), (Bytes{5, 1, 0, 0, 0, 20, 0, 0}));
    EXPECT_EQ(startBytes(reports, 0.5).value(), (Bytes{5, 1, 0, 0, 128, 70, 0, 0}));
    EXPECT_EQ(startBytes(reports, 1).value(), (Bytes{5, 1, 0, 0, 255, 120, 0, 0}));
}

TEST(VibrationReports, WhatIsNoIntensityIsRefusedNotClamped) {
    RecordProperty("hazard", "H1");
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double wrong : {-0.001, 1.001, -1.0, kNaN, kInfinity, -kInfinity}) {
        EXPECT_THAT(startBytes(padReports(), wrong), refused(ErrorCode::InvalidArgument, "0 to 1")) << wrong;
    }
}

TEST(VibrationReports, BitsAndByteOrdersLandWhereTheyBelong) {
    RecordProperty("hazard", "H4");
    Bytes report(4, 0);
    hid::setValue({8, 16, ByteOrder::Little, 0, 65535, VibrationRole::Intensity}, 0x1234, report);
    EXPECT_EQ(report, (Bytes{0, 0x34, 0x12, 0}));
    hid::setValue({8, 16, ByteOrder::Big, 0, 65535, VibrationRole::Intensity}, 0x1234, report);
    EXPECT_EQ(report, (Bytes{0, 0x12, 0x34, 0}));
    report.assign(4, 0xFF);
    hid::setValue({13, 6, ByteOrder::Little, 0, 63, VibrationRole::Intensity}, 0b101010, report);
    EXPECT_EQ(report, (Bytes{0xFF, 0b0101'1111, 0b1111'1101, 0xFF}));
    hid::setValue({16, 8, ByteOrder::Little, -100, 100, VibrationRole::Intensity}, -3, report);
    EXPECT_EQ(report[2], 0xFD);
}

TEST(VibrationReports, WhatIsWrittenIsReadBackAndNothingElseChanges) {
    RecordProperty("hazard", "H4");
    constexpr unsigned kSeed = 3;
    std::mt19937_64 random(kSeed);
    for (int round = 0; round < 20'000; ++round) {
        ReportField field;
        field.order = random() % 2 == 0 ? ByteOrder::Little : ByteOrder::Big;
        field.bits =
            static_cast<std::uint8_t>(field.order == ByteOrder::Big ? 8 * (1 + random() % 4) : 1 + random() % 32);
        field.bit = static_cast<std::uint32_t>(8 + random() % 24);
        if (field.order == ByteOrder::Big) field.bit &= ~7U;
        field.min = random() % 2 == 0 ? 0 : -1;
        const std::int64_t span = std::int64_t{1} << field.bits;
        std::int64_t value = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(span));
        if (field.min < 0) value -= span / 2;
        Bytes report(9);
        for (auto& byte : report) byte = static_cast<std::uint8_t>(random());
        const auto before = report;
        hid::setValue(field, value, report);
        ASSERT_EQ(hid::valueOf(field, report), value) << "seed " << kSeed << " round " << round;
        hid::setValue(field, hid::valueOf(field, before), report);
        ASSERT_EQ(report, before) << "seed " << kSeed << " round " << round;
    }
}

TEST(VibrationReports, ReportsThatCannotBeAreRefusedByName) {
    const auto refusal = [](auto change) {
        auto reports = padReports();
        change(reports);
        const auto valid = hid::validate(reports);
        EXPECT_FALSE(valid);
        return valid ? std::string() : valid.error().message;
    };
    EXPECT_TRUE(hid::validate(padReports(Seconds(0.1), Seconds(0.004))));
    EXPECT_THAT(refusal([](auto& r) { r.fields.clear(); }), HasSubstr("no field"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].bit = 57; }), HasSubstr("behind the report"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].bit = 4; }), HasSubstr("number"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].bit = 36; }), HasSubstr("over another"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].max = 256; }), HasSubstr("0 to 255"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].min = -129; }), HasSubstr("-128 to 127"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].min = r.fields[0].max; }), HasSubstr("rising range"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].bits = 0; }), HasSubstr("1 to 32"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0].bits = 33; }), HasSubstr("1 to 32"));
    EXPECT_THAT(refusal([](auto& r) { r.fields[0] = {33, 8, ByteOrder::Big, 0, 255, VibrationRole::Weak}; }),
                HasSubstr("whole bytes"));
    EXPECT_THAT(refusal([](auto& r) { r.stop.pop_back(); }), HasSubstr("must have the same length"));
    EXPECT_THAT(refusal([](auto& r) { r.stop[0] = 6; }), HasSubstr("must have the same number"));
    EXPECT_THAT(refusal([](auto& r) { r.keepAlive = Seconds(0.001); }), HasSubstr("keep-alive"));
    EXPECT_THAT(refusal([](auto& r) { r.shortestWrite = Seconds(0.05); }), HasSubstr("0.04"));
    EXPECT_THAT(refusal([](auto& r) { r.shortestWrite = Seconds(std::numeric_limits<double>::quiet_NaN()); }),
                HasSubstr("shortest write interval"));
    EXPECT_THAT(refusal([](auto& r) {
                    r.start.assign(1, 5);
                    r.stop = r.start;
                }),
                HasSubstr("2 to 4096"));
}

}  // namespace
}  // namespace tacto::test
