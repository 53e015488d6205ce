// Tests the workspace of a protocol as a person uses it: from a click to a report.
#include <QCalendarWidget>
#include <QFileDialog>
#include <QMenu>
#include <QPdfDocument>
#include <QPdfView>
#include <QProgressBar>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <fstream>
#include <gmock/gmock.h>
#include <random>

#include "app/gui/runner/ProcedurePages.h"
#include "app/gui/runner/TrialPlane.h"
#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Theme.h"
#include "core/session/SessionVerify.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/runner/Lab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Workspace : public Lab {
protected:
};

constexpr const char* kLoop =
    R"js(protocol({ title: "L", purpose: "Never ends.", needs: ["stimulator"], parameters: {} });
function run(p) { bench.arm(); log("armed"); for (;;) {} }
)js";

constexpr const char* kAsk = R"js(protocol({ title: "A", purpose: "Asks.", needs: [], parameters: {} });
function run(p) {
  operator.confirm("ready", "Is the room quiet?", { drawing: "wiring" });
  log("got " + operator.enter("room", "Room temperature", { unit: "degC", min: 10, max: 40 }));
}
)js";

constexpr const char* kBroken = R"js(protocol({ title: "B", purpose: "Breaks.", needs: [], parameters: {} });
function run(p) {
  log("here");
  nothing.of.that();
}
)js";

TEST_F(Workspace, AStepThatIsChosenWhileTheScriptIsReadStays) {
    write("first", kAsk);
    write("second", kBroken);
    workspace = std::make_unique<gui::ProtocolWorkspace>(controller, QString());
    workspace->resize(1300, 820);
    workspace->show();
    const auto isRead = [this] { return !workspace->reads(); };
    choose("first");
    ASSERT_TRUE(workspace->reads());
    click(step("Wiring"));
    ASSERT_IN_TIME(comesTrue(isRead));
    EXPECT_TRUE(step("Wiring").isChecked());
    choose("second");
    ASSERT_IN_TIME(comesTrue(isRead));
    EXPECT_TRUE(step("Settings").isChecked()) << "another protocol begins at its settings";
    ASSERT_IN_TIME(ready());
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    choose("first");
    workspace->goTo(gui::kResult);
    ASSERT_IN_TIME(comesTrue(isRead));
    EXPECT_TRUE(step("Settings").isChecked()) << "the result is that of the second";
}

TEST_F(Workspace, RunsSeparabilityFromClickToReport) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    type("operator", "A. Lind");
    type("repeats", "2");
    ASSERT_IN_TIME(comesTrue([this] { return says("worstCase").contains("into 1"); }));
    shot(*workspace, "before");
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    EXPECT_THAT(says("verdict").toStdString(), HasSubstr("INDETERMINATE"));
    EXPECT_THAT(says("verdictWhy").toStdString(), HasSubstr("fewer than 73 trials"));
    EXPECT_EQ(the<gui::TrialPlane>("Trials").drawn(), 8);
    shot(*workspace, "result");
    click(the<QPushButton>("Tables"));
    EXPECT_EQ(the<QTableWidget>("Conditions").rowCount(), 4);
    EXPECT_EQ(the<QTableWidget>("Pairs").rowCount(), 6);
    shot(*workspace, "tables");
    click(the<QPushButton>("Sign report…"));
    EXPECT_TRUE(step("Sign").isChecked());
    ASSERT_IN_TIME(comesTrue([this] { return find<QPdfView>(*workspace, "reportView") != nullptr; }, 60'000));
    EXPECT_TRUE(the<QPushButton>("printReport").isEnabled());
    EXPECT_TRUE(the<QPushButton>("openReport").isEnabled());
    EXPECT_GT(std::filesystem::file_size(ended->pdf), 10'000U);
    auto& view = the<QPdfView>("reportView");
    ASSERT_IN_TIME(comesTrue([&] { return view.document()->pageCount() >= 1 && view.width() > 600; }))
        << "read, and laid out";
    EXPECT_EQ(view.zoomMode(), QPdfView::ZoomMode::FitToWidth);
    click(the<QPushButton>("reportLarger"));
    const double larger = view.zoomFactor();
    EXPECT_EQ(view.zoomMode(), QPdfView::ZoomMode::Custom);
    click(the<QPushButton>("reportSmaller"));
    EXPECT_NEAR(view.zoomFactor(), larger / 1.25, 1e-9);
    EXPECT_LE(view.horizontalScrollBar()->maximum(), 2) << "what filled the width still does";
    click(the<QPushButton>("reportWidth"));
    EXPECT_EQ(view.zoomMode(), QPdfView::ZoomMode::FitToWidth);
    ASSERT_IN_TIME(comesTrue([this] { return std::filesystem::exists(ended->html); }, 60'000));
    QFile written(QString::fromStdString(ended->html.string()));
    ASSERT_TRUE(written.open(QIODevice::ReadOnly));
    EXPECT_TRUE(written.readAll().contains("A. Lind"));
    const auto inkOnPaper = [this] {
        const auto page = the<QPdfView>("reportView").viewport()->grab().toImage();
        int dark = 0;
        for (int y = 0; y < page.height(); y += 2) {
            for (int x = 0; x < page.width(); x += 2) dark += qGray(page.pixel(x, y)) < 100;
        }
        return dark > 100;
    };
    EXPECT_IN_TIME(comesTrue(inkOnPaper, 30'000)) << "the page is drawn, not only opened";
    shot(*workspace, "report");
}

TEST_F(Workspace, TheReportIsSignedInItsSessionAndSaysWhomItNames) {
    RecordProperty("hazard", "H9");
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    using State = gui::StepList::State;
    EXPECT_EQ(step("Wiring").state(), State::ToDo) << "not seen yet";
    workspace->goTo(gui::kWiring);
    EXPECT_EQ(step("Wiring").state(), State::Done);
    workspace->goTo(gui::kSettings);
    type("operator", "A. Lind");
    EXPECT_TRUE(step("Settings").isChecked()) << "asked for before the run";
    type("repeats", "2");
    workspace->goTo(gui::kSign);
    EXPECT_EQ(find<QLineEdit>(*workspace, "operator"), nullptr) << "nothing entered there would reach a report";
    EXPECT_THAT(says("howToSign").toStdString(), HasSubstr("sign in ink"));
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    click(the<QPushButton>("Sign report…"));
    EXPECT_EQ(qobject_cast<QLineEdit*>(QApplication::focusWidget()), nullptr) << "Space would not stop there (H6)";
    EXPECT_EQ(says("namedOperator"), "A. Lind");
    EXPECT_EQ(says("namedSample"), "not recorded");
    EXPECT_EQ(says("namedReviewer"), "not recorded");
    EXPECT_EQ(step("Sign").state(), State::ToDo);
    ASSERT_IN_TIME(comesTrue([this] { return find<QPushButton>(*workspace, "openReport") != nullptr; }, 60'000));
    EXPECT_THAT(primaries(), testing::ElementsAre("Note signature"));
    click(the<QPushButton>("openReport"));
    EXPECT_THAT(says("reportState").toStdString(), HasSubstr("no program that opens"));
    EXPECT_EQ(step("Sign").state(), State::ToDo) << "a viewer that did not open has signed nothing";
    EXPECT_EQ(the<QLineEdit>("signedBy").text(), "A. Lind") << "the operator, unless another signs";
    the<QLineEdit>("signedBy").clear();
    EXPECT_FALSE(the<QPushButton>("signReport").isEnabled());
    type("signedBy", "R. Viewer");
    click(the<QPushButton>("signReport"));
    ASSERT_IN_TIME(comesTrue([&] { return step("Sign").state() == State::Done; }));
    EXPECT_THAT(says("reportState").toStdString(), HasSubstr("Signed by R. Viewer"));
    const auto verified = verifySession(ended->result.session);
    ASSERT_EQ(verified->signatures.size(), 1U);
    EXPECT_EQ(verified->signatures[0].signature.by, "R. Viewer");
    EXPECT_EQ(verified->signatures[0].state, SignedReport::Unchanged);
    EXPECT_EQ(verified->status, SessionStatus::Intact);
    std::ofstream(ended->pdf, std::ios::app) << '%';
    EXPECT_TRUE(reportChanged(*verifySession(ended->result.session)));
    click(the<QPushButton>("changeNotes"));
    EXPECT_TRUE(step("Settings").isChecked()) << "names are changed there, and the run done again";
}

TEST_F(Workspace, TheReportStandsBesideTheResult) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    type("repeats", "2");
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    auto* menu = the<QPushButton>("reportMenu").menu();
    QStringList offered;
    const auto offers = [&](const QString& what) {
        emit menu->aboutToShow();
        offered.clear();
        for (const auto* act : menu->actions()) offered << act->text();
        return offered.contains(what);
    };
    ASSERT_IN_TIME(comesTrue([&] { return offers("Save as…"); }, 60'000)) << offered.join(", ").toStdString();
    EXPECT_TRUE(offered.contains("Show in folder") && offered.contains("Print")) << offered.join(", ").toStdString();
    menu->actions()[offered.indexOf("Save as…")]->trigger();
    auto* asks = workspace->findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(asks, nullptr) << "without the report's window";
    EXPECT_TRUE(asks->selectedFiles().front().endsWith(".pdf"));
    asks->close();
    delete asks;
    click(the<QPushButton>("Report"));  // also while it is still being drawn
    QDialog* shown = nullptr;
    ASSERT_IN_TIME(
        comesTrue([&] { return (shown = workspace->findChild<QDialog*>("reportWindow")) != nullptr; }, 60'000));
    for (const char* act : {"printReport", "saveReport", "folderOfReport", "openReport"})
        EXPECT_TRUE(shown->findChild<QPushButton*>(act)->isVisible()) << act;
    shown->findChild<QPushButton*>("saveReport")->click();
    auto* chooser = shown->findChild<QFileDialog*>("fileChooser");
    ASSERT_NE(chooser, nullptr);
    const QTemporaryDir folder;
    chooser->selectFile(folder.filePath("mine.pdf"));
    QMetaObject::invokeMethod(chooser, "accept");
    QFile copy(folder.filePath("mine.pdf")), report(QString::fromStdString(ended->pdf.string()));
    ASSERT_TRUE(copy.open(QIODevice::ReadOnly) && report.open(QIODevice::ReadOnly));
    EXPECT_EQ(copy.readAll(), report.readAll());
    EXPECT_NE(find<QLineEdit>(*shown, "signedBy"), nullptr);
    EXPECT_TRUE(std::ranges::any_of(shown->findChildren<QLabel*>(), [&](auto* label) {
        return label->toolTip().contains(copy.fileName());
    })) << "it says where the copy is";
    shot(*shown, "report-window");
    shown->close();
}

TEST_F(Workspace, ARunSaysThatTheFaultsOfTheOpenBenchAreNotItsOwn) {
    RecordProperty("hazard", "H9");
    open("separability");
    ASSERT_IN_TIME(ready());
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:stimulator?fault=open@900s"));
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller.profile();
    controller.openLive(order);
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
    EXPECT_THAT(says("timeLeft").toStdString(), HasSubstr("simulated faults are not in the run"));
    type("devices", "sim:stimulator?fault=short@2s sim:");
    EXPECT_THAT(says("timeLeft").toStdString(), testing::Not(HasSubstr("faults")));
}

TEST_F(Workspace, ARunSaysThatItClosesTheBenchAndOpensItAgain) {
    RecordProperty("hazard", "H12");
    open("separability");
    ASSERT_IN_TIME(ready());
    EXPECT_FALSE(says("timeLeft").contains("closes"));
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller.profile();
    controller.openLive(order);
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
    EXPECT_THAT(says("timeLeft").toStdString(), HasSubstr("Running closes the open bench"));
    type("repeats", "2");
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    EXPECT_EQ(controller.activity(), gui::Activity::Closed);
    EXPECT_THAT(says("closedByRun").toStdString(), HasSubstr("The run closed the bench"));
    EXPECT_THAT(says("timeLeft").toStdString(), HasSubstr("of the bench’s time")) << "of a simulated bench";
    click(the<QPushButton>("openAgain"));
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
    EXPECT_EQ(controller.telemetry().driving, DriveSource::Off);
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disarmed);
    EXPECT_EQ(find<QPushButton>(*workspace, "openAgain"), nullptr);
    controller.close();
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Closed; }));
    EXPECT_FALSE(controller.closedByRun()) << "the person closed it";
}

TEST_F(Workspace, CannotRunWhatALimitWouldRefuse) {
    RecordProperty("hazard", "H1");
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    type("load", "50");
    // Starts the run at once by key, while the table may still show the previous load.
    QTest::keyClick(&the<QLineEdit>("load"), Qt::Key_F5);
    EXPECT_FALSE(workspace->running());
    auto& run = the<QPushButton>("runButton");
    EXPECT_IN_TIME(comesTrue([&] { return !run.isEnabled(); }));
    EXPECT_THAT(says("runObstacle").toStdString(), HasSubstr("less than 10\u202fmA is allowed"));
    EXPECT_THAT(says("runObstacle").toStdString(), HasSubstr("The output stays off."));
    EXPECT_EQ(run.toolTip().toStdString(), says("runObstacle").mid(2).toStdString());
    EXPECT_FALSE(workspace->ready());
    int wanted = 0;
    QObject::connect(workspace.get(), &gui::ProtocolWorkspace::profileChangeWanted, [&] { ++wanted; });
    click(the<QPushButton>("changeProfile"));
    EXPECT_EQ(wanted, 1);
    shot(*workspace, "cannot_run");
    type("load", "1000");
    EXPECT_IN_TIME(ready());
    EXPECT_EQ(says("runObstacle"), "");
    EXPECT_EQ(find<QPushButton>(*workspace, "changeProfile"), nullptr);
}

struct WorkspaceInLargeText : Workspace {
    WorkspaceInLargeText() { gui::applyTextSize(200); }
};

TEST_F(WorkspaceInLargeText, ThePathIsARowAndThePlotKeepsItsRoom) {
    for (const char* protocol : {"load-safety", ""}) {
        open(protocol, {1190, 640});
        if (*protocol == '\0') choose("separability");
        ASSERT_IN_TIME(comesTrue([this] { return find<QWidget>(*workspace, "path") != nullptr; }));
        auto& path = the<QWidget>("path");
        ASSERT_IN_TIME(comesTrue([&] { return path.width() >= workspace->width() - 2; })) << path.width();
        EXPECT_LE(path.height(), workspace->height() / 3) << protocol;
        workspace->goTo(gui::kSettings);
        EXPECT_TRUE(step("Sign").isVisible());
        EXPECT_GE(workspace->findChild<gui::ProcedurePages*>()->width(), workspace->width() - 2);
        EXPECT_IN_TIME(comesTrue([this] { return faultsOf(*workspace).empty(); })) << faultsOf(*workspace);
        shot(*workspace, QString("row_%1").arg(*protocol == '\0' ? "chosen" : protocol));
    }
    gui::applyTextSize(100);
    EXPECT_IN_TIME(comesTrue([this] { return the<QWidget>("path").width() < workspace->width() / 4 + 1; }));
    EXPECT_IN_TIME(comesTrue([this] { return faultsOf(*workspace).empty(); })) << faultsOf(*workspace);
}

TEST_F(WorkspaceInLargeText, ARunInARowSaysHowFarItIsAndCanBeStopped) {
    RecordProperty("hazard", "H2");
    write("loop", kLoop);
    open("", {1190, 640});
    choose("loop");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(comesTrue([this] { return workspace->running(); }));
    EXPECT_EQ(find<QPushButton>(*workspace, "runButton"), nullptr) << "its room is the progress's";
    EXPECT_EQ(workspace->focusWidget(), find<QProgressBar>(*workspace, "Progress"))
        << "no key types or presses a thing";
    EXPECT_IN_TIME(comesTrue([this] {
        const auto* bar = find<QProgressBar>(*workspace, "Progress");
        return bar != nullptr && bar->format().contains(" · ");
    }));
    EXPECT_IN_TIME(comesTrue([this] { return faultsOf(*workspace).empty(); })) << faultsOf(*workspace);
    shot(*workspace, "row_running");
    controller.stop("operator (STOP)");
    ASSERT_IN_TIME(ends());
    EXPECT_NE(find<QPushButton>(*workspace, "runButton"), nullptr);
}

TEST_F(Workspace, EveryShippedProtocolRunsAsItComes) {
    open("");
    for (const char* name : {"encoding-comparison", "live", "separability", "stimulator-calibration", "transitions"}) {
        choose(name);
        EXPECT_IN_TIME(ready()) << name;
        letLive(200);  // judged a moment after it is shown
        EXPECT_TRUE(the<QPushButton>("runButton").isEnabled()) << name << says("runObstacle").toStdString();
    }
}

TEST_F(Workspace, ProtocolsAreCalledAsPeopleDoAndRangesStandInTheUnitOfTheirField) {
    write("bend",
          "protocol({ title: \"Bend\", parameters: { hold_s: { label: \"Hold\", unit: \"s\", value: 1.5, min: "
          "0.5, max: 10 } } }); function run(p) {}");
    open("");
    auto& chooser = the<QComboBox>("chooser");
    for (int i = 0; i < chooser.count(); ++i) {
        EXPECT_FALSE(chooser.itemText(i).contains('-')) << chooser.itemText(i).toStdString();
        EXPECT_TRUE(chooser.itemText(i).at(0).isUpper()) << chooser.itemText(i).toStdString();
        EXPECT_TRUE(chooser.itemData(i, Qt::ToolTipRole).toString().startsWith(chooser.itemData(i).toString()))
            << "its name for the command line";
    }
    EXPECT_EQ(chooser.itemText(chooser.findData("encoding-comparison")), "Encoding comparison");
    EXPECT_EQ(chooser.itemText(chooser.findData("bend")), "Bend (the lab's own)");
    choose("bend");
    const auto& hold = the<QLineEdit>("hold_s");
    QStringList beside;
    for (const auto* label : hold.parentWidget()->findChildren<QLabel*>()) beside << label->text();
    EXPECT_TRUE(beside.contains("0.5 to 10")) << beside.join(", ").toStdString();
    EXPECT_TRUE(hold.toolTip().contains("takes 0.5 to 10 s")) << hold.toolTip().toStdString();
}

TEST_F(Workspace, LooksRightDarkAndSmall) {
    gui::applyTheme(gui::Theme::Dark);
    open("", {760, 500});
    choose("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    type("repeats", "2");
    type("load", "0");
    ASSERT_IN_TIME(comesTrue([this] { return says("worstCase").contains("accepted"); }));
    shot(*workspace, "small_dark_before");
    type("load", "470");
    QTest::keyClick(&the<QLineEdit>("load"), Qt::Key_F5);
    ASSERT_IN_TIME(ends());
    EXPECT_IN_TIME(comesTrue([this] { return faultsOf(*workspace).empty(); })) << faultsOf(*workspace);
    shot(*workspace, "small_dark_result");
}

TEST_F(Workspace, RefusesAWrongSettingInPlaceAndRunsNothing) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    type("repeats", "1");
    ASSERT_IN_TIME(comesTrue([this] { return !says("trouble-repeats").isEmpty(); }));
    EXPECT_THAT(says("trouble-repeats").toStdString(), HasSubstr("2"));
    EXPECT_FALSE(the<QPushButton>("runButton").isEnabled());
    EXPECT_THAT(says("runObstacle").toStdString(), HasSubstr("a whole number from 2 to 500"));
    workspace->goTo(gui::kWiring);
    QTest::keyClick(workspace.get(), Qt::Key_F5);
    EXPECT_TRUE(step("Settings").isChecked()) << "F5 leads to the refused field";
    EXPECT_FALSE(workspace->running());
    EXPECT_EQ(controller.activity(), gui::Activity::Closed);
    type("repeats", "2");
    EXPECT_IN_TIME(comesTrue([this] { return find<QLabel>(*workspace, "trouble-repeats") == nullptr; }));
    type("devices", "nonsense");
    EXPECT_IN_TIME(comesTrue([this] { return !says("devicesTrouble").isEmpty(); }));
    click(the<QPushButton>("runButton"));
    EXPECT_FALSE(workspace->running());
}

TEST_F(Workspace, ShowsTheWorstCaseOfTheDeclaredLoad) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    ASSERT_IN_TIME(
        comesTrue([this] { return says("worstCase").contains("1 kΩ") || says("worstCase").contains("1\u202fkΩ"); }));
    EXPECT_THAT(says("worstCase").toStdString(), HasSubstr("Nothing exceeds a limit that can be evaluated"));
    type("load", "10");
    ASSERT_IN_TIME(comesTrue([this] { return says("worstCase").contains("will be refused"); }))
        << says("worstCase").toStdString();
    type("load", "lots");
    ASSERT_IN_TIME(comesTrue([this] { return says("worstCase").contains("when every setting is accepted"); }));
}

TEST_F(Workspace, LimitSetsAreReadAndChosenInPlace) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    auto& table = the<gui::ExposureTable>("Worst case against the limits");
    ASSERT_IN_TIME(comesTrue([&] { return table.rowCount() > 0; }));
    const int all = table.rowCount();
    auto& chooser = the<QComboBox>("limitSetChooser");
    const auto& sets = controller.limits().sets;
    ASSERT_EQ(chooser.count(), int(sets.size()) + 1);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const auto title = QString::fromStdString(sets[i].title);
        EXPECT_EQ(chooser.itemText(int(i) + 1), title) << "by its title";
        chooser.setCurrentIndex(int(i) + 1);
        EXPECT_LT(table.rowCount(), all) << title.toStdString();
        if (table.rowCount() > 0) {
            EXPECT_EQ(table.item(0, 0)->text(), title);
        }
    }
    click(the<QPushButton>("readLimits"));
    const auto* read = workspace->findChild<QTableWidget*>("limitRows");
    ASSERT_NE(read, nullptr);
    EXPECT_IN_TIME(comesTrue([&] { return read->isVisible(); }));
    EXPECT_EQ(read->rowCount(), int(sets.back().rows.size())) << "the set that was chosen";
    read->window()->close();
}

TEST_F(Workspace, PutsQuestionsInPlaceAndRefusesAnAnswerThatDoesNotFit) {
    write("ask", kAsk);
    open("");
    choose("ask");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    gui::ProtocolWorkspace other(controller, "separability");
    other.show();
    QTest::keyClick(workspace.get(), Qt::Key_F5);
    ASSERT_IN_TIME(comesTrue([this] { return says("question") == "Is the room quiet?"; }));
    EXPECT_EQ(find<QLabel>(other, "question"), nullptr) << "only where the run was started";
    EXPECT_FALSE(the<QLabel>("drawing").pixmap().isNull());
    shot(*workspace, "drawing");
    click(the<QPushButton>("Done"));
    ASSERT_IN_TIME(comesTrue([this] { return says("question") == "Room temperature"; }));
    type("answer", "99");
    shot(*workspace, "question");
    QTest::keyClick(&the<QLineEdit>("answer"), Qt::Key_Return);
    EXPECT_THAT(says("promptTrouble").toStdString(), HasSubstr("99"));
    EXPECT_FALSE(ended);
    type("answer", "21.5");
    click(the<QPushButton>("Enter"));
    ASSERT_IN_TIME(ends());
    EXPECT_FALSE(ended->result.outcome.error);
    EXPECT_THAT(ended->result.outcome.log, testing::Contains("got 21.5"));
    EXPECT_EQ(find<QLabel>(*workspace, "question"), nullptr);
}

TEST_F(Workspace, ARefusedQuestionEndsTheRun) {
    write("ask", kAsk);
    open("");
    choose("ask");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    click(the<QPushButton>("runButton"));
    click(the<QPushButton>("Refuse and end the run"));
    ASSERT_IN_TIME(ends());
    EXPECT_TRUE(ended->result.outcome.error);
    EXPECT_TRUE(the<QPushButton>("runButton").isEnabled());
}

/// Text that is no number, a number in no unit, and one beyond every range, drawn at random.
TEST_F(Workspace, RunIsOffWithTheReasonBesideItWhileAnyValueIsRefused) {
    RecordProperty("hazard", "H4");
    std::mt19937 random(49);
    const QStringList wrong{"abc", "1,000", "--3", "1e999", "-1e12", "0x", "5 5", "nan", "٣", "1..2", "1e", "½"};
    for (const char* protocol : {"separability", "load-safety"}) {
        open(protocol);
        ASSERT_IN_TIME(comesTrue([this] { return !workspace->reads(); }));
        letLive(200);  // its fields are shown in the next turns
        int refused = 0;
        for (auto* line : workspace->findChildren<QLineEdit*>()) {
            const auto* trouble = workspace->findChild<QLabel*>("trouble-" + line->objectName());
            if (trouble == nullptr) continue;
            const auto before = line->text();
            line->setText(wrong[qsizetype(random() % std::size_t(wrong.size()))]);
            if (!trouble->isHidden() && trouble->text().contains(line->text())) {
                ++refused;
                EXPECT_FALSE(the<QPushButton>("runButton").isEnabled()) << line->objectName().toStdString();
                EXPECT_FALSE(says("runObstacle").isEmpty()) << line->objectName().toStdString();
                EXPECT_TRUE(says("runObstacle").contains(line->text())) << says("runObstacle").toStdString();
            }
            line->setText(before);
        }
        EXPECT_GE(refused, 1) << protocol;
        type("devices", "nonsense");
        EXPECT_FALSE(the<QPushButton>("runButton").isEnabled());
        EXPECT_THAT(says("runObstacle").toStdString(), HasSubstr("nonsense"));
        type("devices", "sim:");
    }
    open("separability");
    EXPECT_IN_TIME(ready()) << says("runObstacle").toStdString();
}

TEST_F(Workspace, StopsAScriptThatLoopsForEver) {
    RecordProperty("hazard", "H10");
    write("loop", kLoop);
    open("");
    choose("loop");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().state == InterlockState::Armed; }));
    EXPECT_FALSE(the<QPushButton>("runButton").isEnabled());
    controller.stop("operator");
    EXPECT_NE(controller.telemetry().state, InterlockState::Armed) << "before it returned";
    ASSERT_IN_TIME(ends());
    EXPECT_THAT(says("verdict").toStdString(), HasSubstr("STOPPED"));
    EXPECT_THAT(says("verdictWhy").toStdString(), HasSubstr("The output was switched off"));
    EXPECT_EQ((says("verdictWhy") + says("verdictMore")).count(".js:"), 0) << "the place is for the script's author";
    EXPECT_TRUE(the<QPushButton>("runButton").isEnabled());
}

TEST_F(Workspace, AScriptErrorNamesItsLineAndTheEditorMarksIt) {
    write("broken", kBroken);
    open("");
    choose("broken");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    EXPECT_FALSE((says("verdictWhy") + says("verdictMore")).contains(".js:")) << says("verdictWhy").toStdString();
    EXPECT_THAT(the<QPushButton>("toScript").toolTip().toStdString(), HasSubstr("broken.js:4"));
    click(the<QPushButton>("toScript"));
    ASSERT_IN_TIME(comesTrue([this] { return editor() != nullptr; }));
    EXPECT_EQ(editor()->code().marked(), 4);
    shot(*editor(), "editor_error");
}

TEST_F(Workspace, AScriptThatCannotBeReadSaysWhereAndLeadsThere) {
    write("unreadable", "protocol({ title: 'U', purpose: 'u', needs: [], parameters: {} });\n\nfunction run(,) {}\n");
    open("");
    choose("unreadable");
    ASSERT_IN_TIME(comesTrue([this] { return says("runTrouble").contains("unreadable.js:3"); }))
        << says("runTrouble").toStdString();
    EXPECT_FALSE(the<QPushButton>("runButton").isEnabled());
    click(the<QPushButton>("toLine"));
    ASSERT_IN_TIME(comesTrue([this] { return editor() != nullptr; }));
    EXPECT_EQ(editor()->code().marked(), 3);
    editor()->showError(99, "an error behind the end, as engines report a missing brace");
    EXPECT_EQ(editor()->code().marked(), 4) << "the last line there is";
}

TEST_F(Workspace, AFolderThatCannotBeWrittenGivesASentenceAndLeavesTheWindowAlive) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    type("repeats", "2");
    type("out", "/proc/nothing/here");
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    EXPECT_THAT(says("runTrouble").toStdString(), HasSubstr("/proc/nothing/here"));
    EXPECT_THAT(says("runTrouble").toStdString(), HasSubstr("The output was switched off"));
    EXPECT_TRUE(the<QPushButton>("runButton").isEnabled());
    ended.reset();
    workspace->goTo(gui::kWiring);
    auto& out = the<QLineEdit>("out");
    out.clear();
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(comesTrue([this] { return says("verdict").contains("INDETERMINATE"); }, 60'000))
        << "the next run runs";
}

TEST_F(Workspace, InRealTimeItPausesAndResumes) {
    write("steps", R"js(protocol({ title: "S", purpose: "Steps.", needs: ["stimulator"], parameters: {} });
function run(p) {
  bench.arm();
  bench.drive("manual", { roughness: 0.5, pressure: 0.5 });
  for (const i of progress([1, 2, 3, 4, 5, 6, 7, 8], "Steps")) bench.wait(0.4);
}
)js");
    open("");
    choose("steps");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    workspace->goTo(gui::kWiring);
    auto& realtime = the<QCheckBox>("realtime");
    QTest::mouseClick(&realtime, Qt::LeftButton, {}, QPoint(8, realtime.height() / 2));  // on its box, not its row
    ASSERT_TRUE(realtime.isChecked());
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().trainsDelivered > 0 || ended; }));
    ASSERT_IN_TIME(!ended) << says("verdictWhy").toStdString();
    ASSERT_IN_TIME(comesTrue([this] {
        return says("timeLeft").contains("left") && !says("timeLeft").contains("not known");
    })) << says("timeLeft").toStdString();
    controller.pause();
    EXPECT_TRUE(controller.paused());
    ASSERT_IN_TIME(comesTrue([this] { return says("timeLeft").startsWith("paused\n"); }));
    EXPECT_THAT(says("timeLeft").toStdString(), HasSubstr("Esc ends the run; what was recorded is kept."));
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().state == InterlockState::Paused; }));
    controller.resume();
    EXPECT_FALSE(controller.paused());
    ASSERT_IN_TIME(ends());
    EXPECT_IN_TIME(!ended->result.outcome.error) << ended->result.outcome.error->message;
}

TEST_F(Workspace, ARunsEndIsThatOfThePageThatBeganIt) {
    RecordProperty("hazard", "H9");
    write("short", "protocol({ title: 'S', needs: [], parameters: {} });\nfunction run(p) { log('done'); }");
    write("loop", kLoop);
    gui::ProtocolWorkspace other(controller, "loop");
    other.resize(1300, 820);
    other.show();
    ASSERT_IN_TIME(comesTrue([&] { return other.ready(); }));
    open("short");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    QObject::connect(&controller, &gui::BenchController::changed, &other, [&] {
        // The earliest moment for another run: the end of this run has not been reported yet.
        if (controller.activity() == gui::Activity::Closed && !ended) other.runAsked();
    });
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    EXPECT_TRUE(other.running()) << "the end of the short one is not its own";
    EXPECT_FALSE(workspace->running());
    ended.reset();
    controller.stop("test");
    ASSERT_IN_TIME(comesTrue([&] { return ended != nullptr; }));
    EXPECT_FALSE(other.running());
}

TEST_F(Workspace, AStepThatWasReachedCanBeGoneBackTo) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    EXPECT_FALSE(step("Result").isEnabled());
    EXPECT_THAT(step("Result").toolTip().toStdString(), HasSubstr("press Run"));
    EXPECT_EQ(step("Settings").state(), gui::StepList::State::UnderWay);
    EXPECT_EQ(find<gui::StepButton>(*workspace, "Known reference"), nullptr) << "it reads none";
    int number = 0;
    for (const char* name : {"Wiring", "Settings", "Run", "Result", "Sign"}) EXPECT_EQ(step(name).number(), ++number);
    EXPECT_THAT(primaries(), testing::ElementsAre("Run"));
    type("repeats", "2");
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    EXPECT_TRUE(step("Result").isChecked());
    EXPECT_EQ(step("Run").state(), gui::StepList::State::Done);
    click(step("Settings"));
    EXPECT_EQ(the<QLineEdit>("repeats").text(), "2");
    EXPECT_EQ(find<QLabel>(*workspace, "verdict"), nullptr);
    click(step("Run"));
    EXPECT_TRUE(the<gui::TrialPlane>("Trials").isVisible());
    click(step("Wiring"));
    EXPECT_EQ(the<QLineEdit>("devices").text(), "sim:");
    click(step("Result"));
    EXPECT_THAT(says("verdict").toStdString(), HasSubstr("INDETERMINATE"));
    EXPECT_THAT(primaries(), testing::ElementsAre("Change settings"));
}

TEST_F(Workspace, WhatComesNextIsAButtonThatDoesIt) {
    open("separability");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    type("repeats", "2");
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    QString session;
    QObject::connect(workspace.get(), &gui::ProtocolWorkspace::sessionWanted,
                     [&](const QString& path) { session = path; });
    click(the<QPushButton>("Open session"));
    EXPECT_EQ(session.toStdString(), ended->result.session.string());
    click(the<QPushButton>("Change settings"));
    EXPECT_TRUE(step("Settings").isChecked());
}

TEST_F(Workspace, DaysComeFromACalendarAndFilesFromADialog) {
    write("kinds", R"js(protocol({ title: "K", purpose: "Takes a day and a file.", needs: [], parameters: {
  due: { label: "Due", type: "date", value: "" },
  table: { label: "Table", type: "file", value: "" },
} });
function run(p) { log(p.due + " " + p.table); }
)js");
    open("");
    choose("kinds");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    auto& due = the<QLineEdit>("due");
    type("due", "2027-02-30");
    ASSERT_IN_TIME(comesTrue([this] { return says("trouble-due").contains("a day such as 2027-03-01"); }));
    type("due", "2027-03-01");
    EXPECT_EQ(says("trouble-due"), "");
    auto* menu = the<QToolButton>("calendar-due").menu();
    emit menu->aboutToShow();
    auto* calendar = menu->findChild<QCalendarWidget*>();
    ASSERT_NE(calendar, nullptr);
    EXPECT_EQ(calendar->selectedDate(), QDate(2027, 3, 1));
    emit calendar->clicked(QDate(2027, 5, 6));
    EXPECT_EQ(due.text(), "2027-05-06");
    due.setFocus();
    QTest::keyClick(&due, Qt::Key_Tab);
    EXPECT_FALSE(the<QToolButton>("calendar-due").hasFocus()) << "one Tab leads to the next field";
    click(the<QToolButton>("choose-table"));
    auto* dialog = workspace->findChild<QFileDialog*>();
    ASSERT_NE(dialog, nullptr);
    EXPECT_FALSE(dialog->isModal());
    emit dialog->fileSelected("/lab/table.csv");
    EXPECT_EQ(the<QLineEdit>("table").text(), "/lab/table.csv");
    dialog->close();
}

TEST_F(Workspace, ResultsOfAnyShapeAreNoReasonToEnd) {
    RecordProperty("hazard", "H10");
    write("shapes", R"js(protocol({ title: "S", purpose: "Returns anything.", needs: [], parameters: {} });
function run(p) {
  return verdict({ verdict: "pass", loads: [1, { name: 5, verdict: {} }], confusion: [[1, "x"], 2],
    amplitude: { levels: [1], readings: [1, { outlier: "yes" }], gain: "x", unit: 5 },
    reference: 5, trials_needed: [] });
}
)js");
    open("");
    choose("shapes");
    ASSERT_IN_TIME(ready()) << says("runObstacle").toStdString();
    click(the<QPushButton>("runButton"));
    ASSERT_IN_TIME(ends());
    EXPECT_THAT(says("verdict").toStdString(), HasSubstr("PASS"));
}

}  // namespace
}  // namespace tacto::test
