#include <QJsonArray>
#include <QPainter>
#include <QSvgRenderer>
#include <QXmlStreamReader>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "app/report/FigureDrawing.h"
#include "tests/report/Samples.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

const std::vector<QString> kTypes{"conditions", "plane", "waveforms", "confusion", "exposure", "timeline"};

QByteArray svgOf(const QJsonObject& json, bool simulated = false) {
    const auto figure = parseFigure(json);
    EXPECT_TRUE(figure) << (figure ? "" : figure.error().message);
    auto sheet = drawFigure(*figure, simulated);
    return sheetSvg(*sheet, "A figure");
}

std::string legendOf(const QJsonObject& json) {
    const auto figure = parseFigure(json);
    EXPECT_TRUE(figure) << (figure ? "" : figure.error().message);
    return figure ? figureLegend(*figure).toStdString() : std::string();
}

/// Returns all text in an SVG, one line per text element.
std::string textOf(const QByteArray& svg) {
    QXmlStreamReader xml(svg);
    std::string text;
    while (!xml.atEnd()) {
        if (xml.readNext() == QXmlStreamReader::StartElement && xml.name() == QLatin1String("text")) {
            text += xml.readElementText(QXmlStreamReader::IncludeChildElements).toStdString() + "\n";
        }
    }
    EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
    return text;
}

/// Counts the colours in the drawn figure: a blank one has one, and a bare axis has few.
std::size_t coloursOf(const QByteArray& svg) {
    QSvgRenderer renderer(svg);
    QImage image(renderer.defaultSize(), QImage::Format_RGB32);
    image.fill(Qt::white);
    QPainter painter(&image);
    renderer.render(&painter);
    painter.end();
    std::set<QRgb> colours;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) colours.insert(image.pixel(x, y));
    }
    return colours.size();
}

QJsonObject sampleOf(const QString& type) {
    if (type == "conditions") return conditionsJson();
    if (type == "plane") return planeJson(25);
    if (type == "waveforms") return waveformsJson();
    if (type == "confusion") return confusionJson();
    if (type == "exposure") return exposureJson();
    return timelineJson(500);
}

TEST(FigureDrawing, DrawsEveryTypeWithoutRasters) {
    for (const auto& type : kTypes) {
        const auto svg = svgOf(sampleOf(type), true);
        EXPECT_GT(coloursOf(svg), 8U) << type.toStdString();
        EXPECT_FALSE(svg.contains("<image")) << type.toStdString();
        EXPECT_FALSE(svg.contains("nan")) << type.toStdString();
    }
}

TEST(FigureDrawing, SaysWhyAnEmptyFigureIsEmpty) {
    for (const auto& type : kTypes) {
        const auto text = textOf(svgOf(emptyFigureJson(type)));
        EXPECT_TRUE(text.find("No ") != std::string::npos || text.find("no ") != std::string::npos)
            << type.toStdString() << ": " << text;
    }
}

TEST(FigureDrawing, MarksSimulatedFiguresAndOnlyThose) {
    RecordProperty("hazard", "H9");
    for (const auto& type : kTypes) {
        EXPECT_NE(textOf(svgOf(sampleOf(type), true)).find("SIMULATED"), std::string::npos) << type.toStdString();
        EXPECT_EQ(textOf(svgOf(sampleOf(type), false)).find("SIMULATED"), std::string::npos) << type.toStdString();
    }
}

TEST(FigureDrawing, ShowsMeasuredNumbersBesideTheTrains) {
    const auto text = textOf(svgOf(conditionsJson()));
    EXPECT_NE(text.find("Texture alone"), std::string::npos);
    EXPECT_NE(text.find("Pressure alone"), std::string::npos);
    EXPECT_NE(text.find("Texture and pressure combined"), std::string::npos);
    EXPECT_NE(text.find("40.12, s.d. 0.16"), std::string::npos) << text;
}

TEST(FigureDrawing, SaysThatAConditionWasNotMeasured) {
    auto json = conditionsJson();
    auto conditions = json["conditions"].toArray();
    conditions[1] = QJsonObject{{"name", "smooth-high"}, {"amplitude_v", QJsonValue::Null}};
    json["conditions"] = conditions;
    EXPECT_NE(textOf(svgOf(json)).find("not measured"), std::string::npos);
}

TEST(FigureDrawing, DrawsCapturedConditionsInLetteredLanes) {
    auto json = conditionsJson();
    auto conditions = json["conditions"].toArray();
    const QJsonArray trains{QJsonObject{{"onset_s", 0}, {"low_v", -10.2}, {"high_v", 10.1}},
                            QJsonObject{{"onset_s", 0.5}, {"low_v", -10.2}, {"high_v", 10.1}}};
    const QJsonObject pulse{{"rate_hz", 1e4},
                            {"start_s", -1e-4},
                            {"voltage_v", QJsonArray{0, 0, 10, 10, 0, -10, -10, 0, QJsonValue::Null}}};
    for (int i = 0; i < 4; ++i) {
        auto lane = conditions[i].toObject();
        lane["letter"] = QString(QChar('A' + i));
        if (i < 3) lane["trains"] = trains;
        if (i < 2) lane["pulse"] = pulse;
        conditions[i] = lane;
    }
    json["conditions"] = conditions;
    const auto text = textOf(svgOf(json));
    for (const char* lane : {"A\u2002smooth-low", "B\u2002smooth-high", "C\u2002rough-low", "D\u2002rough-high"}) {
        EXPECT_NE(text.find(lane), std::string::npos) << lane;
    }
    EXPECT_NE(text.find("not captured"), std::string::npos) << "nothing is drawn of what there is no capture of";
    const auto legend = figureLegend(parseFigure(json).value()).toStdString();
    EXPECT_NE(legend.find("captured train"), std::string::npos);
    EXPECT_NE(legend.find("A to C: texture alone"), std::string::npos);
    json["conditions"] = QJsonArray{QJsonObject{{"name", "x"}, {"trains", QJsonArray{1}}}};
    EXPECT_FALSE(parseFigure(json));
}

TEST(FigureDrawing, DrawsConditionsWithOtherNames) {
    const QJsonObject one{{"name", "denim"}, {"amplitude_v", 20}, {"interval_s", 1}};
    const auto text = textOf(svgOf({{"type", "conditions"}, {"conditions", QJsonArray{one}}}));
    EXPECT_NE(text.find("denim"), std::string::npos);
    EXPECT_NE(text.find("No two conditions differ in texture alone."), std::string::npos);
}

TEST(FigureDrawing, SurvivesAnIntervalNearZero) {
    const QJsonObject fast{{"name", "a-b"}, {"amplitude_v", 20}, {"interval_s", 1e-12}};
    const QJsonObject slow{{"name", "a-c"}, {"amplitude_v", 20}, {"interval_s", 1e6}};
    EXPECT_GT(coloursOf(svgOf({{"type", "conditions"}, {"conditions", QJsonArray{fast, slow}}})), 2U);
}

TEST(FigureDrawing, DrawsAPlaneOfOnePoint) {
    const QJsonObject trial{{"condition", "rough-low"}, {"amplitude_v", 40}, {"interval_s", 2}};
    const auto svg = svgOf({{"type", "plane"}, {"trials", QJsonArray{trial}}});
    EXPECT_NE(textOf(svg).find("too few for"), std::string::npos);
    EXPECT_GT(coloursOf(svg), 4U);
}

TEST(FigureDrawing, DrawsAPlaneOfEqualPoints) {
    QJsonArray trials;
    for (int i = 0; i < 5; ++i) trials << QJsonObject{{"condition", "x"}, {"amplitude_v", 40}, {"interval_s", 2}};
    const auto svg = svgOf({{"type", "plane"}, {"trials", trials}});
    EXPECT_FALSE(svg.contains("nan"));
    EXPECT_GT(coloursOf(svg), 4U);
}

TEST(FigureDrawing, LeavesOutTrialsThatAreNotNumbers) {
    const QJsonObject lost{{"condition", "x"}, {"amplitude_v", QJsonValue::Null}, {"interval_s", 2}};
    EXPECT_NE(textOf(svgOf({{"type", "plane"}, {"trials", QJsonArray{lost}}})).find("No trial has both"),
              std::string::npos);
}

TEST(FigureDrawing, SaysWhichChannelWasNotCaptured) {
    const QJsonObject voltageOnly{{"label", "probe"}, {"rate_hz", 1e5}, {"voltage_v", QJsonArray{0, 1, 1, 0}}};
    const auto text = textOf(svgOf({{"type", "waveforms"}, {"captures", QJsonArray{voltageOnly}}}));
    EXPECT_NE(text.find("current was"), std::string::npos);
    EXPECT_NE(text.find("probe"), std::string::npos);
}

TEST(FigureDrawing, ShowsTheFirstWaveformsAndSaysHowManyThereAre) {
    auto all = waveformsJson();
    const auto one = all["captures"].toArray()[0].toObject();
    QJsonArray many;
    for (int i = 0; i < 26; ++i) {
        auto capture = one;
        capture["label"] = QString("change %1").arg(i);
        many << capture;
    }
    all["captures"] = many;
    const auto text = textOf(svgOf(all));
    EXPECT_THAT(text, HasSubstr("change 7"));
    EXPECT_THAT(text, testing::Not(HasSubstr("change 8")));
    EXPECT_THAT(legendOf(all), HasSubstr("The first 8 of 26; the session holds all."));
    EXPECT_THAT(legendOf(waveformsJson()), testing::Not(HasSubstr("The first")));
}

TEST(FigureDrawing, ShowsTheSweepDirectionsOnAScaleOfTheirOwn) {
    QJsonArray levels;
    for (const double at : {10.0, 20.0, 40.0}) {
        levels << QJsonObject{{"commanded", at}, {"mean_up", at + 0.001},        {"mean_down", at - 0.001},
                              {"error", 0.001},  {"expanded_uncertainty", 0.06}, {"tolerance", 0.02 * at}};
    }
    const QJsonObject errors{
        {"type", "calibration"}, {"view", "errors"}, {"quantity", "amplitude"}, {"unit", "V"},
        {"gain", 1.0},           {"offset", 0.0},    {"levels", levels},        {"readings", QJsonArray{}}};
    const auto text = textOf(svgOf(errors));
    EXPECT_THAT(text, HasSubstr("Measured \u2212 commanded (mV)"));
    EXPECT_THAT(text, HasSubstr("Error of each direction (mV)"));
    EXPECT_THAT(text, HasSubstr("750")) << "the tolerance of 800 mV";
    EXPECT_THAT(text, HasSubstr("\u22121.0")) << "and what 2 mV between the directions are seen on";
}

TEST(FigureDrawing, TitlesOfAxesBeginWithACapital) {
    std::size_t titled = 0;
    for (const auto& type : kTypes) {
        const auto figure = accepted(parseFigure(sampleOf(type)));
        const auto sheet = drawFigure(figure, false);
        for (const auto* axes : sheet->plot().axisRects()) {
            for (const auto* axis : axes->axes()) {
                const auto title = axis->label();
                if (title.isEmpty()) continue;
                ++titled;
                EXPECT_FALSE(title.front().isLower()) << type.toStdString() << ": " << title.toStdString();
            }
        }
    }
    EXPECT_GE(titled, kTypes.size());
}

TEST(FigureDrawing, DrawsAFlatWaveform) {
    const QJsonObject flat{
        {"rate_hz", 1e5}, {"voltage_v", QJsonArray{0, 0, 0, 0}}, {"current_a", QJsonArray{0, 0, 0, 0}}};
    EXPECT_FALSE(svgOf({{"type", "waveforms"}, {"captures", QJsonArray{flat}}}).contains("nan"));
}

TEST(FigureDrawing, ShowsNotEvaluatedAsHatchedAndInWords) {
    RecordProperty("hazard", "H9");
    const auto text = textOf(svgOf(exposureJson()));
    EXPECT_NE(text.find("not evaluated"), std::string::npos) << text;
    EXPECT_THAT(legendOf(exposureJson()), HasSubstr("no electrode area")) << "and why, below";
    EXPECT_NE(text.find("attention"), std::string::npos);
    // The hatching has more lines than the same row with a value.
    auto evaluated = exposureJson();
    auto rows = evaluated["rows"].toArray();
    auto row = rows[4].toObject();
    row["value"] = 0.1;
    rows[4] = row;
    evaluated["rows"] = rows;
    EXPECT_GT(svgOf(exposureJson()).count("<polyline"), svgOf(evaluated).count("<polyline") + 10);
}

TEST(FigureDrawing, NeverShowsAnExposureThatIsNotANumberAsWithin) {
    RecordProperty("hazard", "H9");
    ExposureFigure figure{
        {{"Peak current", std::numeric_limits<double>::infinity(), 10, "mA", "paper", "", false, {}}}};
    auto sheet = drawExposure(figure, false);
    EXPECT_NE(textOf(sheetSvg(*sheet, "x")).find("not evaluated"), std::string::npos);
}

TEST(FigureDrawing, TakesTheJudgesWordThatAValueAtItsLimitIsOver) {
    RecordProperty("hazard", "H9");
    const QJsonObject row{{"name", "RMS"}, {"value", 10}, {"limit", 10}, {"unit", "mA"}, {"within", false}};
    EXPECT_NE(textOf(svgOf({{"type", "exposure"}, {"rows", QJsonArray{row}}})).find("over the limit"),
              std::string::npos);
}

TEST(FigureDrawing, KeepsEveryPeakOfALongSeries) {
    std::vector<double> values(100000, 0.0);
    values[31415] = 7;
    values[92653] = -7;
    const auto points = visiblePoints(values, 100);
    EXPECT_LT(points.size(), 600U);
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
    EXPECT_TRUE(std::binary_search(points.begin(), points.end(), 31415U));
    EXPECT_TRUE(std::binary_search(points.begin(), points.end(), 92653U));
}

TEST(FigureDrawing, KeepsGapsOfALongSeries) {
    std::vector<double> values(10000, 1.0);
    values[5000] = kUnknown;
    const auto points = visiblePoints(values, 50);
    EXPECT_TRUE(std::binary_search(points.begin(), points.end(), 5000U));
}

TEST(FigureDrawing, DrawsATimelineOfOneTrain) {
    const QJsonObject train{{"t_s", 1.0}, {"amplitude_v", 10}};
    const auto svg = svgOf({{"type", "timeline"}, {"trains", QJsonArray{train}}});
    EXPECT_NE(textOf(svg).find("Neither roughness nor pressure"), std::string::npos);
}

TEST(FigureDrawing, AnSvgsNumberIsNotPartedFromItsMinus) {
    PlotSheet sheet(200, 100, false);
    sheet.addNote(sheet.addAxes(0, 0), "−12.5 ≤ 3", {0.5, 0.5});
    const auto svg = sheetSvg(sheet, "minus");
    EXPECT_NE(textOf(svg).find("−12.5 ≤ 3"), std::string::npos) << svg.toStdString();
    EXPECT_FALSE(svg.contains(">−</text>"));
    QXmlStreamReader xml(svg);
    while (!xml.atEnd()) xml.readNext();
    EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
}

}  // namespace
}  // namespace tacto::test
