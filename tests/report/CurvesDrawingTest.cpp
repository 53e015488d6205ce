// Curves with their bands: reading, refusing and drawing.
#include <QJsonArray>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/report/FigureDrawing.h"
#include "tests/report/Samples.h"

namespace tacto {
namespace {

using test::drawn;
using testing::HasSubstr;

QJsonObject curvesJson() {
    const QJsonObject curve{{"label", "one participant"},
                            {"x", QJsonArray{8, 16, 32}},
                            {"y", QJsonArray{40, QJsonValue(), 20}},
                            {"low", QJsonArray{30, 20, 10}},
                            {"high", QJsonArray{50, 40, 30}}};
    return {{"type", "curves"},
            {"x", QJsonObject{{"label", "Trials"}, {"unit", ""}}},
            {"y", QJsonObject{{"label", "Width"}, {"unit", "%"}}},
            {"curves", QJsonArray{curve}},
            {"lines", QJsonArray{QJsonObject{{"label", "wanted"}, {"y", 15}}}}};
}

QJsonObject withCurve(const char* key, const QJsonValue& value) {
    auto json = curvesJson();
    auto curve = json["curves"].toArray()[0].toObject();
    curve[QLatin1String(key)] = value;
    json["curves"] = QJsonArray{curve};
    return json;
}

TEST(CurvesFigure, KeepsWhatIsNotKnownAsUnknown) {
    const auto figure = parseFigure(curvesJson()).value();
    const auto& curves = std::get<CurvesFigure>(figure.content);
    ASSERT_EQ(curves.curves.size(), 1U);
    EXPECT_EQ(curves.curves[0].x[2], 32);
    EXPECT_TRUE(std::isnan(curves.curves[0].y[1]));
    EXPECT_FALSE(curves.curves[0].steps);
    EXPECT_EQ(curves.lines[0].y, 15);
    EXPECT_EQ(curves.y.unit, "%");
}

TEST(CurvesFigure, NamesWhatIsWrong) {
    EXPECT_THAT(parseFigure(withCurve("y", QJsonArray{1})).error().message, HasSubstr("\"y\" must be as long as"));
    EXPECT_THAT(parseFigure(withCurve("low", QJsonArray{1})).error().message, HasSubstr("\"low\" must be as long as"));
    EXPECT_THAT(parseFigure(withCurve("high", QJsonArray{1})).error().message,
                HasSubstr("\"high\" must be as long as"));
    EXPECT_THAT(parseFigure(withCurve("steps", 1)).error().message, HasSubstr("\"steps\" must be true or false"));
    auto missing = curvesJson();
    missing.remove("curves");
    EXPECT_THAT(parseFigure(missing).error().message, HasSubstr("\"curves\" must be a list"));
}

TEST(CurvesFigure, IsDrawnWithItsAxesAndNamesAsVectors) {
    const auto svg = drawn(curvesJson(), false);
    for (const char* text : {"Trials", "Width (%)", "one participant", "wanted"}) EXPECT_THAT(svg, HasSubstr(text));
    EXPECT_EQ(svg.find("<image"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("SIMULATED"), std::string::npos);
}

TEST(CurvesFigure, IsMarkedWhereItIsSimulated) {
    RecordProperty("hazard", "H9");
    EXPECT_THAT(drawn(curvesJson(), true), HasSubstr("SIMULATED"));
}

TEST(CurvesFigure, SaysThatThereIsNothingToDraw) {
    auto empty = curvesJson();
    empty["curves"] = QJsonArray();
    EXPECT_THAT(drawn(empty, true), HasSubstr("There is no curve to draw."));
}

}  // namespace
}  // namespace tacto
