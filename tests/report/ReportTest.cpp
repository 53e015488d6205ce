#include <QJsonArray>
#include <QXmlStreamReader>
#include <gmock/gmock.h>
#include <regex>

#include "app/report/NumberText.h"
#include "app/report/Report.h"
#include "app/report/ReportBasis.h"
#include "app/report/TableContent.h"
#include "tests/report/Samples.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

QString asQString(const fs::path& path) { return QString::fromStdString(path.string()); }

/// Returns the text of a PDF, with narrow spaces as spaces.
std::string pdfText(const fs::path& pdf) {
    return QString::fromStdString(poppler("pdftotext -layout", pdf)).replace(QChar(0x202f), ' ').toStdString();
}

std::size_t occurrences(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

class Report : public ::testing::Test {
protected:
    fs::path write(const ReportModel& model, const std::string& name) {
        const auto path = scratch_.path() / name;
        const auto written = writeReport(model, asQString(path));
        EXPECT_TRUE(written) << (written ? "" : written.error().message);
        return path;
    }
    ScratchDir scratch_;
};

TEST_F(Report, PutsTheVerdictAndItsReasonsFirst) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto text = pdfText(write(separabilityModel(false), "r.pdf"));
    const auto verdict = text.find("Indeterminate");
    ASSERT_NE(verdict, std::string::npos);
    // Page 1 gives the reasons, their basis and the people; then the rest follows.
    EXPECT_LT(verdict, text.find("Every pair of conditions"));
    EXPECT_LT(text.find("Every pair of conditions"), text.find("Not evaluated"));
    EXPECT_LT(text.find("Not evaluated"), text.find("Ambient conditions"));
    EXPECT_LT(text.find("Ambient conditions"), text.find("Reviewer"));
    EXPECT_LT(text.find("Reviewer"), text.find("page 1 of"));
    EXPECT_LT(text.find("page 1 of"), text.find("Computed from approved trains"));
    EXPECT_LT(text.find("Figure 1."), text.find("Computed from approved trains"));
    EXPECT_LT(text.find("Computed from approved trains"), text.find("What was used"));
    EXPECT_LT(text.find("What was used"), text.find("How to reproduce"));
    EXPECT_NE(text.find("Report number"), text.npos);
}

TEST_F(Report, SaysEveryVerdictInAWord) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    auto model = separabilityModel(false, 3);
    model.items.clear();
    const std::vector<std::pair<ReportVerdict, const char*>> words{{ReportVerdict::Pass, "Pass"},
                                                                   {ReportVerdict::Fail, "Fail"},
                                                                   {ReportVerdict::Indeterminate, "Indeterminate"},
                                                                   {ReportVerdict::Stopped, "Stopped"},
                                                                   {ReportVerdict::None, "No verdict"}};
    for (const auto& [verdict, word] : words) {
        model.verdict = verdict;
        EXPECT_NE(pdfText(write(model, "v.pdf")).find(word), std::string::npos) << word;
    }
}

TEST_F(Report, NamesWhatWasUsed) {
    RecordProperty("hazard", "H8");
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto model = separabilityModel(false);
    const auto text = pdfText(write(model, "r.pdf"));
    for (const auto& device : model.devices) EXPECT_NE(text.find(device.serial.toStdString()), std::string::npos);
    EXPECT_NE(text.find(model.chainHead.toStdString()), std::string::npos) << "the chain head is printed whole";
    EXPECT_NE(text.find(std::string(64, 'a')), std::string::npos);
    EXPECT_NE(text.find("Tactoscope 0.1.0"), std::string::npos);
    EXPECT_NE(text.find("--set repeats=25"), std::string::npos);
    EXPECT_NE(text.find("Electrode open."), std::string::npos);
}

TEST_F(Report, NumbersItsPages) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto pdf = write(separabilityModel(false), "r.pdf");
    std::smatch found;
    const std::string info = poppler("pdfinfo", pdf);
    ASSERT_TRUE(std::regex_search(info, found, std::regex("Pages:\\s+(\\d+)"))) << info;
    const int pages = std::stoi(found[1]);
    EXPECT_GE(pages, 3);
    const auto text = pdfText(pdf);
    EXPECT_NE(text.find("page 1 of " + std::to_string(pages)), std::string::npos);
    EXPECT_NE(text.find("page " + std::to_string(pages) + " of " + std::to_string(pages)), std::string::npos);
    EXPECT_NE(info.find("A4"), std::string::npos);
}

TEST_F(Report, KeepsEachCaptionOnItsFiguresPage) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto text = pdfText(write(separabilityModel(false), "r.pdf"));
    std::vector<std::string> pages;
    std::size_t begin = 0;
    for (auto end = text.find('\f'); end != std::string::npos; begin = end + 1, end = text.find('\f', begin)) {
        pages.push_back(text.substr(begin, end - begin));
    }
    // A word inside each figure, and the figure's caption.
    const std::vector<std::pair<const char*, const char*>> pairs{
        {"Texture alone", "Figure 1."}, {"Interval between trains", "Figure 2."},
        {"Current (mA)", "Figure 3."},  {"Presented", "Figure 4."},
        {"roughness R", "Figure 5."},   {"Share of the limit", "Figure 6."}};
    for (const auto& [inside, caption] : pairs) {
        const auto with = std::count_if(pages.begin(), pages.end(), [&](const std::string& page) {
            return page.find(caption) != std::string::npos;
        });
        EXPECT_EQ(with, 1) << caption;
        const bool together = std::any_of(pages.begin(), pages.end(), [&](const std::string& page) {
            return page.find(caption) != std::string::npos && page.find(inside) != std::string::npos;
        });
        EXPECT_TRUE(together || std::string(inside) == "Current (mA)" || std::string(inside) == "Presented")
            << caption << " (rotated labels may come out as single letters)";
    }
}

TEST_F(Report, RepeatsTheHeaderOfALongTable) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto text = pdfText(write(separabilityModel(false, 100), "long.pdf"));
    EXPECT_GE(occurrences(text, "Trials, continued"), 2U);
}

TEST_F(Report, DrawsVectorsOnly) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto list = poppler("pdfimages -list", write(separabilityModel(true), "r.pdf"));
    EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 2) << "only the list's two header lines:\n" << list;
}

TEST_F(Report, EmbedsItsFonts) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto fonts = poppler("pdffonts", write(separabilityModel(false), "r.pdf"));
    EXPECT_NE(fonts.find("NotoSans-Regular"), std::string::npos) << fonts;
    EXPECT_NE(fonts.find("NotoSans-Bold"), std::string::npos) << fonts;
    EXPECT_TRUE(std::regex_search(fonts, std::regex("Identity-H +yes"))) << fonts;
    EXPECT_FALSE(std::regex_search(fonts, std::regex("Identity-H +no"))) << fonts;
}

TEST_F(Report, MarksASimulatedSessionAndNoOther) {
    RecordProperty("hazard", "H9");
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    const auto simulated = pdfText(write(separabilityModel(true), "s.pdf"));
    EXPECT_NE(simulated.find("Indeterminate – simulated"), std::string::npos);
    EXPECT_NE(simulated.find(". Pairs (simulated)"), std::string::npos);
    EXPECT_NE(simulated.find("Figure 1. The four conditions (simulated)"), std::string::npos);
    auto realModel = separabilityModel(false);
    realModel.settings.clear();
    for (auto& device : realModel.devices) device.name = "Bench device", device.uri = "bench:";
    const auto real = pdfText(write(realModel, "r.pdf"));
    EXPECT_EQ(real.find("simulated)"), std::string::npos);
    EXPECT_EQ(real.find("– simulated"), std::string::npos);
    const auto html = contentOfFile(write(realModel, "r.html"));
    EXPECT_FALSE(html.contains("SIMULATED"));
    EXPECT_GT(contentOfFile(write(separabilityModel(true), "s.html")).count("SIMULATED"), 5);
}

TEST_F(Report, SaysOnEveryPageThatItsSessionWasAltered) {
    RecordProperty("hazard", "H8");
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    auto model = separabilityModel(false);
    model.verdict = ReportVerdict::Pass;
    const auto intact = pdfText(write(model, "intact.pdf"));
    EXPECT_EQ(intact.find("DAMAGED"), std::string::npos);
    model.damage = QStringList{"row 12 (trial rough-high) was altered: its hash is wrong"};
    const auto pdf = pdfText(write(model, "altered.pdf"));
    std::size_t pages = 0;
    for (std::size_t at = 0, end = 0; (end = pdf.find('\f', at)) != std::string::npos; at = end + 1) {
        ++pages;
        EXPECT_NE(pdf.substr(at, end - at).find("DAMAGED"), std::string::npos) << "page " << pages;
    }
    EXPECT_GT(pages, 2U);
    EXPECT_NE(pdf.find("row 12 (trial rough-high) was altered"), std::string::npos);
    EXPECT_NE(pdf.find("Indeterminate – session damaged"), std::string::npos) << "a pass is not shown as one";
    const auto html = contentOfFile(write(model, "altered.html")).toStdString();
    EXPECT_NE(html.find("class=\"simulated damaged\">DAMAGED"), std::string::npos);
    EXPECT_NE(html.find("row 12 (trial rough-high) was altered"), std::string::npos);
}

TEST_F(Report, NeverCallsAMissingExposureWithin) {
    RecordProperty("hazard", "H9");
    auto model = separabilityModel(false, 3);
    const auto shown = contentOfFile(write(model, "e.html"));
    EXPECT_TRUE(shown.contains("Not evaluated: "));
    EXPECT_TRUE(shown.contains(": no electrode area"));
    model.exposure.clear();
    const auto html = contentOfFile(write(model, "e.html"));
    EXPECT_TRUE(html.contains("exposure: this session holds no approved train"));
    EXPECT_FALSE(html.contains("Computed from approved trains")) << "no section is left empty for it";
}

TEST_F(Report, HoldsNoCharacterThatCommandsATerminalOrTurnsTheText) {
    RecordProperty("hazard", "H10");
    auto model = separabilityModel(false, 3);
    const QString hostile = QString::fromUtf8("a\x1b[31m b\u202e c\u009b d\x07 e\u200b.");
    model.reasons << hostile;
    model.protocol = hostile;
    for (auto& item : model.items) {
        if (auto* figure = std::get_if<ReportFigure>(&item)) figure->caption = hostile;
    }
    const auto html = QString::fromUtf8(contentOfFile(write(model, "h.html")));
    EXPECT_TRUE(html.contains(QChar(QChar::ReplacementCharacter)));
    for (const QChar c : html) {
        const auto u = c.unicode();
        EXPECT_FALSE((u < 0x20 && u != '\n' && u != '\t') || (u >= 0x7f && u < 0xa0) || u == 0x202e || u == 0x200b)
            << int{u};
    }
}

TEST_F(Report, ShowsTheBeginningOfALongTextAndSaysHowMuchTheSessionHolds) {
    RecordProperty("hazard", "H10");
    constexpr qsizetype kLong = 900'000;
    const QString text(kLong, 'm');
    auto model = separabilityModel(true, 3);
    model.title = model.purpose = text;
    model.reasons << text;
    model.items.emplace_back(ReportText{text});
    model.items.emplace_back(ReportTable{text, {}, {QJsonObject{{"name", text}, {text, 1}}}});
    model.events.push_back({1, "remark", text, 1});
    QJsonObject confusion = confusionJson();
    confusion["labels"] = QJsonArray{text, "b", "c", "d"};
    confusion.remove("columns");
    const auto figure = accepted(parseFigure(confusion));
    model.items.emplace_back(ReportFigure{text, figure});
    write(model, "long.pdf");
    const auto html = QString::fromUtf8(contentOfFile(write(model, "long.html")));
    EXPECT_TRUE(html.contains("… (896000 more characters in the session)"));
    EXPECT_TRUE(html.contains("… (899000 more characters in the session)")) << "of a cell";
    EXPECT_TRUE(html.contains(" more characters in the session) (simulated)")) << "marks are not cut off";
    EXPECT_FALSE(html.contains(QString(4001, 'm')));
    if (!havePoppler()) return;
    const auto shown = pdfText(scratch_.path() / "long.pdf");
    EXPECT_NE(shown.find("899920 more"), shown.npos) << "the running head";
}

TEST_F(Report, WritesWellFormedHtmlThatNeedsNoOtherFile) {
    auto model = separabilityModel(true);
    model.title = "Marks <b> & \"quotes\" \x01";
    model.events.push_back({1, "fault", "</pre><script>alert(1)</script>"});
    const auto html = contentOfFile(write(model, "r.html"));
    QXmlStreamReader xml(html);
    int figures = 0;
    while (!xml.atEnd()) {
        if (xml.readNext() != QXmlStreamReader::StartElement) continue;
        figures += xml.name() == QLatin1String("svg") ? 1 : 0;
        EXPECT_NE(xml.name(), QLatin1String("script"));
        EXPECT_NE(xml.name(), QLatin1String("link"));
        EXPECT_FALSE(xml.attributes().hasAttribute("src"));
    }
    EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString() << " in line " << xml.lineNumber();
    EXPECT_EQ(figures, 6);
    EXPECT_FALSE(html.contains("url("));
}

TEST_F(Report, SplitsATableThatIsWiderThanThePage) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    ReportModel model;
    QJsonObject row{{"name", "200 ohm + (10 kohm || 50 nF)"}};
    QStringList columns{"name"};
    for (const char* key : {"nominal_ohm", "measured_ohm", "peak_v", "peak_ma", "rms_train_ma", "rms_1s_ma",
                            "rms_5s_ma", "charge_uc", "net_charge_uc", "energy_mj", "power_density_w_cm2", "measured_v",
                            "measured_ma", "width_us", "gap_us", "interval_s"}) {
        row[key] = 123.456;
        columns << key;
    }
    row["verdict"] = "pass";
    columns << "verdict";
    model.items.emplace_back(ReportTable{"Loads", columns, QJsonArray{row}});
    const auto text = pdfText(write(model, "wide.pdf"));
    EXPECT_NE(text.find("Loads, further columns"), std::string::npos) << text;
    EXPECT_NE(text.find("pass"), std::string::npos);
    EXPECT_GE(occurrences(text, "200 Ω"), 2U) << "each part names its rows";
    EXPECT_EQ(occurrences(text, "pass"), 1U) << "not by its verdict";
}

TEST_F(Report, ATableBeginsWithItsVerdictAsInTheWindow) {
    const QJsonObject row{{"load", "500 ohm"}, {"peak_v", 20.1}, {"verdict", "pass"}, {"reason", "none"}};
    for (const QStringList& given : {QStringList{"load", "peak_v", "verdict", "reason"}, QStringList{}}) {
        const auto table = tableOf({"Loads", given, QJsonArray{row}}, "Loads");
        ASSERT_EQ(table.columns.size(), 4U);
        EXPECT_EQ(table.columns[0].title, "Verdict");
        EXPECT_EQ(table.columns[1].title, "Load");
        EXPECT_EQ(table.rows[0].mid(0, 2), (QStringList{"✔\u00a0pass", "500\u00a0Ω"}));
        EXPECT_EQ(table.naming, 1U) << "a part of a wide table says its rows' loads";
    }
    EXPECT_EQ(tableOf({"Loads", {"load", "peak_v"}, QJsonArray{row}}, "Loads").naming, 0U);
}

TEST_F(Report, ATableHasItsUnitInTheHeaderAndItsVerdictAsShapeAndWord) {
    ReportModel model;
    model.items.emplace_back(ReportTable{
        "Levels",
        {"commanded", "error", "verdict", "remark"},
        QJsonArray{
            QJsonObject{{"commanded", "10.00 V"}, {"error", "-2.1 ± 6.6 µs"}, {"verdict", "pass"}, {"remark", ""}},
            QJsonObject{
                {"commanded", "12.00 V"}, {"error", "7 ± 11 µs"}, {"verdict", "indeterminate"}, {"remark", ""}}}});
    const auto html = QString::fromUtf8(contentOfFile(write(model, "t.html")));
    EXPECT_TRUE(html.contains("<th scope=\"col\" class=\"number\">Commanded (V)</th>"));
    EXPECT_TRUE(html.contains("<td class=\"number\">10.00</td>"));
    EXPECT_TRUE(html.contains("<td class=\"number\">−2.1 ± 6.6</td>"));
    EXPECT_TRUE(html.contains("<td>✔\u00a0pass</td>"));
    EXPECT_TRUE(html.contains("<td>?\u00a0indeterminate</td>"));
    EXPECT_FALSE(html.contains("Remark")) << "a column that says nothing";
}

TEST_F(Report, WhatARowIsAboutBeginsAsASentenceDoesAndAConditionKeepsItsName) {
    ReportModel model;
    model.reasons = {"current density was not evaluated"};
    model.verdict = ReportVerdict::Indeterminate;
    const QJsonObject judged{{"requirement", "peak voltage"}, {"condition", "smooth-low"}};
    model.items.emplace_back(ReportTable{"Closest", {"requirement", "condition"}, QJsonArray{judged}});
    const QJsonObject row{{"title", "energy per pulse"}, {"cells", QJsonArray{}}};
    model.items.emplace_back(ReportMatrix{"Limits", {"1 kohm"}, QJsonArray{row}});
    const auto html = QString::fromUtf8(contentOfFile(write(model, "t.html")));
    EXPECT_TRUE(html.contains("<td>Peak voltage</td>"));
    EXPECT_TRUE(html.contains("<td>smooth-low</td>"));
    EXPECT_TRUE(html.contains("Energy per pulse"));
    EXPECT_TRUE(html.contains("<li>Current density was not evaluated</li>"));
}

TEST_F(Report, AJudgedCellSaysHowMuchOfItsLimitIsUsed) {
    RecordProperty("hazard", "H9");
    ReportModel model;
    const auto cell = [](double margin_pct) {
        return QJsonObject{
            {"value", 40.0}, {"expanded_uncertainty", 0.5}, {"verdict", "pass"}, {"margin_pct", margin_pct}};
    };
    const QJsonObject row{{"title", "peak voltage"},
                          {"unit", "V"},
                          {"limit", 40.0},
                          {"cells", QJsonArray{cell(0), cell(58.4), cell(99.97), cell(99.4)}}};
    model.items.emplace_back(ReportMatrix{"Limits", {"1 kohm", "2 kohm", "10 kohm", "100 kohm"}, QJsonArray{row}});
    const auto html = QString::fromUtf8(contentOfFile(write(model, "t.html"))).replace(QChar(0x202f), ' ');
    for (const auto* share : {"100 %", "42 %", "&lt; 0.1 %", "0.6 %"}) EXPECT_TRUE(html.contains(share)) << share;
    EXPECT_TRUE(html.contains("the share of the limit used, (value + U) / limit"));
    EXPECT_FALSE(html.contains("margin,"));
}

TEST(LimitMatrix, OneLimitFromTwoDocumentsIsOneRowThatNamesBoth) {
    RecordProperty("hazard", "H9");
    using State = MatrixBlock::State;
    const auto line = [](const char* set, const char* compare, const char* verdict, double margin_pct) {
        const nlohmann::json cell = {{"load", "500 ohm"}, {"value", 9.0},       {"expanded_uncertainty", 0.1},
                                     {"note", "noted"},   {"verdict", verdict}, {"margin_pct", margin_pct}};
        return nlohmann::json{
            {"title", "peak"},    {"unit", "mA"},  {"limit", 10.0},           {"compare", compare},      {"set", set},
            {"verdict", verdict}, {"source", set}, {"worst_load", "500 ohm"}, {"cells", {nullptr, cell}}};
    };
    nlohmann::json matrix = {{"loads", {"open", "500 ohm"}},
                             {"lines",
                              {line("paper", "<=", "pass", 9), line("gate", "<", "pass", 9),
                               line("gate", "<", "fail", -1), line("gate", "<", "not evaluated", 9)}}};
    const auto block = limitsOf(matrix);
    ASSERT_EQ(block.rows.size(), 3U);
    EXPECT_EQ(block.rows[0].set, limitSetTitle("paper") + ", " + limitSetTitle("gate"));
    EXPECT_TRUE(block.rows[0].limit.startsWith('<')) << "the stricter of the two";
    EXPECT_EQ(block.rows[0].cells[0].state, State::Empty);
    EXPECT_EQ(block.rows[0].cells[1].state, State::Close) << "91 % used";
    EXPECT_EQ(block.rows[1].cells[1].state, State::Broken);
    EXPECT_EQ(block.rows[2].cells[1].state, State::Open) << "and no share of what was not evaluated";
    EXPECT_EQ(closestOf(block, "").rows.front().last(), "noted");
    // No shape of these values from a script may crash the program.
    const nlohmann::json shapes[] = {nullptr, 1, "text", true, nlohmann::json::array({1, "a", nullptr}), {{"a", 1}}};
    for (const auto& shape : shapes) {
        EXPECT_TRUE(limitsOf(shape).rows.empty());
        for (const auto& [key, was] : matrix["lines"][0].items()) {
            auto odd = matrix;
            odd["lines"][0][key] = shape;
            EXPECT_LE(closestOf(limitsOf(odd), "").rows.size(), 3U) << key;
        }
        for (const char* key : {"loads", "lines"}) {
            auto odd = matrix;
            odd[key] = shape;
            EXPECT_LE(limitsOf(odd).rows.size(), 4U) << key;
        }
    }
}

TEST_F(Report, WhatIsNotEvaluatedOnSeveralLoadsForOneReasonIsOneSentence) {
    const auto row = [](const char* load, const char* join) {
        return QJsonObject{
            {"load", load},
            {"verdict", "not evaluated"},
            {"reason", QString("current density %1 %2 was not evaluated: the area is not known").arg(join, load)}};
    };
    const QJsonObject other{{"load", "100 ohm"},
                            {"verdict", "not evaluated"},
                            {"reason", "net charge into 100 ohm was not evaluated: it was not captured"}};
    const QJsonObject results{
        {"rows", QJsonArray{row("100 ohm", "into"), other, row("200 ohm + 10 kohm || 50 nF", "into")}},
        {"worst_case", QJsonObject{{"rows", QJsonArray{row("500 to 10000 ohm", "over")}}}}};
    ReportModel model;
    readBasis(results, model);
    ASSERT_EQ(model.basis.notEvaluated.size(), 2);
    // Placed next to "Not evaluated", which is not repeated.
    EXPECT_EQ(model.basis.notEvaluated[0],
              withSigns("current density into 100 ohm, 200 ohm + 10 kohm || 50 nF and in the worst case: the area is "
                        "not known"));
    EXPECT_EQ(model.basis.notEvaluated[1], withSigns("net charge into 100 ohm: it was not captured"));
}

/// Returns the report's judgement on the reference in these results.
std::string referenceJudged(const QJsonObject& check) {
    ReportModel model;
    readBasis({{"kind", "stimulator-calibration"}, {"reference", check}}, model);
    if (model.basis.restsOn.empty()) return {};
    return model.basis.restsOn.front().value.section(": ", -1).toStdString();
}

TEST_F(Report, AReferenceThatWasLeftOpenDidNotFail) {
    RecordProperty("hazard", "H9");
    QJsonObject check{{"load_ohm", 1000}, {"measured_ohm", 1045},          {"expanded_ohm", 20}, {"deviation_pct", 4.5},
                      {"allowed_pct", 5}, {"expanded_uncertainty_pct", 2}, {"passed", false}};
    EXPECT_EQ(referenceJudged(check), "indeterminate") << "of a session from before the verdict was recorded";
    check["deviation_pct"] = 20;
    EXPECT_EQ(referenceJudged(check), "fail");
    check["expanded_uncertainty_pct"] = QJsonValue::Null;
    EXPECT_EQ(referenceJudged(check), "not evaluated");
    check["verdict"] = "indeterminate";
    EXPECT_EQ(referenceJudged(check), "indeterminate") << "as it was recorded";
    EXPECT_EQ(referenceJudged({{"load_ohm", 1000}, {"passed", true}}), "pass");
    EXPECT_EQ(referenceJudged({{"mass_g", 100}, {"measured", 1.2}, {"passed", false}}), "fail");
    EXPECT_EQ(referenceJudged({{"mass_g", 100}, {"passed", false}}), "not evaluated") << "nothing was read";
}

TEST_F(Report, ANameThatWasNotGivenIsALineToSignOnPaper) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    auto model = separabilityModel(true);
    model.basis.sample = "S-014";
    model.basis.ambient = "22.5 °C";
    EXPECT_THAT(pdfText(write(model, "r.pdf")), Not(HasSubstr("not recorded")));
    EXPECT_THAT(contentOfFile(write(model, "r.html")).toStdString(), HasSubstr(">Reviewer</th><td>not recorded</td>"));
    model.basis.operatorName = "A. Weber";
    EXPECT_THAT(pdfText(write(model, "r.pdf")), HasSubstr("A. Weber"));
}

TEST_F(Report, SaysHowLongItTookInMinutesAndSeconds) {
    auto model = separabilityModel(true);
    const auto html = QString::fromUtf8(contentOfFile(write(model, "r.html"))).replace(QChar(0x202f), ' ');
    EXPECT_TRUE(html.contains("2026-11-20 14:03:05 UTC  ·  4 min 21 s"));
}

TEST_F(Report, ALongTablesLastRowIsNotAloneOnItsPage) {
    if (!havePoppler()) GTEST_SKIP() << kNoPoppler;
    for (int rows = 30; rows < 120; rows += 7) {
        ReportModel model;
        QJsonArray all;
        const QString words =
            "words that take the whole width of the page, so that rows stand one below the other and "
            "none beside";
        for (int i = 0; i < rows; ++i) all << QJsonObject{{"name", QString("row%1").arg(i)}, {"remark", words}};
        model.items.emplace_back(ReportTable{"Rows", {"name", "remark"}, all});
        const auto text = pdfText(write(model, "rows.pdf"));
        const auto last = text.find("row" + std::to_string(rows - 1));
        ASSERT_NE(last, std::string::npos);
        const auto page = text.rfind('\f', last);
        const auto third = text.find("row" + std::to_string(rows - 3));
        EXPECT_TRUE(page == std::string::npos || third > page) << rows;
    }
}

TEST_F(Report, AVerdictStandsOnItsColourAlsoInPrint) {
    auto model = separabilityModel(false, 3);
    model.verdict = ReportVerdict::Pass;
    const auto html = contentOfFile(write(model, "v.html"));
    EXPECT_TRUE(html.contains("background: #00735c; color: #ffffff"));
    EXPECT_TRUE(html.contains("print-color-adjust: exact"));
    EXPECT_FALSE(html.contains('@' + QByteArray("text"))) << "every role has its colour";
}

TEST_F(Report, RefusesToWriteWithoutItsFont) {
    const auto path = scratch_.path() / "r.pdf";
    EXPECT_THAT(writeReport(separabilityModel(false, 3), asQString(path),
                            [](const QString& family) { return family != "DejaVu Sans"; }),
                refused(ErrorCode::Unsupported, "fonts-dejavu-core"));
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(Report, RefusesAnEndingItDoesNotKnow) {
    EXPECT_THAT(writeReport(separabilityModel(false, 3), asQString(scratch_.path() / "r.docx")),
                refused(ErrorCode::InvalidArgument, ".pdf, .html or .htm"));
}

TEST_F(Report, SaysThatAFileCannotBeWritten) {
    const auto path = scratch_.path() / "nowhere" / "r.pdf";
    EXPECT_THAT(writeReport(separabilityModel(false, 3), asQString(path)), refused(ErrorCode::Io, path.string()));
}

TEST_F(Report, LeavesAnExistingReportWholeWhenItFails) {
    const auto path = scratch_.write("r.pdf", "the old report");
    EXPECT_FALSE(writeReport(separabilityModel(false, 3), asQString(path), [](const QString&) { return false; }));
    EXPECT_EQ(contentOfFile(path), "the old report");
    // A folder in the report's place cannot be replaced; nothing else may remain next to it.
    const auto blocked = scratch_.path() / "taken" / "r.html";
    fs::create_directories(blocked);
    EXPECT_FALSE(writeReport(separabilityModel(false, 3), asQString(blocked)));
    EXPECT_TRUE(fs::is_directory(blocked));
    EXPECT_EQ(std::distance(fs::directory_iterator(blocked.parent_path()), fs::directory_iterator()), 1);
}

TEST_F(Report, ReplacesAnExistingReport) {
    const auto path = scratch_.write("r.pdf", "the old report");
    ASSERT_TRUE(writeReport(separabilityModel(false, 3), asQString(path)));
    EXPECT_TRUE(contentOfFile(path).startsWith("%PDF"));
}

TEST_F(Report, WritesAnEmptySession) {
    const auto html = contentOfFile(write(ReportModel{}, "empty.html"));
    EXPECT_TRUE(html.contains("No device took part"));
    EXPECT_TRUE(html.contains("No verdict"));
}

}  // namespace
}  // namespace tacto::test
