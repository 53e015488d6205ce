// Tests content and actions of the safety bar in each state.
#include <QTest>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/FaultBanner.h"
#include "app/gui/window/FoldingDock.h"
#include "app/gui/window/LimitBar.h"
#include "app/gui/window/SafetyBar.h"
#include "app/gui/window/StateBlock.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/window/TickingRun.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

ExposureRow row(Quantity quantity, double value, double limit, const char* unit) {
    ExposureRow made;
    made.quantity = quantity;
    made.value = value;
    made.limit = limit;
    made.unit = unit;
    made.evaluated = !std::isnan(value);
    made.within = value <= limit;
    made.set = "paper";
    return made;
}

TEST(LimitBar, IsNoFinerThanAHundredthOfALimitInPercentThatIsFar) {
    RecordProperty("hazard", "H9");
    const auto said = [](double value_pct) {
        gui::LimitBar bar("Net charge");
        bar.show(row(Quantity::NetCharge, value_pct, 1, "%"));
        return bar.text().replace(QChar(0x202f), ' ').toStdString();
    };
    EXPECT_EQ(said(0.000392), "< 0.01 of 1 %");
    EXPECT_EQ(said(0.0478), "0.05 of 1 %");
    EXPECT_EQ(said(0.996), "0.996 of 1 %") << "below the limit and never shown as at it";
    EXPECT_EQ(said(0), "0 of 1 %");
}

TEST(LimitBarRow, ABarThatIsSeenStaysUntilAnotherIsClearlyNearer) {
    RecordProperty("hazard", "H12");
    gui::LimitBarRow bars({"Energy", "Charge"}, nullptr);
    bars.resize(bars.sizeHint().width() / 2 + 20, 60);  // room for one bar
    const auto seen = [&](double energy, double charge) {
        bars.show(0, row(Quantity::PulseEnergy, energy, 1, "J"));
        bars.show(1, row(Quantity::NetCharge, charge, 1, "%"));
        bars.arrange();
        for (const auto* bar : bars.findChildren<gui::LimitBar*>())
            if (!bar->isHidden()) return bar->accessibleName().toStdString();
        return std::string();
    };
    EXPECT_EQ(seen(0.1, 0), "Energy");
    EXPECT_EQ(seen(0.1, 0.15), "Energy") << "both are far";
    EXPECT_EQ(seen(0.1, 0.5), "Charge");
    EXPECT_EQ(seen(0.55, 0.5), "Charge");
    bars.setTitle(1, "Net charge");
    EXPECT_EQ(seen(0.55, 0.5), "Net charge") << "named as what it shows";
}

TEST(LimitBar, SaysTheNumberInTheUnitOfItsLimit) {
    RecordProperty("hazard", "H9");
    const auto said = [](Quantity quantity, double value, double limit, const char* unit) {
        gui::LimitBar line("RMS", nullptr, gui::LimitBar::Shape::Line), stacked("RMS");
        line.show(row(quantity, value, limit, unit));
        stacked.show(row(quantity, value, limit, unit));
        EXPECT_EQ(line.text(), stacked.text()) << "one way of writing in the bar and in the dock";
        return line.text().replace(QChar(0x202f), ' ').toStdString();
    };
    EXPECT_EQ(said(Quantity::RmsCurrent5s, 0.69, 10, "mA"), "0.69 of 10 mA");
    EXPECT_EQ(said(Quantity::CommandVoltage, 0, 40, "V"), "0 of 40 V");
    EXPECT_EQ(said(Quantity::PeakVoltage, 0, 500, "V"), "0 of 500 V");
    EXPECT_EQ(said(Quantity::CommandVoltage, 39.999, 40, "V"), "39.999 of 40 V") << "below the limit, not at it";
    EXPECT_EQ(said(Quantity::CommandVoltage, 40 * (1 - 1e-12), 40, "V"), "40.0 of 40 V");
    EXPECT_EQ(said(Quantity::RmsCurrent5s, 0.82, 10, "mA"), "0.82 of 10 mA");
    EXPECT_EQ(said(Quantity::RmsCurrent5s, 0.0012, 10, "mA"), "< 0.01 of 10 mA");
    EXPECT_EQ(said(Quantity::RmsCurrent5s, 10.25, 10.25, "mA"), "10.25 of 10.25 mA");
    EXPECT_EQ(said(Quantity::RmsCurrent5s, 10.049, 10.04, "mA"), "10.05 of 10.04 mA");
    EXPECT_EQ(said(Quantity::RmsCurrent5s, 10.04, 10, "mA"), "> 10 mA") << "over its limit and never shown as at it";
    EXPECT_EQ(said(Quantity::PulseEnergy, 300, 300, "mJ"), "300 of 300 mJ");
}

TEST(LimitBar, InADockNoRowIsCutAtTheUsualWidth) {
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        gui::applyTheme(gui::Theme::Light);
        for (std::size_t i = 0; i < kQuantityCount; ++i) {
            const auto quantity = static_cast<Quantity>(i);
            for (const auto judged : {JudgedAt::LoadRange, JudgedAt::Ohm500}) {
                for (const double limit : {0.25, 1.0, 10.0, 80.0, 300.0}) {
                    // Not evaluated, small, medium, and around the limit.
                    for (const double share : {std::nan(""), 1e-6, 0.0123, 0.745, 0.9987, 1.5}) {
                        auto shown = row(quantity, share * limit, limit, unitOf(quantity).data());
                        shown.judged = judged;
                        gui::LimitBar bar(gui::shortRowTitle(shown), nullptr, gui::LimitBar::Shape::Line);
                        // The width inside the dock, without edges and scroll bar.
                        bar.resize(gui::scaledPx(gui::FoldingDock::kWidth - 2 * 12 - 10), 30);
                        bar.show(shown);
                        EXPECT_TRUE(bar.fits()) << gui::shortRowTitle(shown).toStdString() << ": "
                                                << bar.text().toStdString() << " at " << percent << " %";
                        EXPECT_TRUE(bar.toolTip().contains(QString::fromUtf8(titleOf(quantity).data())))
                            << "the full words stand in the tool tip";
                    }
                }
            }
        }
    }
}

TEST(LimitBar, NeverShowsANumberForWhatWasNotEvaluated) {
    RecordProperty("hazard", "H9");
    gui::LimitBar bar("Density");
    bar.show(row(Quantity::PowerDensity, std::nan(""), 0.25, "W/cm2"));
    EXPECT_EQ(bar.text(), "not evaluated");
    EXPECT_TRUE(std::isnan(bar.share()));
    bar.show(std::nullopt);
    EXPECT_EQ(bar.text(), QString("–"));
}

TEST(Tightest, IsTheRowNearestItsLimitAndNotEvaluatedComesFirst) {
    RecordProperty("hazard", "H9");
    const std::vector<ExposureRow> rows{row(Quantity::RmsCurrent5s, 2, 50, "mA"),
                                        row(Quantity::RmsCurrent5s, 2, 10, "mA"),
                                        row(Quantity::PulseEnergy, 1, 300, "mJ")};
    EXPECT_DOUBLE_EQ(gui::tightest(rows, {Quantity::RmsCurrent5s})->limit, 10);
    EXPECT_FALSE(gui::tightest(rows, {Quantity::PowerDensity}));
    auto more = rows;
    more.push_back(row(Quantity::RmsCurrent5s, std::nan(""), 80, "mA"));
    EXPECT_DOUBLE_EQ(gui::tightest(more, {Quantity::RmsCurrent5s})->limit, 80);
}

TEST(Tightest, DoesNotFlipAtATie) {
    RecordProperty("hazard", "H9");
    auto paper = row(Quantity::RmsCurrent5s, 2, 10, "mA");
    auto standard = paper;
    standard.set = "iec60601-2-10";
    auto strict = row(Quantity::RmsCurrent5s, 1, 5, "mA");
    strict.set = "lab";
    std::vector<ExposureRow> rows{paper, standard, strict};
    const auto shown = [&] {
        const auto found = gui::tightest(rows, {Quantity::RmsCurrent5s});
        return std::pair(found->set, found->limit);
    };
    const auto first = shown();
    for (const double off : {0.0, 1e-16, -1e-16, 3e-16, -3e-16}) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double value = rows[i].value;
            rows[i].value = value * (1 + off);
            EXPECT_EQ(shown(), first) << "the last digit of a sum decides: row " << i << ", " << off;
            rows[i].value = value;
        }
    }
}

class Bar : public testing::Test {
protected:
    Bar() {
        bar.resize(1400, bar.sizeHint().height());
        bar.show();
    }
    Telemetry in(InterlockState state, const char* reason = "") {
        Telemetry telemetry;
        telemetry.state = state;
        telemetry.reason = reason;
        return telemetry;
    }
    bool armed(const std::vector<const char*>& uris) {
        gui::LiveOrder order;
        for (const auto* uri : uris) order.uris.push_back(*DeviceUri::parse(uri));
        order.profile = controller.profile();
        controller.openLive(order);
        if (!comesTrue([this] { return controller.activity() == gui::Activity::Live; })) return false;
        ArmRequest request;
        request.operatorConfirmed = true;
        controller.arm(request);
        return comesTrue([this] { return controller.telemetry().state == InterlockState::Armed; });
    }
    QString word() { return bar.findChild<QLabel*>("interlockState")->text(); }
    gui::BenchController controller{simulatedRegistry};
    gui::CalibrationBook calibrations{controller};
    gui::SafetyBar bar{controller, calibrations};
};

TEST_F(Bar, HasAWordAndAShapeForEveryState) {
    QStringList words, shapes;
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        bar.refresh(in(InterlockState(state), "why"));
        const auto style = gui::stateStyle(InterlockState(state));
        EXPECT_EQ(word(), style.word);
        EXPECT_FALSE(words.contains(style.word) || shapes.contains(style.shape)) << style.word.toStdString();
        words << style.word;
        shapes << style.shape;
        shot(bar, "safetybar-" + style.word.toLower());
    }
}

TEST_F(Bar, OffersToArmOnlyIfEveryCauseOfAFaultAllowsIt) {
    RecordProperty("hazard", "H12");
    std::set<FaultCause> grave{FaultCause::NetCharge, FaultCause::LimitBroken, FaultCause::Internal,
                               FaultCause::StuckOn};
    int offers = 0;
    QObject::connect(&bar, &gui::SafetyBar::faultReset, [&] { ++offers; });
    std::mt19937 random(1213);
    int allowed = 0;
    for (int round = 0; round < 300; ++round) {
        Interlock lock;
        ASSERT_TRUE(lock.connect());
        const bool kept = std::bernoulli_distribution(0.2)(random);  // left by an earlier program
        bar.refresh(in(InterlockState::Disconnected, ""));
        if (!kept) bar.refresh(in(InterlockState::Delivering, ""));
        bool safe = !kept;
        std::string came = kept ? "kept," : "";
        for (int left = std::uniform_int_distribution(1, 4)(random); left > 0; --left) {
            const auto cause = FaultCause(std::uniform_int_distribution(0, kFaultCauseCount - 1)(random));
            came += std::string(nameOf(cause)) + ",";
            safe = safe && !grave.contains(cause);
            lock.fault(cause, "why");
            auto now = in(InterlockState::Faulted, "why");
            now.fault = lock.cause();
            now.grave = lock.grave();
            bar.refresh(now);
            const auto says = bar.findChild<gui::FaultBanner*>()->text();
            ASSERT_EQ(says.contains("Arming is asked for"), safe) << came << says.toStdString();
        }
        bar.resetFault();
        offers = 0;
        bar.refresh(in(InterlockState::Disarmed, ""));
        ASSERT_EQ(offers, safe ? 1 : 0) << came;
        allowed += offers;
    }
    EXPECT_GT(allowed, 30);
    EXPECT_LT(allowed, 270);
}

TEST_F(Bar, AGraveFaultIsNotResetByHand) {
    RecordProperty("hazard", "H2");
    ASSERT_IN_TIME(armed({"sim:stimulator?fault=stuck-on@5s", "sim:"}));
    controller.drive(DriveSource::Manual, 0, 1);
    const auto faulted = [this] {
        bar.refresh(controller.telemetry());
        return controller.telemetry().state == InterlockState::Faulted;
    };
    ASSERT_IN_TIME(comesTrue(faulted));
    EXPECT_TRUE(faulted());
    const auto* reset = bar.findChild<QPushButton*>("armButton");
    EXPECT_FALSE(reset->isEnabled());
    EXPECT_TRUE(reset->toolTip().contains("in a fault of stuck on")) << reset->toolTip().toStdString();
    EXPECT_TRUE(reset->toolTip().contains("Run the safety check first"));
    EXPECT_TRUE(bar.findChild<gui::FaultBanner*>()->text().contains("then run the safety check"));
    QString said;
    QObject::connect(&controller, &gui::BenchController::failed, [&](const QString& what) { said = what; });
    bar.resetFault();  // as the menu does
    ASSERT_IN_TIME(comesTrue([&] { return !said.isEmpty(); }));
    EXPECT_TRUE(said.contains("Run the safety check first")) << said.toStdString();
    EXPECT_TRUE(faulted());
}

TEST_F(Bar, StatesStandOutOnTheScreenInBothThemes) {
    RecordProperty("hazard", "H12");
    auto* block = bar.findChild<gui::StateBlock*>();
    ASSERT_NE(block, nullptr);
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
            bar.refresh(in(InterlockState(state), "why"));
            QCoreApplication::processEvents();
            const auto style = gui::stateStyle(InterlockState(state));
            EXPECT_GE(contrast(style.ink, style.ground), 4.5) << style.word.toStdString();
            const auto drawn = block->grab().toImage();
            const int all = drawn.width() * drawn.height();
            EXPECT_GT(pixelsOf(drawn, style.ground), all / 2) << style.word.toStdString() << " has its ground";
            EXPECT_GT(pixelsOf(drawn, style.ink), all / 100) << style.word.toStdString() << " is written in its ink";
        }
        const auto stop = bar.findChild<QPushButton*>("stopButton")->grab().toImage();
        const auto red = gui::stateStyle(InterlockState::Faulted);
        EXPECT_GT(pixelsOf(stop, red.ground), stop.width() * stop.height() / 2);
        EXPECT_GT(pixelsOf(stop, red.ink), stop.width() * stop.height() / 100);
    }
}

TEST(LimitBarRow, ShowsThoseNearestToTheirLimitsWhereNotAllFit) {
    gui::LimitBarRow bars({"a", "b", "c"}, nullptr);
    bars.show(0, row(Quantity::RmsCurrent5s, 1, 10, "mA"));
    bars.show(1, row(Quantity::PulseEnergy, 290, 300, "mJ"));
    bars.resize(bars.sizeHint().width() / 2, bars.sizeHint().height());
    static_cast<QWidget&>(bars).show();
    bars.arrange();
    QStringList seen;
    for (const auto* bar : bars.findChildren<gui::LimitBar*>()) {
        if (bar->isVisible()) seen << bar->accessibleName();
    }
    EXPECT_EQ(seen, QStringList("b"));
}

TEST_F(Bar, AfterAStopTheImpedanceStaysToBeReadWithItsAgeUntilAFault) {
    RecordProperty("hazard", "H9");
    ASSERT_IN_TIME(armed({"sim:"}));
    const auto says = [this](const Telemetry& telemetry) {
        bar.refresh(telemetry);
        return bar.findChild<QLabel*>("impedance")->text().toStdString();
    };
    EXPECT_THAT(says(controller.telemetry()), AllOf(HasSubstr("Ω"), HasSubstr(" · ")));
    controller.stop("test");
    ASSERT_IN_TIME(comesTrue([this] {
        const auto now = controller.telemetry();
        return now.state == InterlockState::Disarmed && std::isnan(now.impedance_ohm);
    }));
    auto later = controller.telemetry();
    later.at += std::chrono::seconds(12);
    EXPECT_THAT(says(later), AllOf(HasSubstr("Ω"), HasSubstr("12 s ago"))) << "as the measurements say it";
    later.state = InterlockState::Faulted;
    says(later);
    later.state = InterlockState::Disarmed;
    EXPECT_EQ(says(later), "Impedance not measured") << "the electrode may be open";
}

TEST_F(Bar, StopAndTheButtonsAreWholeOnANarrowScreen) {
    RecordProperty("hazard", "H2");
    bar.refresh(in(InterlockState::Faulted, "the electrode is open: a long story that has no room here"));
    for (const int width : {1400, 960, 800, bar.minimumSizeHint().width()}) {
        bar.resize(width, bar.sizeHint().height());
        QCoreApplication::processEvents();
        EXPECT_EQ(bar.width(), width);
        for (const auto* button : bar.findChildren<QPushButton*>()) {
            const QRect place(button->mapTo(&bar, QPoint(0, 0)), button->size());
            EXPECT_TRUE(bar.rect().contains(place)) << button->text().toStdString() << " at " << width;
            EXPECT_GE(button->width(), button->minimumSizeHint().width()) << button->text().toStdString();
        }
        shot(bar, QString("safetybar-%1").arg(width));
    }
    EXPECT_LE(bar.minimumSizeHint().width(), 900);
}

TEST_F(Bar, TheStatesShapePulsesWithEachTrain) {
    auto telemetry = in(InterlockState::Delivering);
    auto* block = bar.findChild<gui::StateBlock*>();
    const auto ink = gui::stateStyle(InterlockState::Delivering).ink;
    const auto drawn = [&] {
        bar.refresh(telemetry);
        return pixelsOf(block->grab().toImage(), ink);
    };
    const auto settles = [&] {
        for (int frame = 0; frame < 60; ++frame) drawn();
        return drawn();
    };
    telemetry.trainsDelivered = 4;
    const int quiet = settles();
    for (std::uint64_t train = 5; train < 8; ++train) {
        telemetry.trainsDelivered = train;
        EXPECT_GT(drawn(), quiet + 20) << "train " << train;
        EXPECT_EQ(settles(), quiet) << "and it is over before the next";
    }
    telemetry.state = InterlockState::Armed;
    const int armed = settles();
    telemetry.trainsDelivered = 8;
    EXPECT_EQ(drawn(), armed) << "only an output that delivers pulses";
}

TEST_F(Bar, StopGrowsWithTheText) {
    RecordProperty("hazard", "H2");
    auto* stop = bar.findChild<QPushButton*>("stopButton");
    const auto written = [&] {
        QCoreApplication::processEvents();
        bar.resize(2400, bar.sizeHint().height());
        letLive(50);
        return pixelsOf(stop->grab().toImage(), gui::stateStyle(InterlockState::Faulted).ink);
    };
    const int before = written();
    const auto size = stop->size();
    gui::applyTextSize(200);
    const int after = written();
    const auto grown = stop->size();
    gui::applyTextSize(100);
    EXPECT_GE(grown.width(), 1.9 * size.width());
    EXPECT_GE(grown.height(), 1.8 * size.height());
    EXPECT_GT(after, 3 * before) << "the word grows, not only the button";
}

TEST_F(Bar, StopIsThereAndEnabledInEveryState) {
    auto* stop = find<QPushButton>(bar, "STOP");
    ASSERT_NE(stop, nullptr);
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        bar.refresh(in(InterlockState(state)));
        EXPECT_TRUE(stop->isVisible() && stop->isEnabled());
    }
}

TEST_F(Bar, StopSwitchesOffWhenThePressGoesDown) {
    RecordProperty("hazard", "H2");
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller.profile();
    controller.openLive(order);
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
    ArmRequest request;
    request.operatorConfirmed = true;
    controller.arm(request);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().state == InterlockState::Armed; }));
    QTest::mousePress(find<QPushButton>(bar, "STOP"), Qt::LeftButton);
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disarmed);
}

TEST_F(Bar, ArmingOnlyAsks) {
    RecordProperty("hazard", "H12");
    gui::LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = controller.profile();
    controller.openLive(order);
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
    bar.refresh(controller.telemetry());
    int asked = 0;
    QObject::connect(&bar, &gui::SafetyBar::armRequested, [&] { ++asked; });
    click(*bar.findChild<QPushButton*>("armButton"));
    EXPECT_EQ(asked, 1);
    letLive(200);
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disarmed);
}

TEST_F(Bar, ADoubleClickOnPauseLeavesItPaused) {
    RecordProperty("hazard", "H12");
    ASSERT_TRUE(armed({"sim:"}));
    controller.drive(DriveSource::Manual, 0.5, 1);
    const auto is = [this](InterlockState state) {
        return comesTrue([this, state] {
            const auto now = controller.telemetry();  // read once, so that the bar shows the tested state
            bar.refresh(now);
            return now.state == state;
        });
    };
    ASSERT_IN_TIME(is(InterlockState::Delivering));
    auto* pause = find<QPushButton>(bar, "Pause");
    ASSERT_NE(pause, nullptr);
    QTest::mouseClick(pause, Qt::LeftButton);
    ASSERT_IN_TIME(is(InterlockState::Paused));
    EXPECT_EQ(pause->text().remove('&'), "Resume");
    QTest::mouseDClick(pause, Qt::LeftButton);
    QTest::mouseClick(pause, Qt::LeftButton);
    pause->click();
    letLive(100);
    EXPECT_EQ(controller.telemetry().state, InterlockState::Paused);
    click(*pause);
    EXPECT_IN_TIME(is(InterlockState::Delivering)) << "a press of its own resumes";
    QTest::mouseClick(pause, Qt::LeftButton);
    EXPECT_IN_TIME(is(InterlockState::Paused)) << "and pausing waits for nothing";
}

TEST_F(Bar, PauseHoldsAProtocolBetweenItsTrainsToo) {
    RecordProperty("hazard", "H12");
    const auto order = tickingRun(controller, "ticks");
    ASSERT_TRUE(order) << order.error().message;
    auto* pause = bar.findChild<gui::ConfirmButton*>("pauseButton");
    ASSERT_NE(pause, nullptr);
    bar.refresh(controller.telemetry());
    EXPECT_FALSE(pause->isEnabled()) << "there is nothing to hold";
    (void)controller.run(*order);
    ASSERT_IN_TIME(comesTrue([&] { return !controller.takeRunFeed().log.empty(); }));
    bar.refresh(controller.telemetry());
    ASSERT_TRUE(pause->isEnabled()) << word().toStdString();
    click(*pause);
    EXPECT_TRUE(controller.paused());
    bar.refresh(controller.telemetry());
    EXPECT_EQ(pause->text().remove('&'), "Resume");
    letLive(100);  // time for the step in progress to end
    (void)controller.takeRunFeed();
    letLive(100);
    EXPECT_TRUE(controller.takeRunFeed().log.empty()) << "it went on while paused";
    click(*pause);
    EXPECT_FALSE(controller.paused());
    EXPECT_IN_TIME(comesTrue([&] { return !controller.takeRunFeed().log.empty(); }));
    controller.stop("test");
}

TEST_F(Bar, APressMeantForDisarmDoesNotResetTheFaultThatCameFirst) {
    RecordProperty("hazard", "H12");
    ASSERT_TRUE(armed({"sim:stimulator?fault=unplug@1s", "sim:"}));
    controller.drive(DriveSource::Manual, 0.5, 1);
    ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().state == InterlockState::Faulted; }));
    QStringList refused;  // resetting an unplugged device fails
    QObject::connect(&controller, &gui::BenchController::failed, [&](const QString& what) {
        if (what.contains("ot reset")) refused << what;
    });
    auto* action = bar.findChild<QPushButton*>("armButton");
    bar.refresh(in(InterlockState::Delivering));
    bar.refresh(in(InterlockState::Faulted, "unplugged"));
    QTest::mouseClick(action, Qt::LeftButton);
    action->click();
    letLive(100);
    EXPECT_TRUE(refused.isEmpty()) << "it was Disarm a moment ago";

    bar.refresh(in(InterlockState::Delivering));
    QTest::mousePress(action, Qt::LeftButton);
    bar.refresh(in(InterlockState::Faulted, "unplugged"));
    letLive(gui::ConfirmButton::kDebounce_ms + 100);
    QTest::mouseRelease(action, Qt::LeftButton);
    letLive(100);
    EXPECT_TRUE(refused.isEmpty()) << "it was Disarm when the press went down";

    click(*action);
    EXPECT_IN_TIME(comesTrue([&] { return !refused.isEmpty(); })) << "a later press resets";
}

TEST_F(Bar, SaysThatATrainUnderWayOutlastsThePause) {
    bar.refresh(in(InterlockState::Delivering));
    EXPECT_TRUE(find<QPushButton>(bar, "Pause")->toolTip().contains("The current train finishes within"));
}

TEST_F(Bar, SaysWhyItFaultedAndThatOutputIsOff) {
    bar.refresh(in(InterlockState::Faulted, "electrode open"));
    const auto* cause = bar.findChild<QLabel*>("faultText");
    ASSERT_NE(cause, nullptr);
    EXPECT_TRUE(cause->isVisibleTo(&bar));
    EXPECT_EQ(cause->text(), "Electrode open.");
    const auto whole = cause->parentWidget()->toolTip().split('\n');
    ASSERT_EQ(whole.size(), 3) << "cause, output, next step";
    EXPECT_TRUE(whole[1].startsWith("Output is off and stays off."));
    EXPECT_TRUE(whole[2].contains("reset the fault"));
}

}  // namespace
}  // namespace tacto::test
