// Tests the state block: its word is readable from two metres, and a sentence says what is being done and what to do.
#include <QTest>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/SafetyBar.h"
#include "app/gui/window/StateBlock.h"
#include "app/gui/window/StateWords.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/window/TickingRun.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::StartsWith;

constexpr int kStates = int(InterlockState::Faulted) + 1;

Telemetry inState(InterlockState state, DriveSource driving = DriveSource::Off) {
    Telemetry telemetry;
    telemetry.state = state;
    telemetry.driving = driving;
    if (state == InterlockState::Faulted) telemetry.reason = "the electrode is open";
    return telemetry;
}

std::string wordsOf(const Telemetry& telemetry, const QString& protocol = {}) {
    return gui::stateWords(telemetry, protocol).replace(QChar(0x202f), ' ').toStdString();
}

TEST(StateWords, SayWhatIsDeliveredAndByWhom) {
    RecordProperty("hazard", "H12");
    auto now = inState(InterlockState::Delivering, DriveSource::Manual);
    now.interval_s = 0.5;
    EXPECT_EQ(wordsOf(now), "A train every 500 ms, set by hand. Space stops.");
    now.interval_s = 1.25;
    EXPECT_EQ(wordsOf(now), "A train every 1.25 s, set by hand. Space stops.") << "as it is commanded now";
    now.driving = DriveSource::Sensor;
    now.finger = FingerStanding::Fresh;
    EXPECT_EQ(wordsOf(now), "From the fingertip, every 1.25 s. Space stops.");
    now.interval_s = NAN;
    EXPECT_EQ(wordsOf(now), "No train: the fingertip feels nothing. Space stops.") << "nothing is commanded";
    now.driving = DriveSource::Off;
    EXPECT_EQ(wordsOf(now), "The last train ends by itself. Space stops.");
    for (const auto drive : {DriveSource::Off, DriveSource::Manual}) {
        now.driving = drive;
        EXPECT_EQ(wordsOf(now, "Separability"), "Protocol Separability drives. Space stops.");
    }
}

TEST(StateWords, SayInEveryStateWhatToDo) {
    for (int state = 0; state < kStates; ++state) {
        for (const auto drive : {DriveSource::Off, DriveSource::Manual, DriveSource::Sensor}) {
            for (const auto* protocol : {"", "Separability"})
                EXPECT_NE(wordsOf(inState(InterlockState(state), drive), protocol), "") << state << ", " << int(drive);
        }
    }
    EXPECT_EQ(wordsOf(inState(InterlockState::Armed)), "Choose a drive to deliver.");
    EXPECT_EQ(wordsOf(inState(InterlockState::Armed), "Separability"),
              "Armed by the protocol Separability. Space stops.")
        << "a person has no drive to choose while a protocol has the bench";
    auto stopped = inState(InterlockState::Disarmed);
    stopped.reason = "operator (STOP)";
    EXPECT_EQ(wordsOf(stopped), "Output is off: stopped with STOP. “Arm…” goes on.");
}

class StateOnTheBar : public testing::Test {
protected:
    QLabel& word() { return *bar.findChild<QLabel*>("interlockState"); }
    gui::ElidedLabel& says() { return *static_cast<gui::ElidedLabel*>(bar.findChild<QLabel*>("interlockReason")); }
    gui::BenchController controller{simulatedRegistry};
    gui::CalibrationBook calibrations{controller};
    gui::SafetyBar bar{controller, calibrations};
};

/// Height in pixels between the highest and the lowest row in this colour.
int heightOfInk(const QImage& drawn, const QColor& ink) {
    int top = drawn.height(), bottom = -1;
    for (int y = 0; y < drawn.height(); ++y) {
        for (int x = 0; x < drawn.width(); ++x) {
            if (drawn.pixelColor(x, y).rgb() != ink.rgb()) continue;
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
    }
    return bottom - top + 1;
}

TEST_F(StateOnTheBar, ItsWordIsReadFromTwoMetresInEverySizeStateAndTheme) {
    RecordProperty("hazard", "H12");
    bar.show();
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
            gui::applyTheme(theme);
            for (const int width : {1280, 1440, 1920}) {
                bar.resize(width, bar.sizeHint().height());
                for (int state = 0; state < kStates; ++state) {
                    bar.refresh(inState(InterlockState(state)));
                    QCoreApplication::processEvents();
                    const auto style = gui::stateStyle(InterlockState(state));
                    SCOPED_TRACE(testing::Message() << style.word.toStdString() << " at " << percent << " % in "
                                                    << width << (theme == gui::Theme::Dark ? ", dark" : ", light"));
                    const QFontMetrics metrics(word().font());
                    EXPECT_GE(word().font().pointSizeF(), 28 - 1e-6);
                    EXPECT_GE(word().width(), metrics.horizontalAdvance(word().text())) << "it is cut";
                    // Measured as drawn, also in the style sheet's font, on the block's own background.
                    EXPECT_GE(heightOfInk(word().grab().toImage(), style.ink), 0.9 * metrics.capHeight());
                    EXPECT_GE(contrast(style.ink, style.ground), 4.5);
                    shot(bar, QString("state-%1-%2-%3-%4")
                                  .arg(percent)
                                  .arg(theme == gui::Theme::Dark ? "dark" : "light")
                                  .arg(width)
                                  .arg(style.word.toLower()));
                }
            }
        }
    }
}

/// While every train is refused, no message may say that another one follows, whatever drives the output.
TEST_F(StateOnTheBar, NoTrainIsSaidToFollowWhileALimitRefusesThem) {
    RecordProperty("hazard", "H12");
    std::mt19937 draw(47);
    auto now = inState(InterlockState::Armed, DriveSource::Manual);
    bar.refresh(now);
    bool refused = false;
    for (int frame = 0; frame < 400; ++frame) {
        const auto happens = draw() % 4;
        if (happens == 0) {
            ++now.trainsDelivered;
            now.state = InterlockState::Delivering;
            refused = false;
        } else if (happens == 1) {
            ++now.trainsRefused;
            refused = true;
        }
        now.driving = draw() % 8 == 0 ? DriveSource::Sensor : DriveSource::Manual;
        now.finger = now.driving == DriveSource::Sensor ? FingerStanding::Fresh : FingerStanding::None;
        now.interval_s = 0.5;
        bar.refresh(now);
        EXPECT_EQ(says().text().contains("a limit refuses it"), refused) << says().text().toStdString();
        if (refused) {
            EXPECT_FALSE(says().text().contains("very 500")) << says().text().toStdString();
        }
    }
    now.driving = DriveSource::Off;
    ++now.trainsRefused;
    bar.refresh(now);
    EXPECT_FALSE(says().text().contains("refuses")) << "nothing is asked for any more";
}

TEST_F(StateOnTheBar, WhatIsDeliveredStandsThereWhole) {
    RecordProperty("hazard", "H12");
    bar.show();
    bar.resize(1280, bar.sizeHint().height());
    for (const auto drive : {DriveSource::Manual, DriveSource::Sensor}) {
        for (const auto state : {InterlockState::Armed, InterlockState::Delivering}) {
            auto now = inState(state, drive);
            now.interval_s = 1.25;
            bar.refresh(now);
            QCoreApplication::processEvents();
            EXPECT_EQ(says().shownText().toStdString(), says().text().toStdString());
        }
    }
}

TEST_F(StateOnTheBar, NamesTheProtocolThatHasTheBench) {
    RecordProperty("hazard", "H12");
    const auto order = tickingRun(controller, "slow-ticks");
    ASSERT_TRUE(order) << order.error().message;
    static_cast<void>(controller.run(*order));
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Running; }));
    bar.refresh(inState(InterlockState::Delivering, DriveSource::Manual));
    EXPECT_THAT(says().text().toStdString(), StartsWith("Protocol Slow ticks drives."));
    controller.stop("test");
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Closed; }));
    bar.refresh(inState(InterlockState::Delivering, DriveSource::Manual));
    EXPECT_THAT(says().text().toStdString(), StartsWith("Set by hand."));
}

}  // namespace
}  // namespace tacto::test
