// Tests the pages of a session and of a comparison, in a small window and with large text: no text is cut off, nothing
// overlaps, and no page scrolls sideways.
#include <QComboBox>
#include <QTabWidget>
#include <QTableView>
#include <QTableWidget>
#include <gmock/gmock.h>
#include <qcustomplot.h>

#include "app/gui/runner/StepButton.h"
#include "app/gui/sessions/CompareWindow.h"
#include "app/gui/sessions/SessionDetails.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/OwnDataHome.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

class LayoutOfSessions : private OwnDataHome, public Window {
protected:
    void run() {
        visit(3);
        runsToItsEnd();
    }
    void choose(int row, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        auto& table = *window.findChild<QTableView*>("sessionsTable");
        ASSERT_IN_TIME(comesTrue([&] { return table.model()->rowCount() > row; }));
        QTest::mouseClick(table.viewport(), Qt::LeftButton, modifiers,
                          table.visualRect(table.model()->index(row, 0)).center());
    }
    /// Shows each page in both themes and text sizes; `frame` has the size that a small screen allows.
    void walk(QTabWidget* pages, QWidget& frame, const QSize& size, const QString& name) {
        for (const int percent : {100, 200}) {
            gui::applyTextSize(percent);
            for (const auto theme : themesAt(percent)) {
                gui::applyTheme(theme);
                frame.resize(size);
                for (int page = 0; page < (pages != nullptr ? pages->count() : 1); ++page) {
                    if (pages != nullptr) pages->setCurrentIndex(page);
                    const auto of = pages != nullptr ? pages->tabText(page).remove('&').section(' ', 0, 0) : QString();
                    const auto at = QString("%1-%2-%3-%4")
                                        .arg(name, of.toLower(), theme == gui::Theme::Dark ? "dark" : "light")
                                        .arg(percent);
                    EXPECT_IN_TIME(comesTrue([&] { return faultsOf(frame).empty(); }))
                        << faultsOf(frame) << ", " << at.toStdString();
                    shot(frame, at);
                    if (pages != nullptr) shot(*pages, at + "-whole");  // a scrolled page shows only a part
                    EXPECT_LE(frame.width(), size.width()) << at.toStdString();
                    EXPECT_LE(frame.height(), size.height()) << at.toStdString();
                }
            }
        }
    }
    [[nodiscard]] gui::SessionDetails& details() { return *window.findChild<gui::SessionDetails*>(); }
    [[nodiscard]] QTableWidget& tableOf(const char* name) { return *find<QTableWidget>(details(), name); }
};

TEST_F(LayoutOfSessions, EachPageOfARunIsReadWhole) {
    ASSERT_NO_FATAL_FAILURE(run());
    visit(5);
    ASSERT_NO_FATAL_FAILURE(choose(0));
    const auto tables = details().findChildren<QTableWidget*>();
    const auto filled = [&] {
        return std::ranges::all_of(tables, [](const auto* table) { return table->rowCount() > 0; });
    };
    ASSERT_IN_TIME(comesTrue(filled)) << "trials, streams and captures";
    ASSERT_NO_FATAL_FAILURE(walk(&details(), window, {1280, 720}, "session-run"));
}

TEST_F(LayoutOfSessions, TheComparisonOfTwoIsReadWhole) {
    ASSERT_NO_FATAL_FAILURE(run());
    click(*find<gui::StepButton>(window, "Settings"));
    for (const auto& [field, value] : {std::pair("repeats", "12"), std::pair("load", "2200")}) {
        auto* line = find<QLineEdit>(window, field);
        ASSERT_NE(line, nullptr) << field;
        line->setText(value);
    }
    ASSERT_NO_FATAL_FAILURE(run());
    window.resize(1280, 720);
    visit(5);
    ASSERT_NO_FATAL_FAILURE(choose(0));
    ASSERT_NO_FATAL_FAILURE(choose(1, Qt::ControlModifier));
    auto* compare = find<QPushButton>(window, "Compare two");
    ASSERT_NE(compare, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return compare->isEnabled(); }));
    shot(window, "two-chosen");
    EXPECT_EQ(faultsOf(window), "");
    click(*compare);
    gui::CompareWindow* both = nullptr;
    ASSERT_IN_TIME(comesTrue([&] {
        both = window.findChild<gui::CompareWindow*>();
        return both != nullptr && both->isVisible();
    }));
    const auto* plot = both->findChild<QCustomPlot*>("both");
    auto* which = both->findChild<QComboBox*>("drawn");
    ASSERT_IN_TIME(comesTrue([&] { return plot->graphCount() >= 2; })) << "what the oscilloscope captured of both";
    ASSERT_NO_FATAL_FAILURE(walk(nullptr, *both, {1200, 560}, "compare"));  // as below a small screen's safety bar
    for (int each = 0; each < which->count(); ++each) {
        which->setCurrentIndex(each);
        EXPECT_IN_TIME(comesTrue([&] { return plot->graphCount() >= 2; })) << which->currentText().toStdString();
        EXPECT_LE(plot->legend->itemCount(), 3) << "A, B and their difference";
    }
    int settings = 0, quantities = 0;
    for (const auto* compared : both->findChildren<QTableWidget*>())
        (compared->columnCount() == 3 ? settings : quantities) += compared->rowCount();
    EXPECT_GE(settings, 2) << "repeats and load";
    EXPECT_GT(quantities, 20);
    both->close();
}

}  // namespace
}  // namespace tacto::test
