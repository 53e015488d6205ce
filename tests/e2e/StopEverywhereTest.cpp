// STOP, Esc and Pause stop the output behind every dialog and popup of the program, with a real mouse and keyboard.
//
// Needs its own display (see in-xvfb); skipped elsewhere.
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTableView>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <qcustomplot.h>
#include <random>

#include "app/gui/pilot/PilotWorkspace.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/study/StudyForm.h"
#include "app/gui/study/StudyPage.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/window/DockColumn.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/SafetyBar.h"
#include "app/run/Shipped.h"
#include "app/run/StudyProgram.h"
#include "core/study/Study.h"
#include "tests/e2e/Hand.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

constexpr int kTries = 4;            // repeats if the machine was late while a dialog opened
constexpr int kStopLimit_ms = 2000;  // long enough for a loaded machine; the actual time is recorded
constexpr const char* kPassphrase = "correct horse 4711";

/// Returns, for each file of app/gui (by its stem), how often it calls the two functions that open dialogs.
std::map<std::string, int> placesThatOpenDialogs() {
    static const QRegularExpression call("\\b(openDialog|askForFile)\\(");
    std::map<std::string, int> calls;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceDir() / "app" / "gui")) {
        if (entry.path().extension() != ".cpp" || entry.path().stem() == "Dialogs") continue;
        QFile file(QString::fromStdString(entry.path().string()));
        if (!file.open(QIODevice::ReadOnly)) continue;
        if (const int found = int(QString::fromUtf8(file.readAll()).count(call)); found > 0)
            calls[entry.path().stem().string()] = found;
    }
    return calls;
}

/// Openings that call openDialog() or askForFile() at the same place as an opening listed earlier.
constexpr std::string_view kShareAPlace[] = {"Folder of a new study", "Definitions and limits"};
/// Places that this test leaves out: the file, and the similar dialog that is tested instead.
constexpr std::pair<const char*, const char*> kTriedByAnother[] = {
    {"CertificateDialog", "which digital certificate to read: the same question as for a capture"},
    {"CloseQuestion", "whether a run is to end: the same box as for a script that is not saved"},
    {"StudyList", "releasing a study after a serious event: the same frame as for the event"},
    {"StudyList", "whether to go back to an older ledger: the same frame as for a participant who leaves"},
    {"PilotWorkspace", "where to export a rehearsal: the same question as for a study's results"},
    {"ReportView", "where to save a report: the same question as for a plot"},
    {"StudyResults", "where to save a figure: the same question as for a plot"},
    {"StudyResults", "where to save all figures: the same question as for a plot"},
    {"StudyResults", "where to save a new profile: the same question as for a plot"},
    {"StudyResults", "which encoding to use: the same frame as for a participant who leaves"},
    {"StudyResults", "an amendment with that encoding: the same dialog as for any amendment"},
    {"TableText", "where to save a table: the same question as for a plot"},
    {"TableText", "that a table was not saved: the same box as for a plot"}};

struct Opening {
    std::string name;
    std::function<void()> open;
    std::string in = {};  ///< stem of the file that calls openDialog() or askForFile(); empty if it opens without these
};

class StopEverywhere : public testing::Test {
protected:
    StopEverywhere() {
        RecordProperty("hazard", "H2");
        EXPECT_EQ(QGuiApplication::platformName(), "xcb");
        window.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&window));
        focus(window);
        stop = window.findChild<gui::SafetyBar*>()->findChild<QPushButton*>("stopButton");
        makeStudy();
        openBench();
        openBench();  // the second session, to be compared with the first
    }
    ~StopEverywhere() override { window.close(); }

    [[nodiscard]] InterlockState state() { return window.controller().telemetry().state; }
    [[nodiscard]] bool isLive() {
        const auto now = state();
        return now == InterlockState::Armed || now == InterlockState::Delivering;
    }
    void openBench() {
        gui::LiveOrder order;
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = window.controller().profile();
        order.speed = 4;
        const auto before = window.controller().open();
        window.controller().openLive(order);
        ASSERT_IN_TIME(comesTrue([&] {
            return window.controller().activity() == gui::Activity::Live && window.controller().open() != before;
        }));
    }
    /// True if the output is off because the control loop, the window or the disk was late, as designed.
    [[nodiscard]] bool wasLate() {
        const std::string_view why = window.controller().telemetry().reason.view();
        return why.find("was silent for more than") != why.npos || why.find("did not look after it") != why.npos ||
               why.find("the disk stood still") != why.npos;
    }
    void deliver() {
        if (state() == InterlockState::Faulted && wasLate()) window.controller().resetFault();
        ASSERT_IN_TIME(comesTrue([&] { return state() == InterlockState::Disarmed; }))
            << nameOf(state()) << ": " << window.controller().telemetry().reason.c_str();
        ArmRequest request;
        request.operatorConfirmed = true;
        window.controller().arm(request);
        ASSERT_IN_TIME(comesTrue([&] { return state() == InterlockState::Armed; }));
        window.controller().drive(DriveSource::Manual, 0.5, 1);
        ASSERT_IN_TIME(comesTrue([&] { return state() == InterlockState::Delivering; }));
    }
    /// Expects that the action `hand` ends the output.
    void expectStop(const std::string& what, const std::function<void()>& hand) {
        ASSERT_TRUE(isLive()) << what << ": opening it stopped the output";
        QElapsedTimer since;
        since.start();
        hand();
        const bool stopped = comesTrue([&] { return !isLive(); }, kStopLimit_ms);
        EXPECT_IN_TIME(stopped) << what << ": still delivering";
        slowest_ms = std::max(slowest_ms, since.elapsed());
        ++tried;
        if (!stopped) window.controller().stop("the test");
    }
    [[nodiscard]] static QDialog* newest() {
        QDialog* found = nullptr;
        for (auto* widget : QApplication::topLevelWidgets()) {
            auto* dialog = qobject_cast<QDialog*>(widget);
            if (dialog != nullptr && dialog->isVisible()) found = dialog;
        }
        return found;
    }
    static void closePopups() {
        while (auto* popup = QApplication::activePopupWidget()) popup->close();
    }
    void closeAll() {
        closePopups();
        ASSERT_IN_TIME(comesTrue([&] {
            if (auto* dialog = newest()) dialog->close();
            return newest() == nullptr;
        }));
        focus(window);
    }

    void trigger(const QString& menu, const QString& entry) {
        for (auto* action : window.menuBar()->actions()) {
            if (action->text().remove('&') != menu) continue;
            for (auto* found : action->menu()->actions()) {
                if (found->text().remove('&') == entry) return found->trigger();
            }
        }
        ADD_FAILURE() << "no entry " << entry.toStdString();
    }
    void press(const QWidget& in, const QString& text) {
        QAbstractButton* button = nullptr;
        ASSERT_IN_TIME(comesTrue([&] { return (button = find<QAbstractButton>(in, text)) != nullptr; }))
            << text.toStdString();
        ASSERT_IN_TIME(comesTrue([&] { return button->isEnabled(); })) << text.toStdString();
        button->click();
    }
    void page(int index, int tab = 0) {
        window.showWorkspace(index);
        window.findChild<gui::TabbedPage*>("livePage")->setCurrentIndex(tab);
    }
    void choose(int sessions) {
        page(5);
        auto* table = window.findChild<QTableView*>("sessionsTable");
        ASSERT_IN_TIME(comesTrue([&] { return table->model()->rowCount() >= 2; }));
        table->clearSelection();
        table->setSelectionMode(QAbstractItemView::MultiSelection);
        for (int row = 0; row < sessions; ++row) table->selectRow(row);
    }
    /// Opens "Save as…" of the visible plot.
    void savePlot() {
        page(0, 0);
        for (auto* plot : window.findChildren<QCustomPlot*>()) {
            if (!plot->isVisible()) continue;
            for (auto* action : plot->actions()) {
                if (action->text() == "&Save as…") return action->trigger();
            }
        }
        ADD_FAILURE() << "no plot can be saved";
    }
    void failToSave() {
        savePlot();
        auto* chooser = qobject_cast<QFileDialog*>(newest());
        ASSERT_NE(chooser, nullptr);
        emit chooser->fileSelected("/nowhere/at/all.png");
        chooser->close();
    }
    void fromScope(const QString& entry) {
        page(0, 1);
        for (auto* menu : window.findChildren<QMenu*>()) {
            for (auto* action : menu->actions()) {
                if (action->text() == entry) return action->trigger();
            }
        }
        ADD_FAILURE() << "no entry " << entry.toStdString();
    }

    [[nodiscard]] gui::PilotWorkspace& studies() {
        page(4);
        auto& pilot = *window.findChild<gui::PilotWorkspace*>();
        pilot.findChild<gui::TabbedPage*>()->setCurrentIndex(1);
        return pilot;
    }
    [[nodiscard]] QString study() const { return QString::fromStdString((folder.path() / "study").string()); }
    void makeStudy() {
        StudySettings settings;
        settings.title = "Four conditions";
        settings.approval.reference = "EC-2026-17";
        settings.approval.from = std::chrono::year(2020) / 1 / 1;
        settings.approval.expires = std::chrono::year(2090) / 12 / 31;
        settings.consentVersion = "2";
        ASSERT_TRUE(stateProgram(settings, shippedProfile().value()));
        auto made = Study::create(study().toStdString(), settings, Passphrase::from(kPassphrase).value());
        ASSERT_TRUE(made) << made.error().message;
        ASSERT_TRUE(made->enrol(Participant()));
    }
    /// Fills in the form of a new study.
    gui::NewStudyPage& newStudy() {
        auto& pilot = studies();
        pilot.findChild<QPushButton*>("newStudyWanted")->click();
        auto* form = pilot.findChild<gui::StudyForm*>();
        for (const auto& [field, text] :
             {std::pair{"title", "T"}, std::pair{"approval.reference", "EC-1"},
              std::pair{"approval.from", "2026-11-01"}, std::pair{"approval.expires", "2090-10-31"},
              std::pair{"consent_version", "2"}})
            form->set(field, text);
        auto& made = *pilot.findChild<gui::NewStudyPage*>();
        made.findChild<QLineEdit*>("newStudyFolder")->setText(QString::fromStdString((folder.path() / "new").string()));
        return made;
    }
    /// Opens the study and selects its first participant.
    void openStudy() {
        auto& pilot = studies();
        const auto lists = [&pilot]() -> QTableWidget* {
            auto* list = pilot.findChild<QTableWidget*>("participants");
            return list != nullptr && list->isVisible() && list->rowCount() > 0 ? list : nullptr;
        };
        if (lists() == nullptr) {
            pilot.findChild<gui::StudyPage*>()->open(study());
            QLineEdit* line = nullptr;
            ASSERT_IN_TIME(comesTrue([&] { return (line = window.findChild<QLineEdit*>("passphrase")) != nullptr; }));
            QTest::keyClicks(line, kPassphrase);
            QTest::keyClick(line, Qt::Key_Return);
            ASSERT_IN_TIME(comesTrue([&] { return newest() == nullptr && lists() != nullptr; }, 20'000));
        }
        lists()->selectRow(0);
    }

    /// Returns every place in the program that opens a dialog.
    [[nodiscard]] std::vector<Opening> dialogs() {
        const auto menu = [this](const char* name, const char* entry, const char* in) {
            return Opening{entry, [this, name, entry] { trigger(name, entry); }, in};
        };
        const auto profile = [this](const char* button) {
            return Opening{std::string("Encoding profile: ") + button,
                           [this, button] {
                               page(0, 0);
                               press(window, "Encoding profile…");
                               press(*newest(), button);
                           },
                           "ProfileEditor"};
        };
        const auto ofStudy = [this](const char* button) {
            return Opening{std::string("Study: ") + button,
                           [this, button] {
                               openStudy();
                               studies().findChild<QPushButton*>(button)->click();
                           },
                           "StudyList"};
        };
        const auto ofParticipant = [this](const char* action) {
            return Opening{std::string("Study: ") + action,
                           [this, action] {
                               openStudy();
                               studies().findChild<QAction*>(action)->trigger();
                           },
                           "StudyList"};
        };
        return {
            menu("Bench", "Simulated bench with faults…", "MainWindow"),
            menu("Bench", "Oscilloscope certificates…", "Menus"),
            menu("Bench", "Operator and sample…", "MainWindow"),
            {"Save the plot", [this] { savePlot(); }, "PlotPicture"},
            {"Arm",  // opened while the output is off
             [this] {
                 window.controller().disarm();
                 window.askToArm();
                 deliver();
             },
             "ArmDialog"},
            menu("File", "Open…", "MainWindow"),
            menu("File", "Open recording folder…", "MainWindow"),
            menu("View", "Messages", "RecordingLine"),
            menu("Help", "Keys", "HelpWindow"),
            menu("Help", "Definitions and limits", "HelpWindow"),
            menu("Help", "About Tactoscope", "Menus"),
            {"Not saved", [this] { failToSave(); }, "PlotPicture"},
            {"Encoding profile",
             [this] {
                 page(0, 0);
                 press(window, "Encoding profile…");
             },
             "LiveWorkspace"},
            profile("Open…"),
            profile("Save…"),
            {"Recording's file",
             [this] {
                 for (auto* button : window.findChildren<QPushButton*>()) {
                     if (button->text() == "Open a &recording…") return button->click();
                 }
             },
             "LiveWorkspace"},
            {"Output folder",
             [this] {
                 page(2);
                 press(window, "Wiring");
                 press(window, "Choose the output folder");
             },
             "WiringPanel"},
            {"Profilometer's file",
             [this] {
                 page(1);
                 window.findChild<gui::TabbedPage*>("calibratePages")->setCurrentIndex(1);
                 // A procedure that has just been read begins at its first step.
                 ASSERT_IN_TIME(comesTrue([this] {
                     press(window, "Known reference");
                     return find<QAbstractButton>(window, "Choose the file") != nullptr;
                 }));
                 press(window, "Choose the file");
             },
             "FieldForm"},
            {"Folder of a recording",
             [this] {
                 page(2);
                 press(window, "Wiring");
                 for (auto* action : find<QToolButton>(window, "Add a recording or captures")->menu()->actions()) {
                     if (action->text() == "A &recording as fingertip…") return action->trigger();
                 }
             },
             "WiringPanel"},
            {"Faults of a run's devices",
             [this] {
                 page(2);
                 press(window, "Wiring");
                 for (auto* action : find<QToolButton>(window, "Add a recording or captures")->menu()->actions()) {
                     if (action->text() == "Simulated devices with &faults…") return action->trigger();
                 }
             },
             "WiringPanel"},
            {"Saved instruments",
             [this] {
                 page(2);
                 for (auto* action : find<QToolButton>(window, "Add a recording or captures")->menu()->actions()) {
                     if (action->text() == "Saved &instruments…") return action->trigger();
                 }
             },
             "WiringPanel"},
            {"Script",
             [this] {
                 page(2);
                 press(window, "Script…");
             }},
            {"Limits in force",
             [this] {
                 page(2);
                 press(window, "Settings");
                 press(window, "Read the limits…");
             },
             "WorstPage"},
            {"Rehearsal's folder",
             [this] {
                 auto& pilot = studies();
                 pilot.findChild<gui::TabbedPage*>()->setCurrentIndex(0);
                 press(window, "Choose…");
             },
             "EntryFields"},
            {"Folder of a study", [this] { press(studies(), "Open a study…"); }, "StudyPage"},
            {"Folder of a new study", [this] { press(newStudy(), "Choose…"); }, "EntryFields"},
            {"Passphrase of a new study", [this] { press(newStudy(), "Create the study…"); }, "StudyPage"},
            {"Passphrase of a study",
             [this] {
                 if (studies().findChild<gui::NewStudyPage*>()->isVisible()) press(studies(), "Back");
                 studies().findChild<gui::StudyPage*>()->open(study());
             },
             "StudyPage"},
            ofStudy("enrol"),
            ofStudy("consentOne"),
            ofParticipant("exportResults"),
            ofParticipant("exportWithAbout"),
            ofParticipant("amendStudy"),
            ofParticipant("noteAdverseEvent"),
            ofParticipant("noteNextDay"),
            ofParticipant("note-particulars"),
            ofParticipant("changePassphrase"),
            ofParticipant("pageOfOne"),
            ofParticipant("leaveOne"),
            ofParticipant("withdrawOne"),
            {"Close",  // opened with the output off; deliver() turns it on again
             [this] {
                 window.controller().disarm();
                 page(6);
                 press(window, "New…");
                 gui::ScriptEditor* editor = nullptr;
                 ASSERT_IN_TIME(comesTrue([&] {
                     for (auto* one : window.findChildren<gui::ScriptEditor*>()) {
                         if (one->isVisible()) editor = one;
                     }
                     return editor != nullptr;
                 }));
                 editor->code().append("// not saved");
                 window.close();
                 editor->leave();  // this question needs no answer here
                 deliver();
             },
             "CloseQuestion"},
            {"Export",
             [this] {
                 choose(1);
                 press(window, "Export…");
             },
             "SessionsWorkspace"},
            {"Place of an export",
             [this] {
                 choose(1);
                 press(window, "Export…");
                 press(*newest(), "Choose…");
             },
             "ExportDialog"},
            {"What a certificate states",
             [this] {
                 page(1);
                 window.findChild<gui::TabbedPage*>("calibratePages")->setCurrentIndex(0);
                 press(window, "Settings");
                 press(window, "Certificate…");
             },
             "CertificatePart"},
            {"Report of a session",
             [this] {
                 choose(1);
                 press(window, "Report");
             },
             "ReportView"},
            {"Compare",
             [this] {
                 choose(2);
                 press(window, "Compare two");
             },
             "SessionsWorkspace"},
            {"Open a capture", [this] { fromScope("Open a capture…"); }, "ScopeFiles"},
            {"Save a capture", [this] { fromScope("Save picture as PNG…"); }, "ScopeFiles"},
        };
    }

    const ScratchDir folder;
    gui::MainWindow window{simulatedRegistry};
    QPushButton* stop = nullptr;
    qint64 slowest_ms = 0;
    int tried = 0;
};

TEST_F(StopEverywhere, DISABLED_BehindEveryDialog) {
    // After a click on the window that the dialog blocks, that window has the focus; otherwise the dialog does.
    const std::pair<const char*, std::function<void()>> hands[] = {
        {"a click on STOP", [this] { clickOn(*stop); }},
        {"Esc in the window",
         [this] {
             focus(window);
             type("Escape");
         }},
        {"Pause in the dialog",
         [] {
             focus(*newest());
             type("Pause");
         }},
    };
    const auto openings = dialogs();
    std::map<std::string, int> known;
    for (const auto& opening : openings) {
        if (!opening.in.empty() && !std::ranges::count(kShareAPlace, opening.name)) ++known[opening.in];
    }
    for (const auto& [file, what] : kTriedByAnother) ++known[file];
    EXPECT_EQ(known, placesThatOpenDialogs()) << "app/gui opens a dialog that is not in dialogs(), or one no more";
    for (const auto name : kShareAPlace)
        EXPECT_TRUE(std::ranges::count(openings, name, &Opening::name)) << "no opening is called " << name;
    for (const auto& opening : openings) {
        SCOPED_TRACE(opening.name);
        for (const auto& [how, hand] : hands) {
            for (int tries = 0; tries == 0 || (tries < kTries && !isLive() && wasLate()); ++tries) {
                ASSERT_NO_FATAL_FAILURE(closeAll());
                ASSERT_NO_FATAL_FAILURE(deliver());
                ASSERT_NO_FATAL_FAILURE(opening.open());
                ASSERT_IN_TIME(comesTrue([&] { return newest() != nullptr && newest()->windowHandle()->isExposed(); }));
            }
            if (tried == 0) picture("stop-behind-a-dialog");
            expectStop(how, hand);
            ASSERT_NO_FATAL_FAILURE(closeAll());
        }
    }
    RecordProperty("stops", tried);
    RecordProperty("slowest_ms", int(slowest_ms));
}

TEST_F(StopEverywhere, DISABLED_BehindEveryMenuAndList) {
    std::vector<Opening> popups;
    const auto tryAll = [&] {
        for (const auto& popup : popups) {
            SCOPED_TRACE(popup.name);
            for (const bool byKey : {false, true}) {
                ASSERT_NO_FATAL_FAILURE(deliver());
                // Done by a timer, since a tool button's press returns only after its menu is closed.
                bool done = false;
                QTimer look;
                QObject::connect(&look, &QTimer::timeout, [&] {
                    if (QApplication::activePopupWidget() == nullptr || std::exchange(done, true)) return;
                    if (byKey)
                        expectStop("Esc", [] { type("Escape"); });
                    else
                        expectStop("a click on STOP", [this] { clickOn(*stop); });
                    closePopups();
                });
                look.start(10);
                popup.open();
                ASSERT_IN_TIME(comesTrue([&] { return done && !isLive(); }));
                ASSERT_NO_FATAL_FAILURE(closeAll());
            }
        }
        popups.clear();
    };
    auto* bar = window.menuBar();
    for (auto* action : bar->actions())
        popups.push_back({"menu " + action->text().toStdString(),
                          [bar, action] { clickAt(bar->mapToGlobal(bar->actionGeometry(action).center())); }});
    popups.push_back({"explanation of what has the focus", [] { type("shift+F1"); }});
    ASSERT_NO_FATAL_FAILURE(tryAll());
    for (int shown = 0; shown < 8; ++shown) {
        page(std::max(0, shown - 1), shown == 0 ? 1 : 0);
        letLive(60);
        const auto reachable = [](const QWidget* widget) {
            return widget->isVisible() && widget->isEnabled() &&
                   widget->visibleRegion().contains(widget->rect().center());
        };
        for (auto* list : window.findChildren<QComboBox*>()) {
            if (list->count() > 0 && reachable(list))
                popups.push_back({fmt::format("workspace {}, list {}", shown, list->toolTip().toStdString()),
                                  [list] { clickOn(*list); }});
        }
        for (auto* button : window.findChildren<QToolButton*>()) {
            if (button->menu() != nullptr && button->menu()->actions().size() > 0 && reachable(button))
                popups.push_back({fmt::format("workspace {}, button {}", shown, button->toolTip().toStdString()),
                                  [button] { clickOn(*button); }});
        }
        for (auto* plot : window.findChildren<QCustomPlot*>()) {
            if (reachable(plot) && plot->contextMenuPolicy() != Qt::NoContextMenu &&
                plot->contextMenuPolicy() != Qt::DefaultContextMenu)
                popups.push_back({fmt::format("workspace {}, plot {}", shown, plot->accessibleName().toStdString()),
                                  [plot] { clickOn(*plot, "3"); }});
        }
        ASSERT_NO_FATAL_FAILURE(tryAll());
    }
    RecordProperty("stops", tried);
    RecordProperty("slowest_ms", int(slowest_ms));
}

/// A floating dock that a hand drops on STOP, or that is put there in another way.
TEST_F(StopEverywhere, DISABLED_UnderADockThatFloats) {
    page(0, 0);
    window.findChild<gui::DockColumn*>()->setCollapsed(false);
    letLive(100);
    const auto* bar = window.findChild<gui::SafetyBar*>();
    std::mt19937 random(47);
    const auto placeOf = [](const QWidget& widget) { return QRect(widget.mapToGlobal(QPoint()), widget.size()); };
    for (auto* dock : window.findChild<gui::DockColumn*>()->docks()) {
        SCOPED_TRACE(dock->objectName().toStdString());
        dock->fold(false);
        dock->setFloating(true);
        ASSERT_IN_TIME(comesTrue([&] { return dock->windowHandle() != nullptr && dock->windowHandle()->isExposed(); }));
        letLive(100);
        const auto off = [&] { return !placeOf(*dock).intersects(placeOf(*bar)); };
        for (int tries = 0; tries < 12; ++tries) {
            const auto on = placeOf(*stop);
            const QPoint to(on.x() - std::uniform_int_distribution(0, dock->width() - 1)(random),
                            on.y() - std::uniform_int_distribution(0, dock->height() - 1)(random));
            if (tries % 3 == 2) {
                window.move(window.pos() + QPoint(tries, 3 * tries));
            } else if (tries % 3 == 1) {
                dock->move(to);
            } else {  // grabs the dock by its header
                const double scale = QGuiApplication::primaryScreen()->devicePixelRatio();
                const auto at = [&](const QPoint& point) {
                    return QStringList{"mousemove", QString::number(int(point.x() * scale)),
                                       QString::number(int(point.y() * scale))};
                };
                const auto grip = dock->mapToGlobal(QPoint(dock->width() / 2, 8));
                const auto end = stop->mapToGlobal(stop->rect().center());
                QProcess::execute("xdotool", at(grip) + QStringList{"mousedown", "1"});
                for (const double part : {0.3, 0.6, 0.9, 1.0}) {
                    letLive(30);
                    QProcess::execute("xdotool", at(grip + (end - grip) * part));
                }
                letLive(60);
                QProcess::execute("xdotool", {"mouseup", "1"});
            }
            EXPECT_IN_TIME(comesTrue([&] { return off(); }))
                << tries << ": " << placeOf(*dock).x() << ", " << placeOf(*dock).y() << " " << placeOf(*dock).width()
                << " x " << placeOf(*dock).height();
        }
        EXPECT_TRUE(off());
        ASSERT_NO_FATAL_FAILURE(deliver());
        expectStop("a click on STOP", [this] { clickOn(*stop); });
        dock->setFloating(false);
    }
}

/// Whichever window of the program covers STOP, a press within STOP's rectangle goes to STOP alone.
TEST_F(StopEverywhere, DISABLED_UnderAnotherWindowOfTheProgram) {
    std::mt19937 random(4711);
    const auto tryOn = [&](QWidget& cover, const char* what) {
        int pressed = 0;
        for (auto* button : cover.findChildren<QPushButton*>())
            QObject::connect(button, &QPushButton::pressed, &cover, [&pressed] { ++pressed; });
        for (const auto* button : {"1", "2", "3"}) {
            ASSERT_NO_FATAL_FAILURE(deliver());
            const QPoint in(std::uniform_int_distribution(0, stop->width() - 1)(random),
                            std::uniform_int_distribution(0, stop->height() - 1)(random));
            expectStop(what, [&] { clickAt(stop->mapToGlobal(in), button); });
            EXPECT_EQ(pressed, 0) << what << ": the press went to what lies on top";
        }
    };
    for (const auto flags : {Qt::Window, Qt::Dialog, Qt::Tool, Qt::ToolTip, Qt::Popup, Qt::SplashScreen}) {
        SCOPED_TRACE(int(flags));
        auto cover = std::make_unique<QWidget>(&window, flags | Qt::X11BypassWindowManagerHint);
        (new QVBoxLayout(cover.get()))->addWidget(new QPushButton("By hand"));
        cover->setGeometry(QRect(stop->mapToGlobal(QPoint()), stop->size()).adjusted(-40, -40, 40, 40));
        for (const auto* button : cover->findChildren<QPushButton*>())
            const_cast<QPushButton*>(button)->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
        cover->show();
        cover->raise();
        ASSERT_IN_TIME(comesTrue([&] { return cover->windowHandle()->isExposed(); }));
        letLive(50);
        if (flags != Qt::Popup) {
            ASSERT_NO_FATAL_FAILURE(tryOn(*cover, "a window"));
            continue;
        }
        ASSERT_NO_FATAL_FAILURE(deliver());
        cover->show();
        expectStop("a popup", [this] { clickOn(*stop); });
    }
    // The button is a child of the window itself.
    auto* child = new QPushButton("By hand", &window);
    child->setGeometry(QRect(stop->mapTo(&window, QPoint()), stop->size()));
    child->show();
    child->raise();
    int pressed = 0;
    QObject::connect(child, &QPushButton::pressed, [&] { ++pressed; });
    ASSERT_NO_FATAL_FAILURE(deliver());
    expectStop("a child", [this] { clickOn(*stop); });
    EXPECT_EQ(pressed, 0);
    delete child;
}

/// During a drag, Qt takes every key for itself.
TEST_F(StopEverywhere, DISABLED_WhileTextIsDragged) {
    for (const char* key : {"Escape", "Pause"}) {
        ASSERT_NO_FATAL_FAILURE(deliver());
        trigger("View", "Messages");
        ASSERT_IN_TIME(comesTrue([&] { return newest() != nullptr && newest()->windowHandle()->isExposed(); }));
        auto* log = newest()->findChild<QPlainTextEdit*>();
        ASSERT_NE(log, nullptr);
        log->selectAll();
        const auto from = log->viewport()->mapToGlobal(log->cursorRect(QTextCursor(log->document())).center()) +
                          QPoint(log->fontMetrics().averageCharWidth() * 4, 0);
        const double scale = QGuiApplication::primaryScreen()->devicePixelRatio();
        const auto at = [&](int by) {
            return QStringList{"mousemove", QString::number(int((from.x() + by) * scale)),
                               QString::number(int((from.y() + by) * scale))};
        };
        ASSERT_EQ(QProcess::execute("xdotool", at(0) + QStringList{"mousedown", "1"}), 0);
        letLive(50);
        expectStop(key, [&] {
            // During a drag only the key is pressed: waiting there would delete the window that the key closes,
            // although the drag must still return to that window.
            QTimer::singleShot(300, [key] { type(key); });
            for (const int by : {10, 20, 40}) {
                QProcess::execute("xdotool", at(by));
                letLive(50);
            }
        });
        QProcess::execute("xdotool", {"mouseup", "1"});
        type("Escape");
        ASSERT_NO_FATAL_FAILURE(closeAll());
    }
}

/// A box that Qt or a library opens with a local event loop.
TEST_F(StopEverywhere, DISABLED_BehindABoxThatALibraryOpensModally) {
    ASSERT_NO_FATAL_FAILURE(deliver());
    bool stopped = false;
    QTimer::singleShot(0, [&] {
        ASSERT_IN_TIME(comesTrue([&] { return newest() != nullptr && newest()->windowHandle()->isExposed(); }));
        expectStop("a click on STOP", [this] { clickOn(*stop); });
        stopped = !isLive();
        newest()->close();
    });
    QMessageBox::warning(&window, "Not ours", "This box was opened with exec().");
    EXPECT_TRUE(stopped);
}

}  // namespace
}  // namespace tacto::test
