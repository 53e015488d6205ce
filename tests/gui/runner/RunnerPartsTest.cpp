// Parts of the runner by themselves: time left, devices as text, columns of tables, reports by a child process.
#include <QElapsedTimer>
#include <QMenu>
#include <QPainter>
#include <QPdfDocument>
#include <QPdfWriter>
#include <QPrinterInfo>
#include <QTemporaryDir>
#include <gmock/gmock.h>

#include "app/gui/runner/ParameterForm.h"
#include "app/gui/runner/ReportMaker.h"
#include "app/gui/runner/ReportPrinter.h"
#include "app/gui/runner/RunPanel.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/runner/WorstCase.h"
#include "app/gui/theme/RecordTable.h"
#include "app/report/TableContent.h"
#include "tests/gui/runner/Lab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

ScriptProgress at(std::size_t done, std::size_t total = 10) { return {"Steps", done, total}; }

TEST(TimeLeft, IsNotKnownBeforeAStepIsThrough) {
    gui::TimeLeft left;
    left.note(at(0), false, 5);
    EXPECT_FALSE(left.seconds());
    left.note(at(0), false, 7);
    EXPECT_FALSE(left.seconds());
}

TEST(TimeLeft, CountsNeitherWhatCameBeforeTheFirstStepNorPauses) {
    gui::TimeLeft left;
    left.note(at(0), false, 100);
    left.note(at(1), false, 102);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 18);
    left.note(at(1), true, 160);
    left.note(at(2), false, 162);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 16);
    left.note(at(2), false, 163);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 15) << "the step under way has had a second";
}

TEST(TimeLeft, BeginsAnewWithAnotherList) {
    gui::TimeLeft left;
    left.note(at(0), false, 0);
    left.note(at(5), false, 5);
    left.note({"Others", 0, 4}, false, 6);
    EXPECT_FALSE(left.seconds());
}

TEST(DevicesOf, AllowsBlanksInAFolder) {
    const auto uris = gui::devicesOf(" recording:/data/my finger sim:stimulator?gain=1.1  sim: ").value();
    ASSERT_EQ(uris.size(), 3U);
    EXPECT_EQ(uris[0].text(), "recording:/data/my finger");
    EXPECT_EQ(uris[1].text(), "sim:stimulator?gain=1.1");
    EXPECT_FALSE(gui::devicesOf("nonsense"));
}

using gui::columnText;
using gui::RecordColumn;
using As = RecordColumn::As;
using Json = nlohmann::json;

/// The form shows less of it than the script wrote, and what it shows reads as another value.
TEST(ParameterForm, ADefaultThatWasLeftAloneIsTheScriptsWordToTheLastDigitAndBlank) {
    RecordProperty("hazard", "H9");
    ProtocolDeclaration declaration;
    ProtocolParameter area;
    area.name = area.label = "area";
    area.value = 4.00000000001;
    ProtocolParameter file;
    file.name = file.label = "file";
    file.type = ParameterType::File;
    file.value = "/some/path ";
    declaration.parameters = {area, file};
    gui::ParameterForm form;
    form.show(declaration);
    const auto untouched = form.read().value();
    EXPECT_TRUE(untouched.given.empty());
    EXPECT_EQ(untouched.parameters.at("area"), area.value);
    EXPECT_EQ(untouched.parameters.at("file"), file.value);
    form.set("area", "5");
    form.set("file", "/another");
    const auto chosen = form.read().value();
    EXPECT_EQ(chosen.given, (std::set<std::string>{"area", "file"}));
    EXPECT_EQ(chosen.parameters.at("area"), 5);
}

TEST(RecordTable, PutsTheUnitIntoTheHeaderWithAPrefixThatSuitsAllRows) {
    const Json rows = {{{"width_s", 100.2e-6}, {"u", 0.4e-6}}, {{"width_s", 400e-6}, {"u", 0.4e-6}}};
    const auto text = columnText({"Width", "width_s", As::Number, "s", "u"}, rows);
    EXPECT_EQ(text.header, "Width\n(µs)");
    EXPECT_EQ(text.cells, (QStringList{"100.20 ± 0.40", "400.00 ± 0.40"}));
    EXPECT_TRUE(text.right);
}

TEST(RecordTable, GivesNumbersThatAreFarApartAPrefixEach) {
    const Json rows = {{{"ohm", 100}}, {{"ohm", 1e6}}};
    const auto text = columnText({"Load", "ohm", As::Number, "ohm"}, rows);
    EXPECT_EQ(text.header, "Load");
    EXPECT_THAT(text.cells[0].toStdString(), HasSubstr("Ω"));
    EXPECT_THAT(text.cells[1].toStdString(), HasSubstr("MΩ"));
}

TEST(RecordTable, KnowsStatisticsSharesVerdictsAndWhatIsMissing) {
    RecordProperty("hazard", "H9");
    const Json rows = {{{"v", {{"mean", 40.12}, {"sd", 0.46}}},
                        {"share", {{"value", 0.99}, {"low", 0.946}, {"high", 0.998}}},
                        {"verdict", "not evaluated"},
                        {"load", "200 ohm + 10 kohm || 50 nF"},
                        {"set", "fda-pms"},
                        {"offset", 80.1807e-6},
                        {"gain", 0.5},
                        {"flag", true}}};
    const auto cell = [&](const RecordColumn& column) { return columnText(column, rows).cells.first().toStdString(); };
    EXPECT_EQ(cell({"V", "v", As::Number, "V"}), "40.12 ± 0.46");
    EXPECT_THAT(cell({"S", "share", As::Share}), HasSubstr("94.6"));
    EXPECT_EQ(cell({"V", "verdict", As::Verdict}), "○ not evaluated");
    EXPECT_EQ(cell({"L", "load", As::Load}), "200\u00a0Ω + 10\u00a0kΩ ∥ 50\u00a0nF");
    EXPECT_EQ(cell({"S", "set", As::LimitSet}), "FDA guidance");
    EXPECT_EQ(limitSetTitle("gate"), "this program");
    EXPECT_EQ(cell({"T", "offset", As::Tolerance, "A"}), "80\u202fµA") << "two digits of 80.1807 µA";
    EXPECT_EQ(cell({"T", "gain", As::Tolerance, "%"}), "0.5\u202f%");
    EXPECT_EQ(cell({"T", "none", As::Tolerance, "%"}), "–");
    EXPECT_EQ(cell({"F", "flag", As::YesNo}), "yes");
    for (const auto as : {As::Number, As::Share, As::Verdict, As::Text}) EXPECT_EQ(cell({"M", "a.b", as}), "–");
    const auto unknown = columnText({"V", "value", As::Number, "V", "u"}, Json{{{"value", 1.5}, {"u", nullptr}}});
    EXPECT_THAT(unknown.cells.first().toStdString(), HasSubstr("U unknown"));
}

TEST(WorstCase, NamesTheLimitThatIsBrokenAndIsQuickEnoughForTheWindow) {
    const auto profile = shippedProfile().value();
    const auto limits = shippedLimits().value();
    QElapsedTimer timer;
    timer.start();
    const auto kept = gui::worstCase(profile, limits.sets, "1000 ohm").value();
    EXPECT_IN_TIME(timer.elapsed() < 100) << "it is worked out on the window's thread";
    EXPECT_TRUE(kept.refused.isEmpty()) << kept.refused.toStdString();
    EXPECT_GT(kept.rows.size(), 5U);
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "10 ohm").value().refused.isEmpty());
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "nonsense"));
    RecordProperty("microseconds", int(timer.nsecsElapsed() / 3000));
}

TEST(ReportMaker, TellsWhyThereIsNoReport) {
    gui::ReportMaker maker;
    QString why;
    QObject::connect(&maker, &gui::ReportMaker::failed, [&](const QString& said) { why = said; });
    maker.make("/nowhere/at/all.tacto", "/tmp/never.pdf");
    EXPECT_TRUE(maker.busy());
    ASSERT_IN_TIME(comesTrue([&] { return !why.isEmpty(); }, 30'000));
    EXPECT_THAT(why.toStdString(), HasSubstr("/nowhere/at/all.tacto"));
    EXPECT_FALSE(maker.busy());
}

TEST(ReportMaker, CancelEndsItAndSaysSo) {
    gui::ReportMaker maker;
    QStringList said;
    QObject::connect(&maker, &gui::ReportMaker::failed, [&](const QString& why) { said << why; });
    const QTemporaryDir folder;
    const auto half = folder.filePath("never.pdf.AbCdEf");
    std::ofstream(half.toStdString()) << "half a report";
    maker.make("/nowhere/at/all.tacto", folder.filePath("never.pdf"));
    maker.make("/nowhere/at/all.tacto", folder.filePath("never.html"));
    maker.cancel();
    EXPECT_FALSE(QFileInfo::exists(half));
    EXPECT_FALSE(maker.busy());
    ASSERT_EQ(said.size(), 1);
    EXPECT_THAT(said.first().toStdString(), HasSubstr("cancelled"));
}

class Printing : public testing::Test {
protected:
    Printing() {
        QPdfWriter writer(pdf);
        writer.setPageSize(QPageSize(QPageSize::A4));
        QPainter painter(&writer);
        for (int page = 1; page <= 3; ++page) {
            if (page > 1) writer.newPage();
            // Each has its mark at another height.
            painter.fillRect(QRect(0, page * writer.height() / 5, writer.width(), writer.height() / 20), Qt::black);
        }
    }
    void expectInk(const QString& file, int page, int marked) {
        QPdfDocument document;
        document.load(file);
        const auto picture = document.render(page, QSize(210, 297));
        QImage ground(picture.size(), QImage::Format_RGB32);
        ground.fill(Qt::white);
        QPainter(&ground).drawImage(0, 0, picture);
        QImage original(ground.size(), QImage::Format_RGB32);
        original.fill(Qt::white);
        QPdfDocument source;
        source.load(pdf);
        QPainter(&original).drawImage(0, 0, source.render(marked, ground.size()));
        for (int y = 4; y < 293; ++y) {
            const bool same = qAbs(qGray(ground.pixel(105, y)) - qGray(original.pixel(105, y))) < 128 ||
                              qAbs(qGray(ground.pixel(105, y)) - qGray(original.pixel(105, y - 2))) < 128 ||
                              qAbs(qGray(ground.pixel(105, y)) - qGray(original.pixel(105, y + 2))) < 128;
            ASSERT_TRUE(same) << "row " << y << " of page " << page;
        }
    }
    QTemporaryDir folder;
    const QString pdf = folder.filePath("report.pdf"), out = folder.filePath("printed.pdf");
    gui::ReportPrinter printing;
};

TEST_F(Printing, PrintsThePagesThatWereChosenWhereTheyAreInTheReport) {
    auto printer = std::make_shared<QPrinter>(QPrinter::HighResolution);
    printer->setPageSize(QPageSize(QPageSize::A4));
    printer->setOutputFileName(out);
    printer->setPrintRange(QPrinter::PageRange);
    printer->setFromTo(2, 3);
    std::optional<int> pages;
    QStringList said;
    QObject::connect(&printing, &gui::ReportPrinter::ended, [&](int count) { pages = count; });
    QObject::connect(&printing, &gui::ReportPrinter::said, [&](const QString& what) { said << what; });
    printing.print(pdf, std::move(printer));
    ASSERT_IN_TIME(comesTrue([&] { return pages.has_value(); }));
    EXPECT_EQ(*pages, 2);
    EXPECT_EQ(said.join('|').toStdString(), "Printing page 1 of 2…|Printing page 2 of 2…|2 pages went to the printer.");
    QPdfDocument printed;
    printed.load(out);
    ASSERT_EQ(printed.pageCount(), 2);
    EXPECT_NEAR(printed.pagePointSize(0).width(), 595, 1);
    EXPECT_NEAR(printed.pagePointSize(0).height(), 842, 1);
    expectInk(out, 0, 1);
    expectInk(out, 1, 2);
}

TEST_F(Printing, SaysWhyNothingIsPrinted) {
    std::optional<int> pages;
    QStringList said;
    QObject::connect(&printing, &gui::ReportPrinter::ended, [&](int count) { pages = count; });
    QObject::connect(&printing, &gui::ReportPrinter::said, [&](const QString& what) { said << what; });
    auto printer = std::make_shared<QPrinter>();
    printer->setOutputFileName(out);
    printing.print(folder.filePath("gone.pdf"), printer);
    ASSERT_IN_TIME(comesTrue([&] { return pages.has_value(); }));
    EXPECT_EQ(*pages, 0);
    EXPECT_THAT(said.join('|').toStdString(), HasSubstr("gone.pdf cannot be read, so nothing was printed."));
    EXPECT_FALSE(QFile::exists(out));
    pages.reset();
    printer->setOutputFileName(folder.filePath("no/such/folder.pdf"));
    printing.print(pdf, printer);
    ASSERT_IN_TIME(comesTrue([&] { return pages.has_value(); }));
    EXPECT_EQ(*pages, 0);
    EXPECT_THAT(said.last().toStdString(), HasSubstr("takes no pages, so nothing was printed."));
}

TEST_F(Printing, OffersThePrintersOfTheComputerOrSaysThatThereIsNone) {
    QMenu menu;
    printing.offer(menu, pdf);
    const auto printers = QPrinterInfo::availablePrinterNames();
    ASSERT_EQ(menu.actions().size(), std::max<qsizetype>(printers.size(), 1));
    EXPECT_EQ(menu.actions().first()->isEnabled(), !printers.isEmpty());
    EXPECT_EQ(menu.actions().first()->text(),
              printers.isEmpty() ? "No printer is set up on this computer." : printers.first());
}

}  // namespace
}  // namespace tacto::test
