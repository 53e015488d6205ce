// Tests printing a report: the chosen pages, or why there are none.
#include <QMenu>
#include <QPainter>
#include <QPdfDocument>
#include <QPdfWriter>
#include <QPrinterInfo>
#include <QTemporaryDir>
#include <gmock/gmock.h>

#include "app/gui/runner/ReportPrinter.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Printing : public testing::Test {
protected:
    Printing() {
        QPdfWriter writer(pdf);
        writer.setPageSize(QPageSize(QPageSize::A4));
        QPainter painter(&writer);
        for (int page = 1; page <= 3; ++page) {
            if (page > 1) writer.newPage();
            // The mark has a different height on each page.
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
