// The scales in a profile convert a fingertip's readings to N and Pa, but only for that fingertip.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/dsp/RoughnessAnalysis.h"

namespace tacto {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A second of rest, then a second under 2 N, from a fingertip that sends counts: 1000 at rest plus 250 per newton, and
/// 0.5 per pascal for taxels.
struct InCounts {
    std::vector<StreamInfo> streams{{StreamKind::Force, StreamUnit::Count, 1, 200, "force"},
                                    {StreamKind::Taxels, StreamUnit::Count, 2, 200, "taxels"}};
    std::vector<SampleBlock> blocks{2};
    InCounts() {
        for (int i = 0; i < 400; ++i) {
            const double newton = i < 200 ? 0 : 2;
            for (auto& block : blocks) block.t_s.push_back(i / 200.0);
            blocks[0].values.push_back(1000 + 250 * newton);
            for (const double share : {0.9, 1.1}) blocks[1].values.push_back(0.5 * share * newton / 1e-4);
        }
    }
};

RoughnessSettings scaled(const char* serial) {
    RoughnessSettings settings;
    settings.calibrated = true;
    settings.sensor = SensorScales{
        serial, SensorLine{0.004, -4, 1e-5}, StreamUnit::Count, {{2, 0, {}}, {2, 0, {}}}, StreamUnit::Count};
    return settings;
}

/// Returns the pressure of the last frame, and the flags.
std::pair<double, std::vector<std::string>> read(const InCounts& data, const RoughnessSettings& settings,
                                                 std::string_view serial) {
    const auto chain = RoughnessChain::create(data.streams, settings, {}, serial).value();
    std::vector<RoughnessFrame> frames;
    chain->feed(data.blocks, frames);
    chain->finish(frames);
    return {frames.back().pressure_pa, chain->flags().texts()};
}

TEST(SensorScales, GivePressureInPascalWhereTheReadingsAreCounts) {
    RecordProperty("hazard", "H7");
    const InCounts data;
    const auto [before, uncalibrated] = read(data, {}, "B-1");
    EXPECT_TRUE(std::isnan(before)) << "counts are not pressure";
    EXPECT_THAT(uncalibrated, Contains("uncalibrated units"));
    const auto [after, flags] = read(data, scaled("B-1"), "B-1");
    EXPECT_NEAR(after, 2 / 1e-4, 1e-6);
    EXPECT_THAT(flags, Not(Contains("uncalibrated units")));
    EXPECT_THAT(flags, Not(Contains("uncalibrated R")));
    EXPECT_THAT(flags, Not(Contains(HasSubstr("fingertip"))));
}

TEST(SensorScales, OfTaxelsGivePressureWhereThereIsNoForce) {
    InCounts data;
    data.streams.erase(data.streams.begin());
    data.blocks.erase(data.blocks.begin());
    EXPECT_TRUE(std::isnan(read(data, {}, "B-1").first));
    EXPECT_NEAR(read(data, scaled("B-1"), "B-1").first, 2 / 1e-4, 1e-6);
}

TEST(SensorScales, OfAnotherFingertipAreLeftAsideAndRIsUncalibrated) {
    RecordProperty("hazard", "H7");
    const auto [pressure, flags] = read({}, scaled("B-1"), "B-2");
    EXPECT_TRUE(std::isnan(pressure));
    EXPECT_THAT(flags,
                testing::IsSupersetOf({"calibrated on another fingertip", "uncalibrated R", "uncalibrated units"}));
}

TEST(SensorScales, OfAFingertipThatIsNotNamedAreUsedAndSaySo) {
    for (const auto& [made, used] : {std::pair("B-1", ""), std::pair("", "B-1")}) {
        const auto [pressure, flags] = read({}, scaled(made), used);
        EXPECT_NEAR(pressure, 2 / 1e-4, 1e-6);
        EXPECT_THAT(flags, Contains("fingertip of the calibration not confirmed"));
        EXPECT_THAT(flags, Not(Contains("uncalibrated R")));
    }
}

TEST(SensorScales, ForAnotherUnitAreLeftAside) {
    RecordProperty("hazard", "H7");
    InCounts data;
    data.streams[0].unit = StreamUnit::Newton;  // a board that now converts readings itself
    for (auto& value : data.blocks[0].values) value = (value - 1000) / 250;
    const auto [pressure, flags] = read(data, scaled("B-1"), "B-1");
    EXPECT_NEAR(pressure, 2 / 1e-4, 1e-6) << "the force as the board says it";
    EXPECT_THAT(flags, testing::IsSupersetOf({"scales for another unit left aside", "uncalibrated R"}));
}

TEST(SensorScales, ForAnotherNumberOfTaxelsAreRefused) {
    auto settings = scaled("B-1");
    settings.sensor->taxels.pop_back();
    const auto made = RoughnessChain::create(InCounts().streams, settings, {}, "B-1");
    ASSERT_FALSE(made);
    EXPECT_THAT(made.error().message, HasSubstr("sensor.taxels has 1 scales and taxels has 2 taxels"));
    for (const char* serial : {"B-2", ""}) {
        const auto [pressure, flags] = read({}, settings, serial);
        EXPECT_TRUE(std::isnan(pressure)) << "left aside";
        EXPECT_THAT(flags, Contains("calibrated on another fingertip")) << "it has other taxels";
    }
}

TEST(SensorScales, RefuseWhatIsNoScale) {
    const auto complaint = [](const char* text) {
        const auto read = roughnessSettingsFromJson(nlohmann::json::parse(text));
        return read ? "accepted" : read.error().message;
    };
    EXPECT_THAT(complaint(R"({"sensor": {"force": {"unit": "N", "scale": 0, "offset_n": 0}}})"),
                HasSubstr("\"scale\" is 0"));
    EXPECT_THAT(complaint(R"({"sensor": {"force": {"unit": "kg", "scale": 1, "offset_n": 0}}})"),
                HasSubstr("N or count"));
    EXPECT_THAT(
        complaint(R"({"sensor": {"taxels": {"unit": "Pa", "scale": [1, 2], "offset_pa": [0], "scale_u": []}}})"),
        HasSubstr("as many values as scale has"));
    EXPECT_THAT(complaint(R"({"sensor": {"serial": 5}})"), HasSubstr("roughness.sensor: \"serial\""));
    EXPECT_THAT(complaint(R"({"sensor": {"gain": 5}})"), HasSubstr("not a known key"));
    EXPECT_THAT(complaint(R"({"uncertainty": {"slide_sd": -1}})"), HasSubstr("roughness.uncertainty: \"slide_sd\""));
    EXPECT_THAT(complaint(R"({"uncertainty": {"slide_sd": 1, "coverage_factor": 2, "smooth_slides": 0}})"),
                HasSubstr("smooth_slides"));
}

}  // namespace
}  // namespace tacto
