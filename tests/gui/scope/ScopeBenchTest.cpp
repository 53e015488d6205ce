// The oscilloscope when things do not go as wished: no trigger, no oscilloscope; and figures for other workspaces.
#include <QPushButton>
#include <QToolButton>
#include <gmock/gmock.h>

#include "app/gui/look/Look.h"
#include "app/gui/scope/MeasurementSummary.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"

namespace tacto::test {
namespace {

using gui::ScopeMode;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(Scope, AutoShowsTheSignalUntriggeredAndSaysSo) {
    openBench();
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    ASSERT_FALSE(triggered());
    ASSERT_TRUE(comes([&] { return QString::fromStdString(status()).startsWith("No trigger at"); }));
    EXPECT_THAT(status(), AllOf(HasSubstr("shown untriggered, not measured"), HasSubstr("Output is disarmed.")));
    EXPECT_EQ(scope.view().overlay().note, "not triggered");
    EXPECT_THAT(scope.view().xAxis->label().toStdString(), HasSubstr("record's begin"));
    EXPECT_EQ(scope.table().statistics().captures(), 0U);
    EXPECT_NE(find<QLabel>(scope, "Untriggered: nothing is measured. Measurements appear with the first trigger."),
              nullptr);
    const auto first = scope.view().shown();
    ASSERT_TRUE(comes([&] { return scope.view().shown() != first; })) << "and goes on";
    shot(scope, "free-run");
    deliver();
    ASSERT_TRUE(comes([&] { return triggered(); }));
    EXPECT_EQ(scope.view().overlay().note, "");
    ASSERT_TRUE(comes([&] { return scope.table().statistics().captures() >= 4; }));
    EXPECT_TRUE(triggered()) << "between slow trains the picture does not jump";
    desk.stop("test");
    ASSERT_TRUE(comes([&] { return !triggered(); }));
    const auto counted = scope.table().statistics().captures();
    const auto quiet = scope.view().shown();
    ASSERT_TRUE(comes([&] { return scope.view().shown() != quiet; }));
    EXPECT_EQ(scope.table().statistics().captures(), counted) << "what is not triggered is not counted";
    EXPECT_THAT(complaints, testing::IsEmpty());
}

TEST_F(Scope, NormalWaitsForItsTrigger) {
    scope.setMode(ScopeMode::Normal);
    openBench(nullptr, 4);
    const auto at = desk.telemetry().at;
    ASSERT_TRUE(comes([&] { return desk.telemetry().at > at + std::chrono::seconds(4); }));
    EXPECT_EQ(scope.view().shown(), nullptr);
    EXPECT_THAT(status(), StartsWith("Waiting for a trigger at"));
}

TEST_F(Scope, AnOscilloscopeThatIsUnpluggedWhileItWaitsSaysWhatHappenedAndGoesOnOnceItIsBack) {
    RecordProperty("hazard", "H9");
    scope.setMode(ScopeMode::Normal);
    openBench("sim:oscilloscope?fault=unplug@2s..6s", 2);
    ASSERT_TRUE(comes([&] { return scope.running(); }));
    ASSERT_TRUE(comes([&] { return !scope.running(); })) << status();
    EXPECT_THAT(status(), AllOf(HasSubstr("The oscilloscope stopped: the simulated oscilloscope is unplugged."),
                                HasSubstr("Output is off."), HasSubstr("press Run")));
    EXPECT_FALSE(complaints.isEmpty()) << "who looks elsewhere hears of it too";
    shot(scope, "unplugged");
    auto* run = find<QPushButton>(scope, "Run");
    ASSERT_NE(run, nullptr);
    ASSERT_TRUE(run->isEnabled());
    click(*run);
    ASSERT_TRUE(comes([&] { return scope.running(); }));
    ASSERT_TRUE(comes([&] { return !scope.running(); })) << "it is not back yet";
    EXPECT_THAT(status(), HasSubstr("is unplugged"));
    ASSERT_TRUE(comes([&] { return desk.telemetry().at > std::chrono::seconds(6); }));
    EXPECT_FALSE(scope.running()) << "not by itself";
    QTest::keyClick(&scope.view(), Qt::Key_A);
    ASSERT_TRUE(comes([&] { return scope.view().shown() != nullptr; }));
    EXPECT_TRUE(scope.running());
    EXPECT_THAT(status(), HasSubstr("trigger"));
}

TEST_F(Scope, AnOscilloscopeThatFailsDuringDeliveryTellsThatTheOutputGoesOn) {
    RecordProperty("hazard", "H9");
    openBench("sim:oscilloscope?fault=garbage@9s", 2);
    deliver();
    ASSERT_TRUE(comes([&] { return triggered(); }));
    ASSERT_TRUE(comes([&] { return !scope.running(); }));
    EXPECT_THAT(status(), AllOf(HasSubstr("answered with garbage"), HasSubstr("goes on unmeasured: STOP ends it")));
    EXPECT_NE(desk.telemetry().state, InterlockState::Disarmed);
    EXPECT_TRUE(triggered()) << "the last capture stays";
    desk.close();
    ASSERT_TRUE(comes([&] { return desk.activity() == gui::Activity::Closed; }));
    EXPECT_THAT(status(), HasSubstr("No bench is open."));
    openBench();
    EXPECT_TRUE(comes([&] { return scope.running(); })) << "another bench, another oscilloscope";
}

QString figure(const QWidget& summary, const QString& name) {
    const auto* label = find<QLabel>(summary, name);
    return label == nullptr ? QString("not there") : label->text();
}

class Summary : public testing::Test {
protected:
    Summary() {
        summary.resize(300, 240);
        summary.show();
    }
    std::string head() { return summary.findChild<QLabel*>("summaryHead")->text().toStdString(); }
    gui::MeasurementSummary summary;
};

TEST_F(Summary, ShowsTheLatestCapturesFiguresByChannel) {
    EXPECT_THAT(head(), HasSubstr("Nothing is measured yet"));
    const auto shown = prepared(twoPulses());
    summary.take(shown);
    const auto& volts = shown->measurement[0];
    EXPECT_EQ(figure(summary, "Amplitude of Voltage"), quantityText(volts.amplitude.mean, "V"));
    EXPECT_EQ(figure(summary, "Width of Voltage"), quantityText(volts.width_s.mean, "s"));
    EXPECT_EQ(figure(summary, "Interval of Current"), quantityText(volts.interval_s.mean, "s"));
    EXPECT_THAT(figure(summary, "Charge of Current").toStdString(), AllOf(StartsWith("8.0"), HasSubstr("µC")));
    EXPECT_EQ(figure(summary, "Charge of Voltage"), "–");
    EXPECT_THAT(find<QLabel>(summary, "Charge of Voltage")->toolTip().toStdString(), HasSubstr("current channel"));
    EXPECT_NEAR(gui::impedanceOf(shown->measurement), 1000, 5);
    EXPECT_THAT(figure(summary, "Impedance").toStdString(), HasSubstr("kΩ"));
    EXPECT_THAT(head(), AllOf(StartsWith("just now"), HasSubstr("simulated")));
    shot(summary, "summary");
    gui::applyTheme(gui::Theme::Dark);
    QCoreApplication::processEvents();
    shot(summary, "summary-dark");
    gui::applyTheme(gui::Theme::Light);
}

TEST_F(Summary, WhatIsMissingIsADashWithItsReason) {
    auto flat = twoPulses();
    for (auto& x : flat.channels[0].samples) x = std::min(x, 30.0F);
    flat.channels[0].high = 30;
    summary.take(prepared(flat));
    EXPECT_EQ(figure(summary, "Amplitude of Voltage"), "–");
    EXPECT_THAT(find<QLabel>(summary, "Amplitude of Voltage")->toolTip().toStdString(), HasSubstr("clipped"));
    EXPECT_NE(figure(summary, "Amplitude of Current"), "–");
    EXPECT_EQ(figure(summary, "Impedance"), "–");
    Telemetry telemetry;
    telemetry.impedance_ohm = 1020;
    telemetry.impedanceAge_s = 5;
    summary.refresh(telemetry);
    EXPECT_EQ(figure(summary, "Impedance"), "1.02\u202fkΩ");
    EXPECT_NE(find<QLabel>(summary, "|Z|, check 5 s ago"), nullptr);
    shot(summary, "summary-clipped");
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(5e-3));
    summary.take(prepared(recordOf(phases)));
    EXPECT_EQ(figure(summary, "Interval of Voltage"), "–");
    EXPECT_THAT(find<QLabel>(summary, "Interval of Voltage")->toolTip().toStdString(), HasSubstr("longer record"));
}

TEST_F(Summary, AnUntriggeredRecordChangesNoNumber) {
    summary.take(prepared(twoPulses()));
    const auto before = figure(summary, "Amplitude of Voltage");
    auto quiet = twoPulses(200, 10);
    quiet.untriggered = true;
    quiet.trigger_s = NAN;
    summary.take(prepared(quiet));
    EXPECT_EQ(figure(summary, "Amplitude of Voltage"), before);
    EXPECT_THAT(head(), HasSubstr("no trigger since"));
    summary.measure(std::make_shared<const Capture>(twoPulses(300, 20)));
    EXPECT_TRUE(comesTrue([&] { return figure(summary, "Amplitude of Voltage") != before; }));
    EXPECT_THAT(head(), testing::Not(HasSubstr("no trigger since")));
}

TEST_F(Scope, OthersAreFedThoughTheOscilloscopeIsNotVisible) {
    gui::MeasurementSummary summary;
    QObject::connect(&scope, &gui::ScopeWorkspace::captureShown, &summary, &gui::MeasurementSummary::take);
    summary.resize(280, 220);
    summary.show();
    scope.hide();
    openBench();
    deliver();
    EXPECT_FALSE(scope.running()) << "nobody looks";
    scope.setWatched(true);
    ASSERT_TRUE(comes([&] { return find<QLabel>(summary, "Amplitude of Voltage") != nullptr; }));
    EXPECT_NE(figure(summary, "Amplitude of Voltage"), "–");
    EXPECT_THAT(figure(summary, "Impedance").toStdString(), testing::AnyOf(HasSubstr("kΩ"), HasSubstr("Ω")));
    shot(summary, "summary-live");
}

}  // namespace
}  // namespace tacto::test
