// Tests that any table leaves the window as it is: read again by Python's csv module.
#include <QClipboard>
#include <QFile>
#include <QFileDialog>
#include <QFormLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QMenu>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <random>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/TableText.h"
#include "app/gui/theme/Told.h"
#include "app/report/NumberText.h"
#include "tests/gui/Person.h"
#include "tests/gui/PythonCsv.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

QString clipped() { return QGuiApplication::clipboard()->text(); }

/// A table with random texts, among them all that a separated text must quote.
std::unique_ptr<QTableWidget> drawnTable(std::mt19937& random) {
    static const QStringList kPieces{"\t", "\"", "\n",   "\r\n", "\r", ",",    ";", " ",  "a", "µC", "Ω", "–",
                                     "−",  "''", "\"\"", "=1+1", "@",  "日本", "x", "\\", "#", "0",  "7"};
    const auto below = [&](int n) { return int(random() % unsigned(n)); };
    auto table = std::make_unique<QTableWidget>(below(6), 1 + below(5));
    const auto text = [&] {
        QString made;
        for (int n = below(7); n > 0; --n) made += kPieces[below(int(kPieces.size()))];
        return made;
    };
    for (int c = 0; c < table->columnCount(); ++c) {
        table->setHorizontalHeaderItem(c, new QTableWidgetItem("h" + text()));
        for (int r = 0; r < table->rowCount(); ++r)
            if (below(8) > 0) table->setItem(r, c, new QTableWidgetItem("t" + text()));
        if (below(5) == 0) table->setColumnHidden(c, true);
    }
    return table;
}

std::vector<QStringList> linesOf(const QTableWidget& table) {
    std::vector<QStringList> lines(std::size_t(table.rowCount()) + 1);
    for (int c = 0; c < table.columnCount(); ++c) {
        lines[0] << table.horizontalHeaderItem(c)->text().simplified();
        for (int r = 0; r < table.rowCount(); ++r) {
            const auto* item = table.item(r, c);
            lines[std::size_t(r) + 1] << (item == nullptr ? QString() : item->text());
        }
    }
    return lines;
}

TEST(TableText, AnyTextComesBackFromPythonsCsvReader) {
    std::mt19937 random(4901);
    std::vector<SeparatedText> texts;
    std::vector<std::vector<QStringList>> expected;
    for (int trial = 0; trial < 200; ++trial) {
        const auto table = drawnTable(random);
        for (const QChar separator : {QChar('\t'), QChar(',')}) {
            texts.push_back({separated(gui::textOf(*table), separator), separator});
            expected.push_back(linesOf(*table));
        }
    }
    const auto read = readByPython(texts);
    for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(read[i], expected[i]) << texts[i].text.toStdString();
}

TEST(TableText, KeysSelectAllAndCopyWithHeadings) {
    std::mt19937 random(4902);
    std::vector<SeparatedText> texts;
    std::vector<std::vector<QStringList>> expected;
    for (const auto mode : {QAbstractItemView::NoSelection, QAbstractItemView::SingleSelection,
                            QAbstractItemView::ExtendedSelection, QAbstractItemView::ContiguousSelection}) {
        for (int trial = 0; trial < 5; ++trial) {
            auto table = drawnTable(random);
            table->setRowCount(3);
            gui::makeReadOnly(*table);
            table->setSelectionMode(mode);
            table->show();
            QTest::keyClick(table.get(), Qt::Key_A, Qt::ControlModifier);
            EXPECT_EQ(table->selectionModel()->selectedIndexes().size(), 3 * table->columnCount());
            QTest::keyClick(table.get(), Qt::Key_C, Qt::ControlModifier);
            texts.push_back({clipped(), '\t'});
            expected.push_back(linesOf(*table));
            table->clearSelection();
            QTest::keyClick(table.get(), Qt::Key_C, Qt::ControlModifier);
            EXPECT_EQ(clipped(), texts.back().text) << "without a selection all is copied";
        }
    }
    const auto read = readByPython(texts);
    for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(read[i], expected[i]) << texts[i].text.toStdString();
}

TEST(TableText, CopiesTheRowsAndColumnsThatAreSelected) {
    QTableWidget table(3, 3);
    table.setHorizontalHeaderLabels({"a", "b", "c"});
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) gui::putText(table, r, c, QString("%1 of %2").arg(r).arg(c), false);
    table.show();
    table.setCurrentCell(1, 1);
    QTest::keyClick(&table, Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(clipped(), "1 of 1") << "one cell is a value";
    table.item(0, 0)->setSelected(true);
    QTest::keyClick(&table, Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(clipped(), "a\tb\n0 of 0\t\n\t1 of 1\n");
}

TEST(TableText, UnitsStandInHeadingsAndNumbersAreNumbers) {
    QTableWidget table(4, 6);
    table.setHorizontalHeaderLabels({"Load", "Peak\n(mA)", "Charge", "Offset", "Count", "Mixed"});
    const double coulombs[] = {1e-9, 2.5e-6, 0, 4e-3};
    for (int r = 0; r < 4; ++r) {
        gui::putText(table, r, 0, r == 0 ? "−" : "n. e.", false);
        gui::putText(table, r, 1, r == 2 ? QString("–") : QString("−%1.5").arg(r), true);
        gui::putText(table, r, 2, quantityText(coulombs[r], "C"), true);
        gui::putText(table, r, 3, quantityText(-0.001 * (r + 1), "V", 2), true);
        gui::putText(table, r, 4, QString("1\u202f00%1").arg(r), true);
        gui::putText(table, r, 5, r % 2 == 0 ? "1\u202fV" : "2\u202fs", true);
    }
    const auto text = gui::textOf(table);
    EXPECT_EQ(text.head, QStringList({"Load", "Peak (mA)", "Charge (mC)", "Offset (mV)", "Count", "Mixed"}));
    for (std::size_t r = 0; r < 4; ++r) {
        const auto& row = text.rows[r];
        EXPECT_EQ(row[1], r == 2 ? QString() : QString("-%1.5").arg(r));
        EXPECT_DOUBLE_EQ(row[2].toDouble(), 1000 * coulombs[r]) << row[2].toStdString();
        EXPECT_EQ(row[3], QString("-%1.0").arg(r + 1));
        EXPECT_EQ(row[4], QString("100%1").arg(r));
        EXPECT_EQ(row[5], r % 2 == 0 ? "1\u202fV" : "2\u202fs");
    }
}

/// Python says what a number is, and writes what OWASP's rule asks for.
std::vector<QStringList> inertByPython(const QStringList& cells) {
    QProcess python;
    python.start("python3", {"-c",
                             "import json,sys\n"
                             "def number(t):\n"
                             "  try: return t[0] in '+-' and float(t) is not None\n"
                             "  except ValueError: return False\n"
                             "print(json.dumps([(\"'\" if t[:1] in tuple('=+-@\\t\\r\\n') and not number(t) else '')"
                             "+t for t in json.load(sys.stdin)]))"});
    python.write(QJsonDocument(QJsonArray::fromStringList(cells)).toJson());
    python.closeWriteChannel();
    EXPECT_TRUE(python.waitForFinished(60'000) && python.exitCode() == 0)
        << python.readAllStandardError().toStdString();
    std::vector<QStringList> rows{{"head"}};
    for (const auto& cell : QJsonDocument::fromJson(python.readAllStandardOutput()).array())
        rows.push_back({cell.toString()});
    return rows;
}

TEST(TableText, TextsThatASpreadsheetWouldCalculateAreTextsAndNumbersStayNumbers) {
    std::mt19937 random(4904);
    static const QStringList kPieces{"=",       "+", "-",   "@",  "\t", "\r",
                                     "\n",      "1", "2.5", "e3", ".",  "cmd|' /C calc'!A0",
                                     "SUM(A1)", " ", "a",   "'",  "V",  "µ"};
    gui::TableText table{{"head"}, {}};
    QStringList cells;
    for (int trial = 0; trial < 2000; ++trial) {
        QString cell;
        for (auto n = 1 + random() % 4; n > 0; --n) cell += kPieces[int(random() % unsigned(kPieces.size()))];
        cells << cell;
        table.rows.push_back({cell});
    }
    const auto expected = inertByPython(cells);
    for (const QChar separator : {QChar('\t'), QChar(',')}) {
        const auto read = readByPython({{separated(table, separator), separator}}).front();
        ASSERT_EQ(read.size(), expected.size());
        for (std::size_t i = 0; i < read.size(); ++i)
            EXPECT_EQ(read[i], expected[i]) << read[i].join('|').toStdString() << expected[i].join('|').toStdString();
    }
}

TEST(TableText, AFormOfFactsIsCopiedWithAUnitBesideEachName) {
    QWidget window, other(&window), facts(&window);
    auto* form = new QFormLayout(&facts);
    const std::pair<QString, QString> rows[] = {{"Peak (mA)", "−1.5"},
                                                {"Charge", quantityText(2.5e-6, "C")},
                                                {"Load", "R2, =dry"},
                                                {"Note", "=1+1"},
                                                {"Accuracy", "0.93\u202f±\u202f0.02"}};
    for (const auto& [name, value] : rows) {
        auto* shown = new QLabel(value, &facts);
        shown->setTextInteractionFlags(Qt::TextSelectableByMouse);
        form->addRow(new QLabel(name, &facts), shown);
    }
    facts.setAccessibleName("Facts of a run");
    gui::copyAsTable(facts);
    window.show();
    auto* value = qobject_cast<QLabel*>(form->itemAt(1, QFormLayout::FieldRole)->widget());
    const std::vector<QStringList> expected{{"Name", "Value"},    {"Peak (mA)", "-1.5"}, {"Charge (µC)", "2.500"},
                                            {"Load", "R2, =dry"}, {"Note", "'=1+1"},     {"Accuracy", rows[4].second}};
    QTest::keyClick(value, Qt::Key_C, Qt::ControlModifier);
    auto read = readByPython({{clipped(), '\t'}}).front();
    ASSERT_EQ(read.size(), expected.size());
    EXPECT_DOUBLE_EQ(std::exchange(read[2][1], expected[2][1]).toDouble(), 2.5);
    EXPECT_EQ(read, expected);
    value->setSelection(0, 3);
    QTest::keyClick(value, Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(clipped(), value->selectedText()) << "what is selected goes first";
    const auto menuOf = [&](QWidget& at) {
        QContextMenuEvent asks(QContextMenuEvent::Mouse, QPoint(1, 1), at.mapToGlobal(QPoint(1, 1)));
        QCoreApplication::sendEvent(&at, &asks);
        return facts.findChild<QMenu*>("tableMenu");
    };
    EXPECT_EQ(menuOf(other), nullptr);
    auto* menu = menuOf(*value);
    ASSERT_NE(menu, nullptr);
    for (auto* action : menu->actions())
        if (action->text().contains("as a table")) action->trigger();
    EXPECT_EQ(readByPython({{clipped(), '\t'}}).front().size(), expected.size());
    menu->actions().back()->trigger();
    menu->close();
    auto* chooser = facts.findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(chooser, nullptr);
    EXPECT_TRUE(chooser->selectedFiles().front().endsWith("/facts-of-a-run.csv"));
    chooser->close();
}

TEST(TableText, TheMenuSavesAsCsvAndSaysWhere) {
    std::mt19937 random(4903);
    const auto table = drawnTable(random);
    table->setRowCount(3);
    gui::nameWidget(*table, "drawn", "Limits, on each load");
    table->resize(600, 300);
    table->show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(table.get()));
    QString said;
    const auto heard = QObject::connect(&gui::Told::all(), &gui::Told::said, [&](const QString& what) { said = what; });
    QContextMenuEvent asks(QContextMenuEvent::Keyboard, QPoint(5, 5), table->mapToGlobal(QPoint(5, 5)));
    QCoreApplication::sendEvent(table->viewport(), &asks);
    auto* menu = table->findChild<QMenu*>("tableMenu");
    ASSERT_NE(menu, nullptr);
    ASSERT_TRUE(menu->actions().back()->text().contains("CS&V"));
    menu->actions().back()->trigger();
    menu->close();
    auto* chooser = table->findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(chooser, nullptr);
    EXPECT_TRUE(chooser->selectedFiles().front().endsWith("/limits-on-each-load.csv"));
    const QTemporaryDir folder;
    chooser->selectFile(folder.filePath("any"));
    QMetaObject::invokeMethod(chooser, "accept");
    QFile file(folder.filePath("any.csv"));
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(readByPython({{QString::fromUtf8(file.readAll()), ','}}).front(), linesOf(*table));
    EXPECT_TRUE(said.contains(file.fileName())) << said.toStdString();
    QObject::disconnect(heard);
}

}  // namespace
}  // namespace tacto::test
