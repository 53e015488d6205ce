// Tests sessions as files and in their workspace: listed, searched, exported, replayed, verified.
#include <QPdfDocument>
#include <QPdfView>
#include <QPushButton>
#include <QScrollBar>
#include <QTableView>
#include <QTableWidget>
#include <QTest>
#include <atomic>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "app/gui/controller/BenchController.h"
#include "app/gui/sessions/Background.h"
#include "app/gui/sessions/CompareWindow.h"
#include "app/gui/sessions/ExportDialog.h"
#include "app/gui/sessions/SessionDetails.h"
#include "app/gui/sessions/SessionsWorkspace.h"
#include "core/acquisition/Recording.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionWriter.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// True if the plot's watermark is visible.
bool saysSimulated(const QCustomPlot& plot) {
    for (int i = 0; i < plot.itemCount(); ++i)
        if (plot.item(i)->objectName() == "watermark") return plot.item(i)->visible();
    return false;
}

class Recorded : public testing::Test {
protected:
    void SetUp() override { session = record({"sim:"}, 2); }
    void TearDown() override {
        for (const auto& made : made_) std::filesystem::remove(made);
    }
    /// Records a session on a simulated bench for so many seconds.
    std::filesystem::path record(const std::vector<const char*>& uris, int seconds, const QString& mark = {}) {
        gui::LiveOrder order;
        for (const auto* uri : uris) order.uris.push_back(*DeviceUri::parse(uri));
        order.profile = controller.profile();
        order.speed = 5;
        controller.openLive(order);
        EXPECT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
        made_.push_back(controller.open()->session);
        EXPECT_IN_TIME(comesTrue([&] { return controller.telemetry().at > std::chrono::seconds(seconds); }));
        if (!mark.isEmpty()) {
            EXPECT_TRUE(controller.markMoment(controller.telemetry().at, mark));
        }
        controller.close();
        EXPECT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Closed; }));
        return made_.back();
    }
    static gui::WorkPort port(bool cancelled = false) {
        return {std::make_shared<std::atomic<bool>>(cancelled), [](int, int) {}};
    }
    gui::SessionsWorkspace& show() {
        workspace_ = std::make_unique<gui::SessionsWorkspace>(controller);
        workspace_->resize(1200, 700);
        workspace_->show();
        return *workspace_;
    }
    /// Shows the workspace with the session selected.
    gui::SessionsWorkspace& opened() {
        EXPECT_TRUE(show().openSession(QString::fromStdString(session.string())));
        return *workspace_;
    }
    /// Waits until the button can be pressed, then presses it.
    void press(const char* name) {
        auto* button = find<QPushButton>(*workspace_, name);
        ASSERT_NE(button, nullptr) << name;
        ASSERT_IN_TIME(comesTrue([&] { return button->isEnabled(); }));
        click(*button);
    }
    gui::BenchController controller{simulatedRegistry};
    std::filesystem::path session;
    const ScratchDir folder;
    const ExportFormat& csv = *exportFormat("csv");

private:
    std::unique_ptr<gui::SessionsWorkspace> workspace_;
    std::vector<std::filesystem::path> made_;
};

TEST_F(Recorded, IsALineThatSaysWhatItHolds) {
    const gui::SessionEntry entry(gui::userSessionIndex().read(session));
    EXPECT_EQ(entry.problem, "");
    EXPECT_TRUE(entry.summary.simulated);
    EXPECT_TRUE(entry.summary.closed);
    EXPECT_GT(entry.summary.duration_s, 1.5);
    EXPECT_TRUE(entry.searched.contains("simulated stimulator"));
    const auto foreign = folder.write("notes.tacto", "no session of any kind");
    EXPECT_NE(gui::SessionEntry(gui::userSessionIndex().read(foreign)).problem, "") << "is listed with its reason";
}

TEST_F(Recorded, AnExportTouchesNothingThatItDidNotMake) {
    RecordProperty("hazard", "H8");
    const auto target = folder.path() / "csv";
    const auto kept = folder.write("csv.part/notes.txt", "another program's work");
    const auto entries = [this] {
        return std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator());
    };
    const auto before = entries();
    EXPECT_EQ(gui::exportWith(port(true), session, csv, target).error().code, ErrorCode::Stopped);
    EXPECT_TRUE(std::filesystem::exists(kept));
    EXPECT_EQ(entries(), before) << "a cancelled export leaves nothing";
    ASSERT_TRUE(gui::exportWith(port(), session, csv, target));
    EXPECT_TRUE(std::filesystem::exists(kept));
    EXPECT_EQ(entries(), before + 1);
    EXPECT_THAT(gui::exportWith(port(), session, csv, target).error().message, HasSubstr("exists already"));
    std::filesystem::create_directory(folder.path() / "empty");
    EXPECT_FALSE(gui::exportWith(port(), session, csv, folder.path() / "empty")) << "an empty folder may be in use too";
    std::filesystem::create_symlink(folder.path() / "nowhere", folder.path() / "link");
    EXPECT_FALSE(gui::exportWith(port(), session, csv, folder.path() / "link"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "nowhere"));
}

TEST_F(Recorded, ExportsEverySampleAsItWasRecorded) {
    const auto target = folder.path() / "csv";
    ASSERT_TRUE(gui::exportWith(port(), session, csv, target));
    const auto reader = SessionReader::open(session);
    ASSERT_TRUE(reader);
    const auto streams = reader->streams();
    ASSERT_TRUE(streams && !streams->empty());
    const auto& info = streams->front();
    const auto samples = reader->samples(info.id);
    ASSERT_TRUE(samples);
    std::ifstream table(target / "acceleration.csv");
    std::string line;
    ASSERT_TRUE(std::getline(table, line));
    EXPECT_TRUE(line.starts_with("time_s,"));
    std::size_t rows = 0;
    const auto columns = info.stream.columns.size();
    while (std::getline(table, line)) {
        ASSERT_LT(rows, samples->samples());
        const auto cells = QString::fromStdString(line).split(',');
        ASSERT_EQ(std::size_t(cells.size()), columns + 2);
        EXPECT_EQ(cells[0].toDouble(), samples->t_s[rows]);
        for (std::size_t c = 0; c < columns; ++c)
            EXPECT_EQ(cells[int(c) + 1].toDouble(), samples->values[rows * columns + c]);
        ++rows;
    }
    EXPECT_EQ(rows, samples->samples());
}

TEST_F(Recorded, IsExportedByOneDialogThatSaysWhatBecomesOfIt) {
    RecordProperty("hazard", "H9");
    auto& workspace = opened();
    auto* ask = workspace.findChild<QPushButton*>("exportSession");
    ASSERT_NE(ask, nullptr);
    ASSERT_IN_TIME(comesTrue([&] { return ask->isEnabled(); }));
    click(*ask);
    auto* dialog = workspace.findChild<gui::ExportDialog*>();
    ASSERT_NE(dialog, nullptr);
    const auto* holds = dialog->findChild<QLabel*>("exportHolds");
    auto* begin = dialog->findChild<QPushButton*>("exportBegin");
    ASSERT_IN_TIME(comesTrue([&] { return begin->isEnabled(); }));
    auto* place = dialog->findChild<QLineEdit*>("exportPlace");
    for (const auto* format : exportFormats()) {
        const auto name = std::string(format->name);
        dialog->findChild<gui::FieldForm*>()->set("format", QString::fromStdString(name));
        EXPECT_TRUE(place->text().endsWith(
            QString::fromStdString(format->suffix.empty() ? "-" + name : std::string(format->suffix))));
        EXPECT_THAT(holds->text().toStdString(), HasSubstr("Marked: simulated")) << name;
        const auto source = ExportSource::open(session, nullptr, {}, "test");
        ASSERT_TRUE(source);
        for (const auto& left : leftOutOf(*source, *format))
            EXPECT_THAT(holds->text().toStdString(), HasSubstr(left.why)) << name;
    }
    auto* folderButton = dialog->findChild<QPushButton*>("exportFolder");
    EXPECT_FALSE(folderButton->isVisible());
    dialog->findChild<gui::FieldForm*>()->set("format", "hdf5");
    place->setText(QString::fromStdString((folder.path() / "out.h5").string()));
    EXPECT_IN_TIME(comesTrue([&] { return faultsOf(*dialog).empty(); })) << faultsOf(*dialog);
    shot(*dialog, "export-dialog");
    const gui::ExportDialog other(folder.path() / "another.tacto", &workspace);
    EXPECT_NE(other.windowTitle(), dialog->windowTitle()) << "else it would be taken for this one";
    click(*begin);
    const auto* says = dialog->findChild<QLabel*>("exportSays");
    ASSERT_IN_TIME(comesTrue([&] { return says->text().startsWith("Exported:"); })) << says->text().toStdString();
    EXPECT_TRUE(folderButton->isVisible());
    EXPECT_EQ(faultsOf(*dialog), "");
    shot(*dialog, "export-done");
    EXPECT_GT(std::filesystem::file_size(folder.path() / "out.h5"), 1000U);
    click(*begin);
    ASSERT_IN_TIME(comesTrue([&] { return says->text().contains("exists already"); })) << says->text().toStdString();
    place->setText("/elsewhere/out.h5");
    click(*folderButton);
    EXPECT_THAT(says->text().toStdString(), HasSubstr(folder.path().string())) << "where it was exported to";
}

TEST_F(Recorded, GoesOutAsACertificateOnlyIfItIsACalibration) {
    RecordProperty("hazard", "H9");
    for (const std::string protocol : {"live", "stimulator-calibration"}) {
        const auto path = folder.path() / (protocol + ".tacto");
        SessionAbout about;
        about.protocol = protocol;
        about.wallStart = "2026-11-30T12:00:00Z";
        const VirtualClock clock;
        ASSERT_TRUE(SessionWriter::create(path, about, clock).value()->close());
        gui::ExportDialog dialog(path, nullptr);
        dialog.show();
        ASSERT_IN_TIME(comesTrue([&] { return dialog.findChild<QPushButton*>("exportBegin")->isEnabled(); }));
        auto* form = dialog.findChild<gui::FieldForm*>();
        form->set("format", "dcc");
        const bool offered = form->text("format") == "dcc";
        EXPECT_EQ(offered, protocol == "stimulator-calibration");
        if (!offered) continue;
        EXPECT_TRUE(dialog.findChild<QLineEdit*>("exportPlace")->text().endsWith("stimulator-calibration.xml"));
        click(*dialog.findChild<QPushButton*>("exportBegin"));
        const auto* says = dialog.findChild<QLabel*>("exportSays");
        ASSERT_IN_TIME(comesTrue([&] { return says->text().contains("no new calibration"); }))
            << says->text().toStdString();
    }
}

TEST_F(Recorded, ReplaysAsARecording) {
    const auto target = folder.path() / "again";
    const auto written = gui::exportWith(port(), session, csv, target);
    ASSERT_TRUE(written) << written.error().message;
    const auto recording = Recording::open(target);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->streams.size(), 3U);
}

TEST_F(Recorded, IsFoundVerifiedAndSearchedInTheWorkspace) {
    auto& workspace = opened();
    auto* table = workspace.findChild<QTableView*>("sessionsTable");
    ASSERT_NE(table, nullptr);
    ASSERT_IN_TIME(
        comesTrue([&] { return table->model()->rowCount() >= 1 && table->selectionModel()->hasSelection(); }));
    auto* verify = find<QPushButton>(workspace, "Verify");
    ASSERT_NO_FATAL_FAILURE(press("Verify"));
    auto* says = workspace.findChild<QLabel*>("sessionsSay");
    EXPECT_IN_TIME(comesTrue([&] { return says->text().contains("is intact"); })) << says->text().toStdString();
    shot(workspace, "sessions");
    auto* search = find<QLineEdit>(workspace, "Search");
    const int all = table->model()->rowCount();
    search->setText("no-such-word");
    EXPECT_EQ(table->model()->rowCount(), 0);
    EXPECT_FALSE(verify->isEnabled()) << "what is not seen is not acted on";
    EXPECT_EQ(verify->toolTip(), "Choose a session first.");
    EXPECT_NE(
        find<QLabel>(workspace,
                     "No session contains “no-such-word”. The search covers procedure, note, operator, sample, tags, "
                     "verdict, devices, date and file name."),
        nullptr);
    shot(workspace, "sessions-no-hit");
    search->clear();
    EXPECT_EQ(table->model()->rowCount(), all);
    const auto cell = [&](int column, int role) { return table->model()->index(0, column).data(role); };
    EXPECT_TRUE(cell(1, Qt::DisplayRole).toString().startsWith("Today "));
    EXPECT_FALSE(cell(0, Qt::DecorationRole).value<QIcon>().isNull()) << "a verdict has a shape";
}

TEST(Background, NewWorkWaitsForTheOldAndTheWindowForNeither) {
    gui::Background background;
    std::atomic<bool> let{false};
    std::vector<std::string> order;  // filled by the threads in the order of their turns
    bool first = false, second = false;
    background.start(
        [&](const gui::WorkPort&) -> Result<void> {  // ignores a cancel
            while (!let) std::this_thread::yield();
            order.emplace_back("first");
            return {};
        },
        [&](const Result<void>&) { first = true; });
    background.start(
        [&](const gui::WorkPort&) -> Result<void> {
            order.emplace_back("second");
            return {};
        },
        [&](const Result<void>&) { second = true; });
    let = true;  // not reached if start() waits
    ASSERT_IN_TIME(comesTrue([&] { return second; }));
    EXPECT_EQ(order, (std::vector<std::string>{"first", "second"}));
    EXPECT_FALSE(first) << "its result is not wanted any more";
}

TEST_F(Recorded, TwoAreComparedOverEachOther) {
    (void)record({"sim:stimulator?gain=1.05", "sim:"}, 3, "lead off");
    auto& workspace = show();
    auto* table = workspace.findChild<QTableView*>("sessionsTable");
    ASSERT_IN_TIME(comesTrue([&] { return table->model()->rowCount() == 2; }));
    auto* compare = find<QPushButton>(workspace, "Compare two");
    ASSERT_NE(compare, nullptr);
    const auto chooses = [&](int row, Qt::KeyboardModifiers modifiers) {
        QTest::mouseClick(table->viewport(), Qt::LeftButton, modifiers,
                          table->visualRect(table->model()->index(row, 0)).center());
    };
    chooses(0, Qt::NoModifier);
    EXPECT_FALSE(compare->isEnabled()) << "one is compared with nothing";
    chooses(1, Qt::ControlModifier);
    ASSERT_NO_FATAL_FAILURE(press("Compare two"));
    gui::CompareWindow* both = nullptr;
    ASSERT_IN_TIME(comesTrue([&] { return (both = workspace.findChild<gui::CompareWindow*>()) != nullptr; }));
    ASSERT_IN_TIME(comesTrue([&] { return both->isVisible(); }));
    QStringList words;
    for (const auto* compared : both->findChild<QWidget*>("comparison")->findChildren<QTableWidget*>())
        for (int row = 0; row < compared->rowCount(); ++row)
            words << compared->item(row, 1)->text() << compared->item(row, 2)->text();
    EXPECT_TRUE(words.join('|').contains("gain=1.05")) << words.join('|').toStdString();
    EXPECT_LE(both->height(), 720) << "inside a small screen";
    const auto drawn = [&] {
        const auto plots = both->findChildren<QCustomPlot*>();
        return std::any_of(plots.begin(), plots.end(), [](const auto* plot) { return plot->plottableCount() >= 2; });
    };
    EXPECT_IN_TIME(comesTrue(drawn)) << "a stream of both, over each other";
    shot(*both, "compare");
    for (const auto* plot : both->findChildren<QCustomPlot*>()) {
        EXPECT_TRUE(saysSimulated(*plot));
        if (!plot->legend->visible()) continue;
        EXPECT_TRUE(plot->viewport().contains(plot->legend->outerRect())) << "the legend is on its plot";
        EXPECT_FALSE(plot->legend->outerRect().intersects(plot->axisRect()->rect())) << "and covers no data";
    }
    EXPECT_IN_TIME(comesTrue([&] { return both->marks().words().size() == 1; }));
    EXPECT_THAT(both->marks().words().join(" ").toStdString(), testing::MatchesRegex("[AB]: lead off"))
        << "and of which of both";
    auto* which = both->findChild<QComboBox*>("drawn");
    which->setCurrentIndex(which->findText("Roughness frames: Pressure"));
    const auto axisSays = [&](const QString& label) {
        const auto plots = both->findChildren<QCustomPlot*>();
        return std::any_of(plots.begin(), plots.end(), [&](const auto* plot) { return plot->yAxis->label() == label; });
    };
    EXPECT_IN_TIME(comesTrue([&] { return axisSays("Pressure (kPa)"); })) << "as in Live";
    both->close();
}

TEST_F(Recorded, AStreamOfASimulatedSessionSaysSoAndNamesItsTraces) {
    RecordProperty("hazard", "H9");
    session = record({"sim:"}, 2, "table bumped");
    auto& workspace = opened();
    auto* details = workspace.findChild<gui::SessionDetails*>();
    auto* streams = details->findChild<QTableWidget*>("streamsTable");
    ASSERT_IN_TIME(comesTrue([&] { return streams->rowCount() > 0; }));
    EXPECT_EQ(streams->currentRow(), -1) << "none is read before it is looked at";
    details->setCurrentIndex(2);
    EXPECT_EQ(streams->currentRow(), 0) << "no empty plot";
    EXPECT_EQ(streams->verticalScrollBar()->maximum(), 0) << "all are in sight where the plot keeps the larger part";
    const auto* plot = details->findChild<QCustomPlot*>("chosenStream");
    for (int row = 0; row < streams->rowCount(); ++row) {
        streams->setCurrentCell(row, 0);
        ASSERT_IN_TIME(comesTrue([&] { return plot->graphCount() > 0; }));
        EXPECT_TRUE(saysSimulated(*plot));
        EXPECT_EQ(plot->legend->visible(), plot->graphCount() > 1);
        EXPECT_EQ(details->marks().words(), QStringList{"table bumped"}) << "row " << row;
        EXPECT_FALSE(plot->yAxis->label().isEmpty());
        for (int g = 0; g < plot->graphCount(); ++g) {
            const auto* graph = plot->graph(g);
            EXPECT_FALSE(graph->name().contains('_')) << graph->name().toStdString();
            const bool pressure = graph->name() == "Pressure";
            EXPECT_EQ(pressure, graph->valueAxis()->label() == "Pressure (kPa)") << graph->name().toStdString();
            const auto most = graph->valueAxis()->range().upper;
            EXPECT_TRUE(!pressure || (most >= 1 && most < 1000)) << most << ": in the unit that the axis names";
            EXPECT_EQ(pressure, graph->valueAxis() != plot->yAxis) << "no pascal on the axis of 0 to 1";
        }
    }
    shot(workspace, "sessions-stream");
}

TEST_F(Recorded, ItsReportOpensInTheProgram) {
    auto& workspace = opened();
    const auto windows = [&] { return workspace.findChildren<QDialog*>("reportWindow"); };
    const auto shown = [&] {
        if (windows().isEmpty()) return false;
        const auto* view = windows().first()->findChild<QPdfView*>("reportView");
        return view->isVisible() && view->document()->pageCount() > 0;
    };
    for (int time = 0; time < 2; ++time) {
        ASSERT_NO_FATAL_FAILURE(press("Report"));
        ASSERT_IN_TIME(comesTrue(shown, 60'000)) << workspace.findChild<QLabel*>("sessionsSay")->text().toStdString();
        EXPECT_IN_TIME(comesTrue([&] { return windows().size() == 1; })) << "the same one, when it is drawn again";
    }
    auto* dialog = windows().first();
    for (const char* button : {"printReport", "openReport", "reportLarger", "reportWidth"})
        EXPECT_TRUE(dialog->findChild<QPushButton*>(button)->isVisible()) << button;
    shot(*dialog, "session-report");
    dialog->close();
    std::filesystem::remove(std::filesystem::path(session).replace_extension(".pdf"));
}

TEST_F(Recorded, ReplayGoesToTheLiveWorkspace) {
    auto& workspace = opened();
    QString ready;
    QObject::connect(&workspace, &gui::SessionsWorkspace::recordingReady, &workspace,
                     [&](const QString& target) { ready = target; });
    ASSERT_NO_FATAL_FAILURE(press("Replay"));
    ASSERT_IN_TIME(comesTrue([&] { return !ready.isEmpty(); }));
    EXPECT_TRUE(Recording::open(ready.toStdString()).has_value());
}

}  // namespace
}  // namespace tacto::test
