// Tests the oscilloscope if things go wrong (no trigger, no oscilloscope), and its figures for other workspaces.
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QScrollBar>
#include <QToolButton>
#include <gmock/gmock.h>

#include "app/gui/scope/measurements/MeasurementSummary.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/scope/Captures.h"
#include "tests/gui/scope/ScopeBench.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::ScopeMode;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(Scope, ATrainCrossesTheTriggersLevelAtTime0AndTheTableSaysSinceWhen) {
    openBench();
    deliver();
    ASSERT_IN_TIME(comes([&] { return triggered() && scope.table().statistics().captures() >= 3; }));  // level found
    gui::ShownPtr last = scope.model().shown();
    for (int captures = 0; captures < 5; ++captures) {
        ASSERT_IN_TIME(comes([&] { return triggered() && scope.model().shown() != last; }));
        last = scope.model().shown();
        const auto* volts = scope.model().lane(scope.model().channelIn("V"));
        ASSERT_NE(volts, nullptr);
        const auto& span = volts->spans.front();
        EXPECT_NEAR(std::abs(span.trace->valueAt(last->zero_s)), scope.settings().triggerLevel, 1e-3);
    }
    EXPECT_TRUE(says("since " + scope.model().shown()->taken.toString("HH:")));
    controller.drive(DriveSource::Manual, 0.9, 0.3);
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() == 1; })) << "another drive begins anew";
}

TEST_F(Scope, AutoShowsTheSignalUntriggeredAndSaysSo) {
    openBench();
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != nullptr; }));
    ASSERT_FALSE(triggered());
    ASSERT_IN_TIME(comes([&] { return QString::fromStdString(status()).startsWith("No trigger at"); }));
    EXPECT_THAT(status(),
                AllOf(HasSubstr("Showing an untriggered record; no measurements"), HasSubstr("Output is disarmed.")));
    EXPECT_THAT(scope.screen().overlay().notes, testing::ElementsAre("not triggered"));
    EXPECT_THAT(scope.screen().xAxis->label().toStdString(), HasSubstr("record's begin"));
    EXPECT_EQ(scope.table().statistics().captures(), 0U);
    EXPECT_NE(find<QLabel>(scope, "Untriggered: nothing is measured. Measurements appear with the first trigger."),
              nullptr);
    const auto first = scope.model().shown();
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != first; })) << "and goes on";
    shot(scope, "free-run");
    deliver();
    ASSERT_IN_TIME(comes([&] { return triggered(); }));
    EXPECT_THAT(scope.screen().overlay().notes, testing::IsEmpty());
    ASSERT_IN_TIME(comes([&] { return scope.table().statistics().captures() >= 4; }));
    EXPECT_TRUE(triggered()) << "between slow trains the picture does not jump";
    controller.stop("test");
    ASSERT_IN_TIME(comes([&] { return scope.model().held(); }));
    EXPECT_TRUE(triggered()) << "a stop keeps the last train on the screen";
    EXPECT_THAT(scope.screen().overlay().notes, testing::ElementsAre("the last live train, held"));
    EXPECT_TRUE(says("no trigger since: the last train is held on the screen"));
    const auto pale = [&] { return scope.screen().graph("channel/voltage")->pen().color() != gui::colours().voltage; };
    EXPECT_TRUE(pale()) << "what is held is drawn as the past";
    const auto counted = scope.table().statistics().captures();
    const auto last = scope.model().shown();
    const auto at = controller.telemetry().at;
    ASSERT_IN_TIME(comes([&] { return controller.telemetry().at > at + std::chrono::seconds(2); }));
    EXPECT_EQ(scope.model().shown(), last);
    EXPECT_EQ(scope.table().statistics().captures(), counted) << "what is not triggered is not counted";
    deliver();
    ASSERT_IN_TIME(comes([&] { return !scope.model().held() && scope.model().shown() != last; }));
    EXPECT_FALSE(pale());
    EXPECT_THAT(complaints, testing::IsEmpty());
}

TEST_F(Scope, NormalWaitsForItsTrigger) {
    scope.setMode(ScopeMode::Normal);
    openBench(nullptr, 4);
    const auto at = controller.telemetry().at;
    ASSERT_IN_TIME(comes([&] { return controller.telemetry().at > at + std::chrono::seconds(4); }));
    EXPECT_EQ(scope.model().shown(), nullptr);
    EXPECT_THAT(status(), StartsWith("Waiting for a trigger at"));
    QTest::keyClick(&scope.screen(), Qt::Key_F3);
    EXPECT_THAT(status(), HasSubstr("nothing to search"));
    EXPECT_TRUE(scope.running()) << "it still waits";
}

TEST_F(Scope, AnOscilloscopeThatIsUnpluggedWhileItWaitsSaysWhatHappenedAndGoesOnOnceItIsBack) {
    RecordProperty("hazard", "H9");
    scope.setMode(ScopeMode::Normal);
    openBench("sim:oscilloscope?fault=unplug@2s..6s", 2);
    ASSERT_IN_TIME(comes([&] { return scope.running(); }));
    ASSERT_IN_TIME(comes([&] { return !scope.running(); })) << status();
    EXPECT_THAT(status(), AllOf(HasSubstr("The oscilloscope stopped: the simulated oscilloscope is unplugged."),
                                HasSubstr("The output was off."), HasSubstr("press Run")));
    EXPECT_FALSE(complaints.isEmpty()) << "who looks elsewhere hears of it too";
    shot(scope, "unplugged");
    auto* run = find<QPushButton>(scope, "Run");
    ASSERT_NE(run, nullptr);
    ASSERT_TRUE(run->isEnabled());
    click(*run);
    ASSERT_IN_TIME(comes([&] { return scope.running(); }));
    ASSERT_IN_TIME(comes([&] { return !scope.running(); })) << "it is not back yet";
    EXPECT_THAT(status(), HasSubstr("is unplugged"));
    ASSERT_IN_TIME(comes([&] { return controller.telemetry().at > std::chrono::seconds(6); }));
    EXPECT_FALSE(scope.running()) << "not by itself";
    QTest::keyClick(&scope.screen(), Qt::Key_A);
    ASSERT_IN_TIME(comes([&] { return scope.model().shown() != nullptr; }));
    EXPECT_TRUE(scope.running());
    EXPECT_THAT(status(), HasSubstr("trigger"));
}

TEST_F(Scope, AnOscilloscopeThatFailsDuringDeliveryTellsThatTheOutputGoesOn) {
    RecordProperty("hazard", "H9");
    openBench("sim:oscilloscope?fault=garbage@9s", 2);
    deliver();
    ASSERT_IN_TIME(comes([&] { return triggered(); }));
    ASSERT_IN_TIME(comes([&] { return !scope.running(); }));
    EXPECT_THAT(status(), AllOf(HasSubstr("answered with garbage"), HasSubstr("continues unmeasured. STOP ends it")));
    EXPECT_NE(controller.telemetry().state, InterlockState::Disarmed);
    EXPECT_TRUE(triggered()) << "the last capture stays";
    controller.close();
    ASSERT_IN_TIME(comes([&] { return controller.activity() == gui::Activity::Closed; }));
    EXPECT_THAT(status(), HasSubstr("No bench is open."));
    openBench();
    EXPECT_IN_TIME(comes([&] { return scope.running(); })) << "another bench, another oscilloscope";
}

QString figure(const QWidget& summary, const QString& name) {
    const auto* label = find<QLabel>(summary, name);
    return label == nullptr ? QString("not there") : label->text();
}

class Summary : public testing::Test {
protected:
    Summary() {
        summary.resize(300, 360);
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
    QCoreApplication::processEvents();
    shot(summary, "summary-dark");
}

TEST_F(Summary, ShowsWhatIsChosenAndUnfoldsItsStatistics) {
    gui::ChosenReadings chosen;
    summary.follow(chosen);
    summary.take(prepared(twoPulses()));
    summary.take(prepared(twoPulses(100.2, 30)));
    EXPECT_EQ(find<QLabel>(summary, "RMS of Voltage"), nullptr);
    chosen.choose(gui::Reading::Rms, true);
    EXPECT_EQ(figure(summary, "RMS of Voltage").right(1), "V");
    chosen.choose(gui::Reading::Gap, false);
    EXPECT_EQ(find<QLabel>(summary, "Gap of Voltage"), nullptr);
    EXPECT_THAT(head(), HasSubstr("last of 2"));
    EXPECT_EQ(find<QLabel>(summary, "Amplitude of Voltage, mean"), nullptr);
    click(*find<QToolButton>(summary, "Amplitude"));
    ASSERT_IN_TIME(comesTrue([&] { return find<QLabel>(summary, "Amplitude of Voltage, mean") != nullptr; }));
    EXPECT_THAT(figure(summary, "Amplitude of Voltage, mean").toStdString(), StartsWith("35.0"));
    EXPECT_THAT(figure(summary, "Amplitude of Voltage, min").toStdString(), StartsWith("30.0"));
    EXPECT_EQ(figure(summary, "Amplitude of Voltage, n"), "4");
    QCoreApplication::processEvents();
    QCoreApplication::processEvents();
    shot(summary, "summary-unfolded");
    click(*find<QPushButton>(summary, "Reset"));
    EXPECT_EQ(figure(summary, "Amplitude of Voltage, n"), "2") << "the newest is the first";
    click(*find<QToolButton>(summary, "Amplitude"));
    ASSERT_IN_TIME(comesTrue([&] { return find<QLabel>(summary, "Amplitude of Voltage, mean") == nullptr; }));
}

TEST_F(Summary, ThreeChannelsAndMoreAreNotCutInADocksWidth) {
    for (const int channels : {1, 2, 3, 4}) {
        auto capture = twoPulses();
        while (int(capture.channels.size()) < channels) {
            capture.channels.push_back(capture.channels[capture.channels.size() % 2]);
            capture.channels.back().name += std::to_string(capture.channels.size());
        }
        capture.channels.resize(std::size_t(channels));
        summary.clear();
        summary.take(prepared(std::move(capture)));
        QCoreApplication::processEvents();
        const int room = 224 - 2 * 12 - QScrollBar(Qt::Vertical).sizeHint().width();
        EXPECT_LE(summary.minimumSizeHint().width(), room) << channels;
        summary.resize(room, 500);
        for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
        EXPECT_EQ(faultsOf(summary), "") << channels;
        shot(summary, QString("summary-%1").arg(channels));
    }
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
    EXPECT_IN_TIME(comesTrue([&] { return figure(summary, "Amplitude of Voltage") != before; }));
    EXPECT_THAT(head(), testing::Not(HasSubstr("no trigger since")));
    EXPECT_THAT(head(), HasSubstr("the run's latest train, not the one on the oscilloscope"));
}

TEST_F(Scope, TakesNoUntriggeredRecordsWhileNothingShowsThem) {
    int untriggered = 0;
    QObject::connect(&controller, &gui::BenchController::captured, &scope,
                     [&](const std::shared_ptr<const Capture>& capture) { untriggered += capture->untriggered; });
    openBench();
    ASSERT_IN_TIME(comes([&] { return untriggered >= 2; }));
    scope.hide();
    letLive(200);  // one that was on its way
    const int before = untriggered;
    letLive(1500);
    EXPECT_EQ(untriggered, before) << "nothing shows them";
    EXPECT_TRUE(scope.running());
    scope.setWatched(true);
    ASSERT_IN_TIME(comes([&] { return untriggered >= before + 2; }));
    scope.setWatched(false);
    scope.show();
    const int then = untriggered;
    ASSERT_IN_TIME(comes([&] { return untriggered >= then + 2; }));
}

TEST_F(Scope, TheSummaryOfARunLaysItsRowsOnceAndNotForEachTrain) {
    gui::MeasurementSummary summary;
    summary.show();
    const auto label = [&] { return find<QLabel>(summary, "Amplitude of Voltage"); };
    summary.measure(std::make_shared<const Capture>(twoPulses(1, 40)));
    ASSERT_IN_TIME(comesTrue([&] { return label() != nullptr && label()->text().startsWith("40"); }));
    const QPointer<QLabel> first(label());
    for (const double volts : {30.0, 20.0, 10.0}) {
        summary.measure(std::make_shared<const Capture>(twoPulses(1, volts)));
        ASSERT_IN_TIME(
            comesTrue([&] { return label() != nullptr && label()->text().startsWith(QString::number(volts)); }));
        EXPECT_EQ(label(), first) << volts;
    }
    auto turned = twoPulses(1, 45);
    std::swap(turned.channels[0], turned.channels[1]);
    summary.measure(std::make_shared<const Capture>(std::move(turned)));
    ASSERT_IN_TIME(comesTrue([&] { return label() != nullptr && label()->text().startsWith("45"); }))
        << "channels in another order have rows of their own";
}

TEST_F(Scope, OthersAreFedThoughTheOscilloscopeIsNotVisible) {
    gui::MeasurementSummary summary;
    QObject::connect(&scope, &gui::ScopeWorkspace::captureShown, &summary, &gui::MeasurementSummary::take);
    summary.resize(280, 220);
    summary.show();
    scope.hide();
    openBench();
    deliver();
    EXPECT_FALSE(scope.running()) << "it is not looked at";
    scope.setWatched(true);
    ASSERT_IN_TIME(comes([&] { return find<QLabel>(summary, "Amplitude of Voltage") != nullptr; }));
    EXPECT_NE(figure(summary, "Amplitude of Voltage"), "–");
    EXPECT_THAT(figure(summary, "Impedance").toStdString(), testing::AnyOf(HasSubstr("kΩ"), HasSubstr("Ω")));
    shot(summary, "summary-live");
}

}  // namespace
}  // namespace tacto::test
