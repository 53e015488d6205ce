// The map of steps over the plane of R and P: reading, refusing and drawing.
#include <QJsonArray>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/report/FigureDrawing.h"
#include "tests/report/Samples.h"

namespace tacto {
namespace {

using test::drawn;
using testing::HasSubstr;

/// Two by two cells: one that no trial passed, one above the wanted value.
QJsonObject mapJson() {
    const QJsonArray cells{QJsonArray{0.5, QJsonValue()}, QJsonArray{8.24, 1.5}};
    return {{"type", "transitions"},
            {"wanted_jnd", 2},
            {"amplitude", cells},
            {"interval", cells},
            {"largest_amplitude", QJsonObject{{"roughness", 0}, {"pressure", 1}, {"jnd", 8.24}}}};
}

TEST(TransitionsFigure, KeepsWhatIsNotKnownAsUnknown) {
    const auto figure = parseFigure(mapJson()).value();
    const auto& map = std::get<TransitionsFigure>(figure.content);
    EXPECT_EQ(map.amplitude.cells[1][0], 8.24);
    EXPECT_TRUE(std::isnan(map.amplitude.cells[0][1]));
    EXPECT_EQ(map.amplitude.largest.pressure, 1);
    EXPECT_TRUE(std::isnan(map.interval.largest.jnd));
}

TEST(TransitionsFigure, NamesWhatIsWrong) {
    auto ragged = mapJson(), missing = mapJson(), wanted = mapJson(), place = mapJson();
    ragged["amplitude"] = QJsonArray{QJsonValue(QJsonArray{1, 2, 3})};
    missing.remove("interval");
    wanted["wanted_jnd"] = 0;
    place["largest_interval"] = "corner";
    EXPECT_THAT(parseFigure(ragged).error().message, HasSubstr("\"amplitude\" must be as many columns as rows"));
    EXPECT_THAT(parseFigure(missing).error().message, HasSubstr("\"interval\" must be rows of numbers or null"));
    EXPECT_THAT(parseFigure(wanted).error().message, HasSubstr("\"wanted_jnd\" must be a number above 0"));
    EXPECT_THAT(parseFigure(place).error().message, HasSubstr("\"largest_interval\" must be an object"));
}

TEST(TransitionsFigure, IsDrawnWithItsNumbersAsVectors) {
    const auto svg = drawn(mapJson(), false);
    for (const char* text : {"Amplitude: at most 8.2", "Roughness R", "Pressure P", ">1.5<", ">0.5<"}) {
        EXPECT_THAT(svg, HasSubstr(text));
    }
    EXPECT_EQ(svg.find(">1.2<"), std::string::npos) << "the plane ends at 1";
    EXPECT_EQ(svg.find("<image"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("SIMULATED"), std::string::npos);
}

TEST(TransitionsFigure, IsMarkedWhereItIsSimulated) {
    RecordProperty("hazard", "H9");
    EXPECT_THAT(drawn(mapJson(), true), HasSubstr("SIMULATED"));
}

TEST(TransitionsFigure, SaysThatNothingWasSwept) {
    QJsonObject empty{
        {"type", "transitions"}, {"wanted_jnd", 2}, {"amplitude", QJsonArray()}, {"interval", QJsonArray()}};
    EXPECT_THAT(drawn(empty, true), HasSubstr("No step was swept."));
}

}  // namespace
}  // namespace tacto
