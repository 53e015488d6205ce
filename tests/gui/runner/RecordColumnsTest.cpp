// Tests the columns of a table of records: units, prefixes, words for missing values.
#include <gmock/gmock.h>

#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/Theme.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

using As = ResultColumn::As;
using Json = nlohmann::json;

TEST(RecordColumns, PutsTheUnitIntoTheHeaderWithAPrefixThatSuitsAllRows) {
    const Json rows = {{{"width_s", 100.2e-6}, {"u", 0.4e-6}}, {{"width_s", 400e-6}, {"u", 0.4e-6}}};
    const auto text = columnText({"Width", "width_s", As::Number, "s", "u"}, rows);
    EXPECT_EQ(text.header, "Width\n(µs)");
    EXPECT_EQ(text.cells, (QStringList{"100.20 ± 0.40", "400.00 ± 0.40"}));
    EXPECT_TRUE(text.right);
}

TEST(RecordColumns, GivesNumbersThatAreFarApartAPrefixEach) {
    const Json rows = {{{"ohm", 100}}, {{"ohm", 1.1e6}}};
    const auto text = columnText({"Load", "ohm", As::Number, "ohm"}, rows);
    EXPECT_EQ(text.header, "Load");
    EXPECT_THAT(text.cells[0].toStdString(), HasSubstr("Ω"));
    EXPECT_THAT(text.cells[1].toStdString(), HasSubstr("MΩ"));
}

TEST(RecordColumns, GroupsTheDigitsOfLongNumbers) {
    const auto cells =
        columnText({"Samples", "n", As::Number}, Json{{{"n", 1227441}}, {{"n", 9120}}, {{"n", 12000.25}}}).cells;
    EXPECT_EQ(cells[0], "1\u202f227\u202f441");
    EXPECT_EQ(cells[1], "9120");
    EXPECT_THAT(cells[2].toStdString(), testing::StartsWith("12\u202f000"));
}

TEST(RecordColumns, HasOnePrefixInAColumnUpToAFactorOfTenThousand) {
    const Json rows = {{{"v", 40.12}}, {{"v", 0.0125}}, {{"v", 0.3}}};
    const auto text = columnText({"Level", "v", As::Number, "V"}, rows);
    EXPECT_EQ(text.header, "Level\n(V)");
    for (const auto& cell : text.cells) EXPECT_FALSE(cell.contains("V")) << cell.toStdString();
    EXPECT_EQ(text.cells[1], "0.01250");
}

TEST(RecordColumns, KnowsStatisticsSharesVerdictsAndWhatIsMissing) {
    RecordProperty("hazard", "H9");
    const Json rows = {{{"v", {{"mean", 40.12}, {"sd", 0.46}}},
                        {"share", {{"value", 0.99}, {"low", 0.946}, {"high", 0.998}}},
                        {"verdict", "not evaluated"},
                        {"load", "200 ohm + 10 kohm || 50 nF"},
                        {"set", "fda-pms"},
                        {"offset", 80.1807e-6},
                        {"gain", 0.5},
                        {"flag", true},
                        {"reason", "off by -0.3 ± 1.2 % into 500 ohm"}}};
    const auto cell = [&](const ResultColumn& column) { return columnText(column, rows).cells.first().toStdString(); };
    EXPECT_EQ(cell({"V", "v", As::Number, "V"}), "40.12, s.d. 0.46") << "± is kept for uncertainties";
    EXPECT_THAT(cell({"S", "share", As::Share}), HasSubstr("94.6"));
    EXPECT_EQ(cell({"V", "verdict", As::Verdict}), "○ not evaluated");
    EXPECT_EQ(cell({"V", "flag", As::Verdict}), "✔ pass");
    EXPECT_EQ(columnText({"V", "passed", As::Verdict}, Json{{{"passed", false}}}).cells, QStringList{"✖ fail"});
    EXPECT_EQ(cell({"L", "load", As::Load}), "200\u00a0Ω + 10\u00a0kΩ ∥ 50\u00a0nF");
    EXPECT_EQ(cell({"S", "set", As::LimitSet}), "FDA guidance");
    EXPECT_EQ(cell({"R", "reason", As::Text}), "off by −0.3 ± 1.2 % into 500\u202fΩ");
    EXPECT_EQ(limitSetTitle("gate"), "this program");
    EXPECT_EQ(cell({"T", "offset", As::Tolerance, "A"}), "80\u202fµA") << "two digits of 80.1807 µA";
    EXPECT_EQ(cell({"T", "gain", As::Tolerance, "%"}), "0.5\u202f%");
    EXPECT_EQ(cell({"T", "none", As::Tolerance, "%"}), "–");
    EXPECT_EQ(cell({"F", "flag", As::YesNo}), "yes");
    for (const auto as : {As::Number, As::Share, As::Verdict, As::Text}) EXPECT_EQ(cell({"M", "a.b", as}), "–");
    const auto unknown = columnText({"V", "value", As::Number, "V", "u"}, Json{{{"value", 1.5}, {"u", nullptr}}});
    EXPECT_THAT(unknown.cells.first().toStdString(), HasSubstr("U unknown"));
}

TEST(RecordColumns, HaveNoMoreDigitsThanAreKnown) {
    const Json rows = {{{"s", 580.6e-6}, {"used", 0.317}, {"d", {{"value", 273.9}, {"low", 143.0}, {"high", 405.5}}}},
                       {{"s", 1.2345e-3}, {"used", 1.0531}, {"d", {{"value", 1}, {"low", 0.6317}, {"high", 1}}}}};
    const auto spreads = columnText({"s", "s", As::Spread, "V"}, rows);
    EXPECT_EQ(spreads.header, "s\n(mV)");
    EXPECT_EQ(spreads.cells, (QStringList{"0.58", "1.2"}));
    EXPECT_EQ(columnText({"s", "s", As::Spread, "V"}, Json::array({rows[0]})).cells, QStringList{"580"});
    const auto used = columnText({"Used", "used", As::Used}, rows);
    EXPECT_EQ(used.cells, (QStringList{"32\u202f%", "105\u202f%"}));
    EXPECT_TRUE(used.right);
    EXPECT_EQ(columnText({"Used", "none", As::Used}, Json::array({rows[0]})).cells, QStringList{"–"});
    EXPECT_EQ(columnText({"d′", "d", As::Number}, rows).cells,
              (QStringList{"270 (140 to 410)", "1.00 (0.63 to 1.00)"}));
}

TEST(RecordColumns, ANumberIsNeverCutAndWordsGiveWayFirst) {
    RecordProperty("hazard", "H9");
    gui::applyTheme(gui::Theme::Light);
    std::vector<ResultColumn> columns{{"Condition", "words", As::Text}, {"Load", "words", As::Text}};
    Json row{{"words", "a surface of many words that go on for longer than any column has room"},
             {"many", {{"value", 123456.7}, {"low", 123456.6}, {"high", 123456.8}}},
             {"far", {{"value", 1e-6}, {"low", 0.999999e-6}, {"high", 1.000001e-6}}}};
    columns.push_back({"Far", "many", As::Number, "ohm"});  // longer than a text column may be
    for (int i = 0; i < 2; ++i) {
        row["v" + std::to_string(i)] = {{"mean", 40.12}, {"sd", 0.46}};
        columns.push_back({"Amplitude as measured", "v" + std::to_string(i), As::Number, "V"});
    }
    columns.push_back({"Note", "words", As::Text});
    auto far = row;
    far["many"] = row["far"];
    QWidget page;
    const auto* table = gui::makeRecordTable(columns, Json{row, far}, &page);
    int width = 2 * table->frameWidth();
    for (int c = 0; c < table->columnCount(); ++c) {
        width += table->columnWidth(c);
        for (int r = 0; r < table->rowCount(); ++r) {
            const auto* cell = table->item(r, c);
            const int needs = table->fontMetrics().horizontalAdvance(cell->text());
            const bool number = (cell->textAlignment() & Qt::AlignRight) != 0;
            const bool fits = table->columnWidth(c) >= needs;
            EXPECT_TRUE(fits || !number) << cell->text().toStdString();
            EXPECT_TRUE(fits || cell->toolTip() == cell->text()) << "the tip has the whole text";
        }
    }
    EXPECT_LE(width, 860) << "beside a path in a window of 1280";
}

}  // namespace
}  // namespace tacto::test
