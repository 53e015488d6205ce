// Tests that every table of the window can be selected, copied and saved.
#include <QClipboard>
#include <QGuiApplication>
#include <QMenu>
#include <QTableView>
#include <QTest>

#include "app/gui/calibrate/CertificateDialog.h"
#include "app/gui/theme/LimitSetView.h"
#include "app/gui/window/Workspaces.h"
#include "tests/gui/PythonCsv.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

/// The digits of a number without the zeros that a prefix moves; a text without digits as it is.
QString bareDigits(const QString& text) {
    static const QRegularExpression other("[^0-9]"), outer("^0+|0+$");
    const auto digits = text.section('e', 0, 0).remove(other);
    return digits.isEmpty() ? text : QString(digits).remove(outer);
}

class Tables : public Window {
protected:
    /// Every table that exists now, also in dialogs and on pages that are not in sight.
    static std::vector<QTableView*> all() {
        std::vector<QTableView*> found;
        for (auto* widget : QApplication::allWidgets())
            if (auto* table = qobject_cast<QTableView*>(widget))
                if (!table->parentWidget()->inherits("QCalendarWidget")) found.push_back(table);
        return found;
    }
    static void expectCopied(const QTableView& table, const std::vector<QStringList>& lines) {
        const auto& model = *table.model();
        const auto name = widgetName(table);
        ASSERT_EQ(int(lines.size()), model.rowCount() + 1) << name;
        for (const auto& line : lines) ASSERT_EQ(line.size(), model.columnCount()) << name;
        for (int c = 0; c < model.columnCount(); ++c) {
            const auto heading = model.headerData(c, Qt::Horizontal).toString().simplified();
            // The matrix abbreviates the names of long loads.
            EXPECT_TRUE(lines[0][c].contains(heading) || table.objectName() == "limitMatrix")
                << name << ": " << heading.toStdString();
            EXPECT_FALSE(lines[0][c].isEmpty()) << name << ": column " << c << " has a heading";
            for (int r = 0; r < model.rowCount(); ++r) {
                const auto shown = model.index(r, c).data().toString(), copied = lines[std::size_t(r) + 1][c];
                EXPECT_TRUE(copied.contains(shown) || (shown == "–" && copied.isEmpty()) ||
                            bareDigits(copied) == bareDigits(shown))
                    << name << ": " << shown.toStdString() << " was copied as " << copied.toStdString();
            }
        }
    }
};

TEST_F(Tables, OfEveryWorkspaceAndDialogAreSelectedCopiedAndSaved) {
    open();
    for (int page = 0; page < 7; ++page) visit(page);
    visit(gui::Workspaces::kSafetyCheck);
    find<QLineEdit>(window, "area")->setText("4");
    ASSERT_NO_FATAL_FAILURE(runsToItsEnd());
    visit(gui::Workspaces::kSessions);
    const auto* sessions = window.findChild<QTableView*>("sessionsTable");
    ASSERT_IN_TIME(comesTrue([&] { return sessions->model()->rowCount() > 0; }));
    auto* certificates = new gui::CertificateDialog(window.controller(), &window);
    certificates->show();
    auto* limits = gui::makeLimitSetWindow(window.controller().limits().sets, {}, &window);
    limits->show();
    letLive(100);

    std::vector<QTableView*> copied;
    std::vector<SeparatedText> texts;
    std::set<QString> names;
    for (auto* table : all()) {
        table->ensurePolished();
        names.insert(table->objectName());
        QTest::keyClick(table, Qt::Key_A, Qt::ControlModifier);
        EXPECT_EQ(table->selectionModel()->selectedIndexes().size(),
                  table->model()->rowCount() * table->model()->columnCount())
            << widgetName(*table);
        QGuiApplication::clipboard()->clear();
        QTest::keyClick(table, Qt::Key_C, Qt::ControlModifier);
        QContextMenuEvent asks(QContextMenuEvent::Keyboard, QPoint(1, 1), table->mapToGlobal(QPoint(1, 1)));
        QCoreApplication::sendEvent(table->viewport(), &asks);
        auto* menu = table->findChild<QMenu*>("tableMenu");
        ASSERT_NE(menu, nullptr) << widgetName(*table);
        EXPECT_EQ(menu->actions().size(), 4) << "Copy, Select all, a line, Save as CSV…";
        menu->close();
        if (table->model()->columnCount() == 0 || table->model()->rowCount() * table->model()->columnCount() == 1)
            continue;
        copied.push_back(table);
        texts.push_back({QGuiApplication::clipboard()->text(), '\t'});
    }
    const auto read = readByPython(texts);
    for (std::size_t i = 0; i < copied.size(); ++i) expectCopied(*copied[i], read[i]);
    for (const auto* name : {"loadRows", "limitMatrix", "measurements", "calibrationHistory", "sessionsTable",
                             "streamsTable", "certificates", "limitRows"})
        EXPECT_TRUE(names.contains(name)) << name;
    certificates->close();
    limits->close();
}

}  // namespace
}  // namespace tacto::test
