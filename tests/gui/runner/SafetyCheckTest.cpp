// Tests the safety check in its workspace: the electrode's area first, a row per load with its verdict, limits x loads.
#include <QClipboard>
#include <QComboBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QScrollArea>
#include <QScrollBar>
#include <QTemporaryDir>
#include <QToolButton>
#include <gmock/gmock.h>

#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/DisclosedPanel.h"
#include "app/gui/runner/LimitMatrixView.h"
#include "app/gui/runner/LoadRows.h"
#include "app/gui/theme/Theme.h"
#include "core/bench/Profile.h"
#include "core/session/SessionReader.h"
#include "tests/gui/Person.h"
#include "tests/gui/runner/Lab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class SafetyCheck : public Lab {
protected:
    /// Saves the shown picture with tool and dialog, and returns the content of the file.
    std::string savedPicture(const QString& path) {
        click(the<QToolButton>("Save picture"));
        auto* dialog = workspace->findChild<QFileDialog*>("fileChooser");
        EXPECT_NE(dialog, nullptr);
        if (dialog == nullptr) return {};
        dialog->findChild<QLineEdit*>("fileNameEdit")->setText(path);
        static_cast<QDialog*>(dialog)->accept();
        QFile file(path);
        EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << path.toStdString();
        return QString::fromUtf8(file.readAll()).replace("&quot;", "\"").toStdString();
    }
    std::string verdictOf(const char* load) { return the<gui::LoadRows>("loadRows").verdictOf(load).toStdString(); }
};

TEST_F(SafetyCheck, LoadsAreRowsThatTurnToVerdictsAndAMatrixOfLimits) {
    open("load-safety", {1150, 760});
    type("area", "3");
    QTest::keyClicks(the<QComboBox>("electrode").lineEdit(), "TENS 40");
    type("steps", "2");
    ASSERT_IN_TIME(ready());
    shot(*workspace, "safety_before");
    click(the<QPushButton>("runButton"));
    EXPECT_EQ(the<gui::LoadRows>("loadRows").rowCount(), 9);
    ASSERT_IN_TIME(ends());
    EXPECT_THAT(says("verdict").toStdString(), HasSubstr("PASS"));
    const auto session = SessionReader::open(ended->result.session);
    ASSERT_TRUE(session) << session.error().message;
    const auto profile = parseProfile(session->about().profileJson, "the session");
    ASSERT_TRUE(profile && profile->electrode);
    EXPECT_EQ(profile->electrode->name, "TENS 40") << "the session names the electrode";
    click(step("Run"));
    for (const char* load : {"100 ohm", "500 ohm", "100 kohm", "open", "short", "200 ohm + 10 kohm || 50 nF"})
        EXPECT_THAT(verdictOf(load), HasSubstr("pass")) << load;
    click(step("Result"));
    auto& matrix = the<gui::LimitMatrixView>("limitMatrix");
    EXPECT_EQ(find<gui::LoadRows>(*workspace, "loadRows"), nullptr);
    EXPECT_GE(matrix.rowCount(), 10);
    EXPECT_GE(matrix.columnCount(), 9);
    EXPECT_GE(matrix.height(), 300);
    EXPECT_IN_TIME(comesTrue([&] { return matrix.horizontalHeader()->length() <= matrix.viewport()->width(); }))
        << matrix.horizontalHeader()->length() << " of " << matrix.viewport()->width();
    const auto trips = matrix.findItems("Output ends by itself", Qt::MatchExactly);
    ASSERT_EQ(trips.size(), 1);
    EXPECT_THAT(trips.first()->toolTip().toStdString(), HasSubstr("before the next train"));
    int judged = 0, endsItself = 0;
    for (int row = 0; row < matrix.rowCount(); ++row) {
        for (int column = 1; column < matrix.columnCount(); ++column) {
            const auto* cell = matrix.item(row, column);
            ASSERT_NE(cell, nullptr);
            EXPECT_FALSE(cell->text().isEmpty());
            EXPECT_FALSE(cell->toolTip().contains('_')) << cell->toolTip().toStdString();
            judged += cell->text().startsWith("✔") ? 1 : 0;
            const bool ends = row == trips.first()->row() && cell->text().startsWith("✔");
            endsItself += ends && cell->text().endsWith("%") && cell->toolTip().contains("the train that found it");
        }
    }
    EXPECT_GT(judged, 50);
    EXPECT_EQ(endsItself, 2) << "on an open and on a short circuit";
    EXPECT_THAT(primaries(), testing::ElementsAre("Sign report…"));
    shot(*workspace, "safety_result");
    // A picture contains all limits, also those scrolled out of sight, and names its content.
    click(the<QToolButton>("Copy picture"));
    EXPECT_GT(QGuiApplication::clipboard()->image().height(), 2 * matrix.heightOf(matrix.rowCount()));
    if (const auto shots = qEnvironmentVariable("TACTO_SHOTS"); !shots.isEmpty())
        QGuiApplication::clipboard()->image().save(shots + "/safety_picture.png");
    const QTemporaryDir folder;
    const auto drawing = savedPicture(folder.filePath("limits.svg"));
    for (const auto* said : {"Resistor-load safety check · PASS · simulated", "checks on 9 loads passed", "SIM-1",
                             " UTC", "Share of each limit used"})
        EXPECT_THAT(drawing, HasSubstr(said));
    for (int row = 0; row < matrix.rowCount(); ++row)
        EXPECT_THAT(drawing, HasSubstr(matrix.item(row, 0)->text().toStdString()));
    EXPECT_THAT(drawing, testing::Not(HasSubstr("<image x=\"0\" y=\"0\""))) << "a drawing";
    int alone = 0;
    QObject::connect(workspace.get(), &gui::ProtocolWorkspace::plotOnlyWanted, [&] { ++alone; });
    click(the<QToolButton>("Plot only"));
    EXPECT_EQ(alone, 1);
    workspace->resize(1150, 560);
    EXPECT_IN_TIME(comesTrue([&] { return find<QPushButton>(*workspace, "Tracing") != nullptr; }))
        << "of its own: the limits have the page";
    // Where there is room for eight limits it is below them, and the outputs are next to it if the window is wide
    // enough.
    workspace->resize(1340, 760);
    EXPECT_IN_TIME(comesTrue([&] { return find<QWidget>(*workspace, "disclosedOutputs") != nullptr; }));
    EXPECT_GE(matrix.height(), matrix.heightOf(8));
    EXPECT_NE(find<QWidget>(*workspace, "How to read a cell"), nullptr)
        << "limits, legend, tracing and outputs at once";
    EXPECT_TRUE(workspace->findChild<gui::DisclosedPanel*>()->tracing().isVisible());
    EXPECT_FALSE(the<QScrollArea>("disclosedOutputs")
                     .findChild<QTableWidget*>()
                     ->findItems("Maximum RMS current over 5 s", Qt::MatchExactly)
                     .isEmpty());
    shot(*workspace, "safety_result_one_view");
    workspace->resize(1150, 1200);
    auto& below = *workspace->findChild<gui::DisclosedPanel*>();
    auto* strip = below.findChild<gui::CaptureStrip*>();
    ASSERT_IN_TIME(comesTrue([&] { return strip->isVisible(); }));
    EXPECT_FALSE(strip->empty());
    EXPECT_GE(strip->mapTo(workspace.get(), QPoint()).y(),
              matrix.mapTo(workspace.get(), QPoint(0, matrix.height())).y());
    EXPECT_EQ(find<QPushButton>(*workspace, "Waveform"), nullptr) << "no second place for it";
    EXPECT_IN_TIME(comesTrue([&] { return find<QWidget>(*workspace, "disclosedOutputs") == nullptr; }))
        << "there is no room beside the tracing";
    workspace->resize(1800, 900);
    EXPECT_IN_TIME(comesTrue([&] {
        return strip->mapTo(workspace.get(), QPoint()).x() >
               matrix.mapTo(workspace.get(), QPoint(matrix.width(), 0)).x();
    })) << "beside the limits in a wide window";
    EXPECT_IN_TIME(comesTrue([&] { return matrix.height() >= 680; })) << "which have all the height";
    EXPECT_NE(find<QWidget>(*workspace, "How to read a cell"), nullptr);
    auto& disclosed = the<QScrollArea>("disclosedOutputs");
    ASSERT_NE(disclosed.widget(), nullptr);
    const auto* outputs = disclosed.widget()->findChild<QTableWidget*>();
    EXPECT_GE(outputs->rowCount(), 6);
    bool scrolled = false;
    for (int height = 520; height < 900 && !scrolled; height += 25) {
        workspace->resize(1800, height);
        letLive(20);
        scrolled = disclosed.isVisible() && disclosed.verticalScrollBar()->isVisible();
    }
    EXPECT_TRUE(scrolled) << "in a low window it leads to the rest";
    workspace->resize(1800, 900);
    EXPECT_EQ(outputs->columnCount(), 4) << "an output in a row, with a column for each load";
    EXPECT_EQ(outputs->horizontalHeaderItem(1)->text(), "at 500\u00a0Ω");
    EXPECT_EQ(outputs->item(0, 0)->text(), "Maximum output voltage");
    EXPECT_TRUE(outputs->item(1, 3)->text().endsWith("mA")) << outputs->item(1, 3)->text().toStdString();
    EXPECT_THAT(says("strongestOutput").toStdString(), HasSubstr("mA at its peak"));
    EXPECT_LE(matrix.horizontalHeader()->length(), matrix.viewport()->width());
    // The tracing shows the load of the chosen cell.
    const auto choose = [&](const char* load) {
        int column = 1;
        while (column < matrix.columnCount() && matrix.horizontalHeaderItem(column)->toolTip() != load) ++column;
        QTest::mouseClick(matrix.viewport(), Qt::LeftButton, {},
                          matrix.visualItemRect(matrix.item(0, column)).center());
        const auto title = matrix.item(0, 0)->text() + " on " + load + ": the strongest train";
        EXPECT_IN_TIME(comesTrue([&] { return says("strongestOutput") == title; }))
            << says("strongestOutput").toStdString();
        bool any = false;
        const auto range = strip->graph(1)->getValueRange(any);
        EXPECT_TRUE(any) << "a trace of the current";
        return std::max(range.upper, -range.lower);
    };
    const double through500 = choose("500\u00a0Ω"), through100k = choose("100\u00a0kΩ");
    EXPECT_GT(through500, 10 * through100k);
    QTest::keyClick(&matrix, Qt::Key_Left);
    EXPECT_IN_TIME(comesTrue([&] { return !says("strongestOutput").contains("100\u00a0kΩ:"); })) << "by arrow keys too";
    shot(*workspace, "safety_result_wide");
    gui::applyTheme(gui::Theme::Dark);
    letLive(50);
    shot(*workspace, "safety_result_dark");
    workspace->resize(1150, 420);
    EXPECT_IN_TIME(comesTrue([&] { return !strip->isVisible(); })) << "too low for both";
    QTest::keyClick(&matrix, Qt::Key_Return);
    EXPECT_IN_TIME(comesTrue([&] { return strip->isVisible(); }))
        << "Return shows the tracing where there is no room for both";
    EXPECT_EQ(find<QWidget>(*workspace, "How to read a cell"), nullptr) << "the tool tip says it";
    EXPECT_TRUE(says("strongestOutput").endsWith(": the strongest train")) << says("strongestOutput").toStdString();
    EXPECT_FALSE(strip->empty());
    EXPECT_TRUE(disclosed.isVisible()) << "with the outputs below it";
    shot(*workspace, "safety_tracing");
    click(*find<QPushButton>(*workspace, "Limits"));
    EXPECT_TRUE(matrix.isVisible());
    EXPECT_NE(find<QPushButton>(*workspace, "Tracing"), nullptr);
    int live = 0;
    QObject::connect(workspace.get(), &gui::ProtocolWorkspace::liveWanted, [&] { ++live; });
    click(the<QPushButton>("Go to Live"));
    EXPECT_EQ(live, 1);
}

TEST_F(SafetyCheck, AsksForTheElectrodeAreaFirst) {
    RecordProperty("hazard", "H9");
    gui::applyTheme(gui::Theme::Dark);
    open("load-safety", {760, 500});
    ASSERT_IN_TIME(comesTrue([this] { return !says("trouble-area").isEmpty(); }));
    EXPECT_THAT(says("trouble-area").toStdString(), HasSubstr("the check ends indeterminate"));
    auto& area = the<QLineEdit>("area");
    for (const auto* other : workspace->findChildren<QLineEdit*>()) {
        if (!other->isVisible() || other == &area) continue;
        EXPECT_LT(area.mapTo(workspace.get(), QPoint()).y(), other->mapTo(workspace.get(), QPoint()).y());
    }
    EXPECT_EQ(step("Settings").state(), gui::StepList::State::Troubled);
    ASSERT_IN_TIME(comesTrue([this] { return says("runObstacle").contains("smallest electrode"); }));
    EXPECT_EQ(find<QPushButton>(*workspace, "changeProfile"), nullptr) << "the profile is not in the way";
    EXPECT_FALSE(the<QPushButton>("runButton").isEnabled());
    shot(*workspace, "safety_area_dark");
    click(step("Wiring"));
    QTest::keyClick(workspace.get(), Qt::Key_F5);
    EXPECT_FALSE(workspace->running());
    EXPECT_TRUE(step("Settings").isChecked()) << "there it is asked";
    type("area", "4");
    ASSERT_IN_TIME(ready());
    EXPECT_EQ(says("runObstacle"), "");
    const auto note = [this] { return step("Settings").accessibleDescription(); };
    EXPECT_TRUE(note().endsWith(": 4\u202fcm² · defaults")) << note().toStdString();
    type("steps", "3");
    type("trains", "3");
    EXPECT_TRUE(note().endsWith(": 4\u202fcm² · 2 changed")) << note().toStdString();
    type("steps", "many");
    EXPECT_TRUE(note().endsWith(": 1 to fix")) << note().toStdString();
}

TEST_F(SafetyCheck, TheProfilesAreaIsAnAnswer) {
    RecordProperty("hazard", "H9");
    auto profile = controller.profile();
    profile.electrodeArea = SquareCentimetres(4);
    controller.setProfile(profile);
    open("load-safety");
    EXPECT_IN_TIME(ready());
    EXPECT_IN_TIME(
        comesTrue([this] { return step("Settings").accessibleDescription().endsWith(": by the profile · defaults"); }));
}

TEST_F(SafetyCheck, AStoppedRunLeavesNoRowUndecided) {
    RecordProperty("hazard", "H9");
    gui::LoadRows rows;
    rows.add({{"type", "command"}, {"load", "500 ohm"}, {"impedance_ohm", 499.5}, {"peak_ma", 80.0}});
    EXPECT_THAT(rows.verdictOf("500 ohm").toStdString(), HasSubstr("being measured"));
    rows.end(nullptr);
    for (int row = 0; row < rows.rowCount(); ++row) EXPECT_EQ(rows.item(row, 1)->text(), "○ not evaluated");
}

}  // namespace
}  // namespace tacto::test
