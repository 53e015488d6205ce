#include <QJsonArray>
#include <gtest/gtest.h>

#include "app/report/Figure.h"
#include "tests/report/Samples.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

std::string refusal(const QJsonObject& json) {
    const auto figure = parseFigure(json);
    return figure ? "accepted" : figure.error().message;
}

TEST(Figure, ReadsEveryTypeAsDocumented) {
    for (const auto& json :
         {conditionsJson(), planeJson(3), waveformsJson(), confusionJson(), exposureJson(), timelineJson(50)}) {
        EXPECT_EQ(refusal(json), "accepted") << json["type"].toString().toStdString();
    }
    const auto conditions = parseFigure(conditionsJson()).value();
    const auto& first = std::get<ConditionsFigure>(conditions.content).conditions.front();
    EXPECT_EQ(first.name, "smooth-low");
    EXPECT_DOUBLE_EQ(first.amplitude_v.mean, 10.03);
    EXPECT_DOUBLE_EQ(first.n, 25);
}

TEST(Figure, WhatWasMeasuredStandsBesideWhatWasSet) {
    RecordProperty("hazard", "H1");
    for (const bool beyond : {false, true}) {
        const QJsonObject row{
            {"name", "commanded voltage"}, {"value", 40}, {"limit", 40}, {"unit", "V"}, {"measured", 45.9},
            {"measured_beyond", beyond}};
        const auto figure = parseFigure({{"type", "exposure"}, {"rows", QJsonArray{row}}}).value();
        const auto said = std::get<ExposureFigure>(figure.content).rows.front().reason;
        EXPECT_TRUE(said.contains("45.9")) << said.toStdString();
        EXPECT_EQ(said.contains("beyond accuracy"), beyond) << said.toStdString();
    }
}

TEST(Figure, IgnoresKeysItDoesNotKnow) {
    auto json = planeJson(2);
    json["accuracy"] = "anything";
    EXPECT_EQ(refusal(json), "accepted");
}

TEST(Figure, ReadsNullAsNotKnownAndNeverAsZero) {
    const auto exposure = parseFigure(exposureJson()).value();
    EXPECT_TRUE(std::isnan(std::get<ExposureFigure>(exposure.content).rows[4].value));
    const auto plane =
        parseFigure({{"type", "plane"}, {"trials", QJsonArray{QJsonObject{{"condition", "a"}}}}}).value();
    EXPECT_TRUE(std::isnan(std::get<PlaneFigure>(plane.content).trials[0].amplitude_v));
}

TEST(Figure, NamesWhatIsWrongAndWhere) {
    EXPECT_EQ(refusal({{"type", "pie"}}),
              "A figure's type is \"pie\"; it can be conditions, plane, waveforms, confusion, exposure, timeline, "
              "calibration, transitions or curves.");
    EXPECT_EQ(refusal({{"type", "plane"}}), "A figure of type \"plane\": \"trials\" must be a list.");
    EXPECT_EQ(refusal({{"type", "plane"}, {"trials", QJsonArray{QJsonObject{{"amplitude_v", "ten"}}}}}),
              "A figure of type \"plane\".trials[0]: \"amplitude_v\" must be a number.");
    EXPECT_EQ(refusal({{"type", "confusion"},
                       {"labels", QJsonArray{"a", "b"}},
                       {"confusion", QJsonArray{QJsonValue(QJsonArray{1, 2})}}}),
              "A figure of type \"confusion\": \"confusion\" must be one row per label.");
    EXPECT_EQ(refusal({{"type", "timeline"}, {"t_s", QJsonArray{0, 1}}, {"r", QJsonArray{0.5}}}),
              "A figure of type \"timeline\": \"r\" must be as long as \"t_s\".");
    EXPECT_EQ(
        refusal({{"type", "waveforms"}, {"captures", QJsonArray{QJsonObject{{"voltage_v", QJsonArray{1, 2}}}}}}),
        "A figure of type \"waveforms\".captures[0]: \"rate_hz\" must be a number above 0 where samples are given.");
}

TEST(Figure, FetchesCapturesNamedById) {
    auto figure = parseFigure({{"type", "waveforms"}, {"captures", QJsonArray{QJsonObject{{"capture", 17}}}}}).value();
    Capture capture;
    capture.rate_hz = 1e6;
    capture.start_s = 4.9999;
    capture.trigger_s = 5.0;
    capture.channels = {{"voltage", "V", {1, 2, 3}}, {"current", "A", {0.001F, 0.002F, 0.003F}}};
    qint64 asked = 0;
    ASSERT_TRUE(resolveCaptures(figure, [&](qint64 id) -> Result<Capture> {
        asked = id;
        return capture;
    }));
    EXPECT_EQ(asked, 17);
    const auto& trace = std::get<WaveformsFigure>(figure.content).captures[0];
    EXPECT_EQ(trace.voltage_v.size(), 3U);
    EXPECT_EQ(trace.current_a.size(), 3U);
    EXPECT_NEAR(trace.start_s, -1e-4, 1e-9);
}

TEST(Figure, PassesOnWhyACaptureIsMissing) {
    auto figure = parseFigure({{"type", "waveforms"}, {"captures", QJsonArray{QJsonObject{{"capture", 17}}}}}).value();
    EXPECT_THAT(
        resolveCaptures(figure, [](qint64) -> Result<Capture> { return fail(ErrorCode::NotFound, "no capture 17"); }),
        refused(ErrorCode::NotFound));
}

}  // namespace
}  // namespace tacto::test
