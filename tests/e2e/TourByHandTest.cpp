// From a first start to a measured pulse and a verdict in five minutes: the built program with an empty home follows
// its tour by mouse and keyboard, at the control that each step frames. The machine's time is measured; the person's is
// computed: four words a second for all text, 1.1 s for each target pointed at, 0.3 s for each key.
//
// Needs its own display (see in-xvfb); skipped elsewhere.
#include <QElapsedTimer>
#include <QRegularExpression>
#include <QSettings>
#include <QTest>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/e2e/BuiltWindow.h"
#include "tests/e2e/Hand.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr double kFiveMinutes_s = 300;
constexpr double kPersonsShare_s = 210;  // most time for the person: the rest is for the machine
constexpr int kSlack_px = 40;            // largest distance between the centres of a control and of its frame

class TourByHand : public testing::Test {
protected:
    TourByHand() {
        RecordProperty("hazard", "H2");
        RecordProperty("hazard", "H12");
        EXPECT_EQ(QGuiApplication::platformName(), "xcb");
    }
    [[nodiscard]] QPoint middleOf(const QString& name) {
        const auto at = built.ask("where " + name).split(' ');
        return at.size() == 2 ? QPoint(at[0].toInt(), at[1].toInt()) : QPoint(-1, -1);
    }
    /// True if the tour frames the widget with this name.
    [[nodiscard]] bool frames(const QString& name) {
        return comesTrue([&] {
            const auto control = middleOf(name), frame = middleOf("tourFrame");
            return control.x() >= 0 && frame.x() >= 0 && (control - frame).manhattanLength() < kSlack_px;
        });
    }
    /// Waits for the step and reads it.
    [[nodiscard]] bool comesTo(const QString& step, int limit_ms = 20'000) {
        if (!comesTrue([&] { return built.text("tourTitle") == step; }, limit_ms)) return false;
        built.person.reads(step + " " + built.text("tourText"));
        return true;
    }
    /// Clicks in the frame once it no longer moves.
    [[nodiscard]] bool clickOnTheFrame() {
        QPoint before(-1, -1);
        const bool still = comesTrue([&] {
            const auto now = middleOf("tourFrame");
            return now.x() >= 0 && std::exchange(before, now) == now;
        });
        return still && built.clickOn("tourFrame");
    }
    /// Clicks in the frame and waits until the frame moves to another place.
    [[nodiscard]] bool followTheFrame() {
        const auto from = middleOf("tourFrame");
        return clickOnTheFrame() && comesTrue([&] {
                   const auto now = middleOf("tourFrame");
                   return now.x() >= 0 && (now - from).manhattanLength() > kSlack_px;
               });
    }
    [[nodiscard]] QString state() { return built.text("interlockState"); }
    /// Returns the amplitude shown in the measurements, in volts; NaN if there is none.
    [[nodiscard]] double amplitude_V() {
        static const QRegularExpression figure(R"(Amplitude \| ([\d.]+) V)");
        const auto found = figure.match(built.text("measurementDock"));
        return found.hasMatch() ? found.captured(1).toDouble() : NAN;
    }
    BuiltWindow built;
    QElapsedTimer machine;
};

TEST_F(TourByHand, DISABLED_LeadsToAMeasuredPulseAndAVerdictInFiveMinutes) {
    machine.start();
    ASSERT_IN_TIME(built.start());

    ASSERT_IN_TIME(comesTo("First, how to stop")) << "the first start begins it";
    ASSERT_IN_TIME(frames("stopButton"));
    ASSERT_TRUE(built.press({"Escape"}));

    ASSERT_IN_TIME(comesTo("Open the simulated bench"));
    ASSERT_IN_TIME(clickOnTheFrame());
    ASSERT_IN_TIME(comesTrue([&] { return state() == "DISARMED"; }));

    ASSERT_IN_TIME(comesTo("Put a surface under the finger"));
    ASSERT_TRUE(built.clickOn("Back"));
    ASSERT_IN_TIME(comesTo("Open the simulated bench"));
    letLive(1500);
    EXPECT_EQ(built.text("tourTitle"), "Open the simulated bench") << "what is done already does not push on again";
    ASSERT_TRUE(built.clickOn("Next"));
    ASSERT_IN_TIME(comesTo("Put a surface under the finger"));
    ASSERT_IN_TIME(frames("surface"));
    ASSERT_IN_TIME(clickOnTheFrame());
    ASSERT_IN_TIME(comesTrue([&] { return !built.ask("popup").isEmpty(); }));
    ASSERT_TRUE(built.enter("glass") && built.press({"Return"}));

    ASSERT_IN_TIME(comesTo("Arm, in two steps"));
    ASSERT_IN_TIME(frames("armButton"));
    ASSERT_IN_TIME(clickOnTheFrame());
    ASSERT_IN_TIME(frames("armOutput")) << "the second step stands in a window of its own";
    EXPECT_EQ(state(), "DISARMED") << "the first step arms nothing";
    built.person.reads(built.text("Arm the output"));
    letLive(1000);  // the second step ignores early clicks, and a person reads meanwhile
    ASSERT_IN_TIME(clickOnTheFrame());
    ASSERT_IN_TIME(comesTrue([&] { return state() == "ARMED"; })) << built.text("Arm the output").toStdString();

    ASSERT_IN_TIME(comesTo("Let the fingertip drive"));
    ASSERT_IN_TIME(frames("driveFingertip"));
    EXPECT_EQ(state(), "ARMED") << "armed, and nothing drives";
    ASSERT_IN_TIME(clickOnTheFrame());

    ASSERT_IN_TIME(comesTo("See a measured pulse"));
    // Drives by hand with the highest roughness and pressure: 40 V every half second.
    ASSERT_TRUE(built.clickOn("driveByHand"));
    for (const auto* field : {"driveRoughness", "drivePressure"}) {
        ASSERT_TRUE(built.clickOn(field) && built.focus());
        ASSERT_TRUE(built.press({"ctrl+a"}) && built.enter("1") && built.press({"Tab"}));
    }
    ASSERT_IN_TIME(comesTrue([&] { return state() == "DELIVERING"; }));
    ASSERT_IN_TIME(comesTrue([&] {
        return built.text("interlockReason").startsWith("A train every 500 ms, set by hand.");
    })) << built.text("interlockReason").toStdString();
    ASSERT_IN_TIME(followTheFrame()) << "to the oscilloscope";
    ASSERT_IN_TIME(comesTrue([&] { return std::abs(amplitude_V() - 40) < 0.8; }))
        << built.text("measurementDock").toStdString();
    const double pulse_s = double(machine.elapsed()) / 1000 + built.person.spent_s();

    ASSERT_IN_TIME(comesTo("Disarm"));
    ASSERT_IN_TIME(frames("armButton"));
    ASSERT_IN_TIME(clickOnTheFrame());
    ASSERT_IN_TIME(comesTrue([&] { return state() == "DISARMED"; }));
    EXPECT_IN_TIME(comesTrue([&] { return built.text("exposureNow").startsWith("Output is off"); }));

    ASSERT_IN_TIME(comesTo("Run a protocol"));
    ASSERT_IN_TIME(followTheFrame()) << "to the workspace";
    ASSERT_IN_TIME(frames("runButton"));
    ASSERT_IN_TIME(clickOnTheFrame());
    ASSERT_IN_TIME(comesTrue([&] { return built.text("tourPlace").contains("done"); }, 150'000));
    const auto verdict = built.text("verdict");
    EXPECT_EQ(verdict, "PASS");
    built.person.reads(verdict + " " + built.text("verdictReasons"));

    ASSERT_IN_TIME(comesTo("Everything is kept"));
    ASSERT_IN_TIME(clickOnTheFrame());
    ASSERT_IN_TIME(comesTrue([&] { return !built.stands("tourTitle"); }, 30'000)) << "it is over";
    const double machine_s = double(machine.elapsed()) / 1000;
    const double person_s = built.person.spent_s();
    RecordProperty("pulse_s", std::to_string(pulse_s));
    RecordProperty("machine_s", std::to_string(machine_s));
    RecordProperty("person_s", std::to_string(person_s));
    std::printf("machine %.1f s, person %.1f s of 300 s; measured pulse after %.1f s\n", machine_s, person_s, pulse_s);
    EXPECT_GT(person_s, 60) << "what is to be read was not counted";
    EXPECT_LT(person_s, kPersonsShare_s) << "the tour has too much to read";
    EXPECT_IN_TIME(machine_s < kFiveMinutes_s - person_s)
        << "machine " << machine_s << " s, reading, pointing and typing " << person_s << " s";

    ASSERT_IN_TIME(built.leaves());
    const QSettings settings(built.home() + "/config/tactoscope/tactoscope.conf", QSettings::IniFormat);
    EXPECT_TRUE(settings.value("tourDone").toBool());
}

}  // namespace
}  // namespace tacto::test
