// Tests the whole window with keys and mouse.
#include <QAbstractButton>
#include <QDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QStatusBar>
#include <QTest>
#include <QToolButton>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/TabbedPage.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/MainWindow.h"
#include "app/run/RunFiles.h"
#include "tests/gui/window/TickingRun.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/InTime.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using gui::Activity;
using testing::HasSubstr;

/// A program that was moved without its resource files.
class WithoutResources : public Window {
protected:
    WithoutResources()
        : Window([] {
              ::setenv("TACTOSCOPE_RESOURCES", "/no/such/folder", 1);
              return simulatedRegistry();
          }) {}
    ~WithoutResources() override { ::unsetenv("TACTOSCOPE_RESOURCES"); }
};

TEST_F(WithoutResources, ItSaysSoAtOnceAndWhatWouldHelp) {
    EXPECT_THAT(banner().toStdString(), HasSubstr("TACTOSCOPE_RESOURCES is /no/such/folder, a folder with protocols/"));
}

TEST_F(Window, TheBenchMenuOffersWhatCanBeDone) {
    RecordProperty("hazard", "H12");
    const auto offered = [this](const QString& text) {
        for (const auto* menu : window.findChildren<QMenu*>()) {
            if (menu->title().remove('&') != "Bench") continue;
            for (const auto* action : menu->actions())
                if (action->text().remove('&') == text) return action->isEnabled();
        }
        ADD_FAILURE() << "no menu has " << text.toStdString();
        return false;
    };
    for (const auto* text : {"Close", "Arm…", "Disarm", "Pause", "Resume", "Reset fault", "Check impedance"})
        EXPECT_FALSE(offered(text)) << text;
    EXPECT_TRUE(offered("STOP (Esc)")) << "always";
    open();
    for (const auto* text : {"Close", "Arm…", "Disarm", "Pause", "Resume"}) EXPECT_TRUE(offered(text)) << text;
    window.controller().close();
    EXPECT_IN_TIME(comesTrue([&] { return !offered("Close") && !offered("Arm…"); }));
}

TEST_F(Window, ADisconnectedBenchSaysWhyAndWhatToDo) {
    RecordProperty("hazard", "H12");
    const auto* words = static_cast<const gui::ElidedLabel*>(window.findChild<QLabel*>("interlockReason"));
    const auto says = [&] { return words->shownText().toStdString(); };
    EXPECT_EQ(says(), "No bench is open. Ctrl+B opens a simulated one.");
    open();
    const auto order = tickingRun(window.controller(), "slow-ticks");
    ASSERT_TRUE(order) << order.error().message;
    static_cast<void>(window.controller().run(*order));
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == Activity::Running; }));
    window.controller().stop("test");
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == Activity::Closed; }));
    EXPECT_IN_TIME(comesTrue([&] { return says() == "Closed by a run. Ctrl+B opens a simulated one."; })) << says();
    open();
    window.controller().close();
    EXPECT_IN_TIME(comesTrue([&] { return says() == "No bench is open. Ctrl+B opens a simulated one."; })) << says();
}

TEST_F(Window, ArmingTakesTwoSteps) {
    RecordProperty("hazard", "H12");
    open();
    click(*window.findChild<QPushButton*>("armButton"));
    auto* second = window.findChild<QPushButton*>("armOutput");
    ASSERT_NE(second, nullptr);
    key(Qt::Key_Return);  // the dialog's default is not to arm
    letLive(200);
    EXPECT_EQ(state(), InterlockState::Disarmed);
    arm();
    EXPECT_IN_TIME(state() == InterlockState::Armed);
}

TEST_F(Window, CheckingTheImpedanceTakesTwoStepsAndEndsDisarmed) {
    RecordProperty("hazard", "H12");
    open();
    auto* first = window.findChild<QPushButton*>("impedanceButton");
    ASSERT_NE(first, nullptr);
    click(*first);
    auto* second = window.findChild<QPushButton*>("checkImpedance");
    ASSERT_NE(second, nullptr) << "one click was enough";
    ASSERT_IN_TIME(comesTrue([&] { return second->isVisible(); }));
    const auto* text = window.findChild<QLabel*>("armingText");
    ASSERT_NE(text, nullptr);
    EXPECT_THAT(text->text().toStdString(), HasSubstr("into 1\u202fkΩ, up to 40\u202fV"));
    EXPECT_TRUE(std::isnan(window.controller().telemetry().impedance_ohm));
    click(*second);
    ASSERT_IN_TIME(comesTrue([this] {
        const auto widgets = window.statusBar()->findChildren<QWidget*>();
        return std::any_of(widgets.begin(), widgets.end(),
                           [](const QWidget* widget) { return widget->toolTip().contains("Ω. Disarmed."); });
    }));
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST_F(Window, AHeldReturnDoesNotArm) {
    RecordProperty("hazard", "H12");
    open();
    click(*window.findChild<QPushButton*>("armButton"));
    auto* second = window.findChild<QPushButton*>("armOutput");
    ASSERT_IN_TIME(comesTrue([&] { return second->isVisible(); }));
    second->setFocus();
    QKeyEvent repeat(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier, "\r", true);
    QCoreApplication::sendEvent(second, &repeat);
    letLive(200);
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST_F(Window, AKeyHeldSinceTheFirstStepDoesNotTakeTheSecond) {
    RecordProperty("hazard", "H12");
    open();
    auto* first = window.findChild<QPushButton*>("armButton");
    first->setFocus();
    // X sends a held key like this: presses and releases, most of them not marked as repeats.
    const auto press = [](QWidget* widget) {
        QKeyEvent down(QEvent::KeyPress, Qt::Key_Return, Qt::NoModifier, "\r");
        QCoreApplication::sendEvent(widget, &down);
    };
    const auto repeat = [&](QWidget* widget) {
        QKeyEvent up(QEvent::KeyRelease, Qt::Key_Return, Qt::NoModifier, "\r");
        QCoreApplication::sendEvent(widget, &up);
        press(widget);
    };
    press(first);
    auto* second = window.findChild<QPushButton*>("armOutput");
    ASSERT_IN_TIME(comesTrue([&] { return second->isVisible(); }));
    second->setFocus();
    letLive(gui::ConfirmButton::kDebounce_ms + 160);  // long enough for a held key to repeat
    for (int i = 0; i < 10; ++i) {
        repeat(second);
        letLive(30);
    }
    EXPECT_EQ(state(), InterlockState::Disarmed);
    EXPECT_TRUE(second->isVisible());
    QKeyEvent up(QEvent::KeyRelease, Qt::Key_Return, Qt::NoModifier, "\r");
    QCoreApplication::sendEvent(second, &up);
    letLive(300);
    press(second);
    EXPECT_IN_TIME(comesTrue([this] { return state() == InterlockState::Armed; })) << "a press of its own does";
}

TEST_F(Window, TheSecondHalfOfADoubleClickAndAHeldLetterDoNotTakeTheSecondStep) {
    RecordProperty("hazard", "H12");
    open();
    QTest::mouseClick(window.findChild<QPushButton*>("armButton"), Qt::LeftButton);
    auto* second = window.findChild<QPushButton*>("armOutput");
    ASSERT_IN_TIME(comesTrue([&] { return second->isVisible(); }));
    QTest::mouseClick(second, Qt::LeftButton);
    QTest::mouseDClick(second, Qt::LeftButton);
    letLive(gui::ConfirmButton::kDebounce_ms + 100);
    for (int i = 0; i < 5; ++i) {
        QTest::keyClick(second->window(), Qt::Key_A, Qt::AltModifier);
        letLive(30);
    }
    EXPECT_EQ(state(), InterlockState::Disarmed);
    EXPECT_FALSE(second->text().contains('&'));
}

TEST_F(Window, AStopBetweenTheTwoStepsVoidsTheFirst) {
    RecordProperty("hazard", "H12");
    open();
    for (const char* name : {"armOutput", "checkImpedance"}) {
        click(*window.findChild<QPushButton*>(name == std::string_view("armOutput") ? "armButton" : "impedanceButton"));
        QPointer<QPushButton> second = window.findChild<QPushButton*>(name);
        ASSERT_IN_TIME(comesTrue([&] { return second != nullptr && second->isVisible(); })) << name;
        key(Qt::Key_Pause);
        EXPECT_IN_TIME(comesTrue([&] { return second == nullptr || !second->isVisible(); })) << name;
        letLive(200);
    }
    EXPECT_EQ(state(), InterlockState::Disarmed);
    const auto asked = window.controller().mark();
    window.controller().stop("the test");
    ArmRequest request;
    request.operatorConfirmed = true;
    window.controller().arm(request, asked);
    letLive(300);
    EXPECT_EQ(state(), InterlockState::Disarmed);
}

TEST_F(Window, EscStopsFromInsideAModalDialog) {
    RecordProperty("hazard", "H2");
    open();
    arm();
    deliver();
    QDialog dialog(&window);
    dialog.setModal(true);
    QLineEdit field(&dialog);
    dialog.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&dialog));
    field.setFocus();
    QTest::keyClick(dialog.windowHandle(), Qt::Key_Escape);
    EXPECT_EQ(state(), InterlockState::Disarmed) << "before the key event returned";
}

TEST_F(Window, TheLastMessageDoesNotSayArmedWhenThatIsOver) {
    RecordProperty("hazard", "H9");
    const auto says = [this](const char* words) {
        for (const auto* button : window.statusBar()->findChildren<QToolButton*>()) {
            if (button->toolTip().contains(words)) return true;
        }
        return false;
    };
    open();
    arm();
    ASSERT_IN_TIME(comesTrue([&] { return says("Armed."); }));
    key(Qt::Key_Pause);
    EXPECT_IN_TIME(comesTrue([&] { return says("Disarmed: ") && says("Output is off."); }));
    EXPECT_FALSE(says("Armed."));
    arm();
    ASSERT_IN_TIME(comesTrue([&] { return says("Armed."); }));
    window.controller().close();
    EXPECT_IN_TIME(comesTrue([&] { return says("Output is off.") && !says("Armed."); }));
}

TEST_F(Window, TheLastMessageHasItsTimeAndIsReadWholeInASmallWindow) {
    const auto* message = window.statusBar()->findChild<QToolButton*>("lastMessage");
    ASSERT_NE(message, nullptr);
    const auto isWhole = [&] {
        static const QRegularExpression timed(R"(^([01]\d|2[0-3]):[0-5]\d:[0-5]\d (.+)$)");
        const auto found = timed.match(message->text());
        return found.hasMatch() && found.captured(2) == message->toolTip().section('\n', 0, 0) &&
               message->fontMetrics().horizontalAdvance(message->text()) <= message->width();
    };
    open();
    arm();
    deliver();
    key(Qt::Key_Escape);
    ASSERT_IN_TIME(comesTrue([&] { return message->toolTip().contains("Output is off."); }));
    const auto* recording = window.findChild<QLabel*>("recording");
    for (const int width : {1024, 1280, 1024}) {
        window.resize(width, width * 3 / 4);
        EXPECT_IN_TIME(comesTrue(isWhole)) << message->text().toStdString() << " at " << width;
        EXPECT_GT(recording->width(), 0) << "and that it is recorded is still there";
        EXPECT_EQ(window.width(), width);
        shot(*window.statusBar(), QString("last-message-%1").arg(width));
    }
}

TEST_F(Window, TheQuestionToArmIsVoidWithTheBenchItWasAskedFor) {
    RecordProperty("hazard", "H12");
    open();
    click(*window.findChild<QPushButton*>("armButton"));
    QPointer<QPushButton> second = window.findChild<QPushButton*>("armOutput");
    ASSERT_IN_TIME(comesTrue([&] { return second != nullptr && second->isVisible(); }));
    window.controller().close();
    EXPECT_IN_TIME(comesTrue([&] { return second == nullptr; })) << "it would arm whatever is opened next";
}

TEST_F(Window, SpaceStopsInEveryWorkspace) {
    RecordProperty("hazard", "H2");
    open();
    for (int page = 0; page < 7; ++page) {
        arm();
        visit(page);
        window.setFocus();
        key(Qt::Key_Space);
        EXPECT_EQ(state(), InterlockState::Disarmed) << page;
    }
}

TEST(WindowsStart, AWorkspaceIsMadeWhenItIsFirstShown) {
    QSettings().clear();
    gui::MainWindow window(simulatedRegistry);
    const auto runners = [&] { return window.findChildren<gui::ProtocolWorkspace*>().size(); };
    window.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    letLive(50);
    EXPECT_EQ(runners(), 0);
    for (const auto& [page, made] : {std::pair{6, 1}, {3, 2}, {1, 4}, {2, 5}, {4, 5}, {5, 5}, {6, 5}}) {
        window.showWorkspace(page);
        EXPECT_EQ(window.workspace(), page);
        EXPECT_EQ(runners(), made) << page;
    }
    window.showWorkspace(6);
    window.close();
    // The window returns as it was left. A window closed before it was ever shown also asks its questions.
    gui::MainWindow again(simulatedRegistry);
    EXPECT_EQ(again.workspace(), 6);
    EXPECT_EQ(again.findChildren<gui::ProtocolWorkspace*>().size(), 1);
    QSettings().clear();
    gui::MainWindow unseen(simulatedRegistry);
    unseen.closeUnasked();
    EXPECT_FALSE(unseen.isVisible());
}

TEST(WindowsStart, AWorkspaceThatIsFirstShownWhileOnlyPlotsAreHasNoPathEither) {
    QSettings().clear();
    gui::MainWindow window(simulatedRegistry);
    window.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    const auto pathIsShown = [&] { return find<QWidget>(window, "path") != nullptr; };
    window.showPlotOnly(true);
    window.showWorkspace(3);
    EXPECT_IN_TIME(comesTrue([&] { return !pathIsShown(); }));
    window.showPlotOnly(false);
    EXPECT_IN_TIME(comesTrue(pathIsShown));
    window.close();
}

TEST(WindowsStart, AFrameThatComesLateFitsTheScreenToo) {
    QSettings().clear();
    gui::MainWindow window(simulatedRegistry);
    const auto screen = window.screen()->availableGeometry();
    window.setWindowFlag(Qt::FramelessWindowHint);
    window.setGeometry(screen);
    window.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    letLive(100);
    ASSERT_EQ(window.geometry(), screen);
    ASSERT_EQ(window.frameGeometry(), screen) << "no frame yet";
    // A busy window manager does this late: it frames the window and moves it into the frame.
    window.windowHandle()->setFlag(Qt::FramelessWindowHint, false);
    window.windowHandle()->setPosition(screen.topLeft() + QPoint(4, 4));
    ASSERT_IN_TIME(comesTrue([&] { return window.frameGeometry() != window.geometry(); })) << "there is a frame";
    EXPECT_IN_TIME(comesTrue([&] { return screen.contains(window.frameGeometry()); }))
        << window.frameGeometry().right() << ", " << window.frameGeometry().bottom() << " of " << screen.right() << ", "
        << screen.bottom();
    window.close();
}

TEST_F(Window, AnUnplugDuringDeliveryIsSaidWithWhatItMeans) {
    RecordProperty("hazard", "H2");
    ASSERT_NO_FATAL_FAILURE(open());
    ASSERT_NO_FATAL_FAILURE(unplugWhile(1, 1));
    auto* word = window.findChild<QLabel*>("interlockState");
    EXPECT_IN_TIME(comesTrue([&] { return word->text() == "FAULTED"; }));
    click(*window.findChild<QPushButton*>("armButton"));  // the button "Reset fault"
    EXPECT_IN_TIME(comesTrue([this] { return banner().contains("ot reset"); })) << banner().toStdString();
    EXPECT_THAT(banner().toStdString(), HasSubstr("Output is off"));
}

TEST_F(Window, ASessionThatCannotBeWrittenIsSaidAndTheWindowLives) {
    RecordProperty("hazard", "H8");
    const auto folder = userSessionsFolder();
    std::filesystem::create_directories(folder.parent_path());
    std::filesystem::remove_all(folder);
    { std::ofstream file(folder); }  // a file instead of the folder
    key(Qt::Key_B, Qt::ControlModifier);
    EXPECT_IN_TIME(comesTrue([this] { return !banner().isEmpty(); }));
    EXPECT_THAT(banner().toStdString(), HasSubstr("sessions"));
    EXPECT_EQ(window.controller().activity(), Activity::Closed);
    std::filesystem::remove(folder);
    key(Qt::Key_B, Qt::ControlModifier);
    EXPECT_IN_TIME(comesTrue([this] { return window.controller().activity() == Activity::Live; }));
}

TEST_F(Window, AFileThatIsNothingOfOursIsRefusedInOneSentence) {
    const ScratchDir folder;
    window.openFile(QString::fromStdString(folder.write("notes.txt", "hello").string()));
    EXPECT_THAT(banner().toStdString(), HasSubstr("notes.txt"));
    window.openFile(QString::fromStdString(folder.path().string()));
    EXPECT_THAT(banner().toStdString(), HasSubstr("recording.json"));
    EXPECT_FALSE(banner().contains('\n'));
    window.openFile(QString::fromStdString(folder.write("words.csv", "hello\nworld\n").string()));
    const auto* problem = window.findChild<QLabel*>("scopeProblem");
    ASSERT_IN_TIME(comesTrue([&] { return problem->isVisible() && problem->text().contains("words.csv"); }));
    shot(window, "capture-refused");
}

TEST_F(Window, TheExampleRecordingReplays) {
    window.openFile(QString::fromStdString((sourceDir() / "resources" / "examples" / "linen-slide").string()));
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == Activity::Live; }));
    ASSERT_IN_TIME(comesTrue([this] { return window.controller().telemetry().contact; }));
    EXPECT_EQ(window.workspace(), 0);
}

TEST_F(Window, EveryControlHasAToolTipOrALabelOfItsOwn) {
    open();
    for (int page = 0; page < 7; ++page) {
        visit(page);
        QCoreApplication::processEvents();
        for (const auto* button : window.findChildren<QAbstractButton*>()) {
            if (!button->isVisible() || button->objectName().startsWith("qt_")) continue;
            EXPECT_FALSE(button->text().isEmpty() && button->accessibleName().isEmpty() && button->toolTip().isEmpty())
                << page << ": " << button->metaObject()->className() << " in "
                << button->parent()->metaObject()->className();
        }
    }
}

/// Counts how often a widget was hidden, and how often the controller was already gone then.
class Witness final : public QObject {
public:
    explicit Witness(gui::BenchController& controller) : controller_(&controller) {}
    int hidden = 0, late = 0;

protected:
    bool eventFilter(QObject*, QEvent* event) override {
        if (event->type() != QEvent::Hide) return false;
        ++hidden;
        if (controller_.isNull()) ++late;
        return false;
    }

private:
    QPointer<gui::BenchController> controller_;
};

TEST(WindowsEnd, AWindowDeletedWhileShownHidesBeforeItsControllerIsGone) {
    auto window = std::make_unique<gui::MainWindow>(simulatedRegistry);
    window->showWorkspace(0);
    window->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
    Witness witness(window->controller());
    window->findChild<gui::TabbedPage*>("livePage")->installEventFilter(&witness);
    window.reset();
    EXPECT_GE(witness.hidden, 1);
    EXPECT_EQ(witness.late, 0);
}

}  // namespace
}  // namespace tacto::test
