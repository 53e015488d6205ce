// Tests the controller with a simulated bench: opening, driving, stopping, capturing, running.
#include <QSignalSpy>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/controller/BenchController.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/electrode/Load.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::Activity;
using gui::BenchController;
using testing::HasSubstr;

class Controller : public testing::Test {
protected:
    Controller() {
        QObject::connect(&controller, &BenchController::failed, [this](const QString& what) { complaints << what; });
    }
    void open(const char* uri = "sim:", double speed = 1) {
        gui::LiveOrder order;
        order.uris.push_back(*DeviceUri::parse(uri));
        if (std::string_view(uri) != "sim:") order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = controller.profile();
        order.speed = speed;
        controller.openLive(order);
        ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == Activity::Live || !complaints.isEmpty(); }));
        ASSERT_TRUE(complaints.isEmpty()) << complaints.first().toStdString();
    }
    void arm(const char* load = "1 kohm") {
        ArmRequest request;
        request.load = load;
        request.operatorConfirmed = true;
        controller.arm(request);
    }
    bool comesTo(InterlockState state) {
        return comesTrue([&] { return controller.telemetry().state == state; });
    }
    RunOrder orderOf(const std::string& script, std::map<std::string, std::string> settings = {}) {
        RunOrder order;
        order.script.name = "test";
        order.script.text = script;
        order.declaration = readDeclaration(order.script).value();
        order.settings = applySettings(order.declaration, settings).value();
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = controller.profile();
        order.limits = controller.limits();
        return order;
    }

    BenchController controller{simulatedRegistry};
    QStringList complaints;
};

TEST_F(Controller, IsClosedUntilABenchIsOpened) {
    EXPECT_EQ(controller.activity(), Activity::Closed);
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disconnected);
    EXPECT_FALSE(controller.open());
    controller.stop("a test");  // must do no harm
    open();
    EXPECT_TRUE(controller.open()->simulated());
    EXPECT_TRUE(controller.open()->paced);
    EXPECT_EQ(controller.open()->streams.size(), 3U);
    EXPECT_TRUE(std::filesystem::exists(controller.open()->session));
    controller.close();
    EXPECT_IN_TIME(comesTrue([this] { return controller.activity() == Activity::Closed; }));
}

TEST_F(Controller, AnImpedanceCheckEndsDisarmedWhateverIsComplainedAboutMeanwhile) {
    RecordProperty("hazard", "H12");
    open();
    double measured = 0;
    QObject::connect(&controller, &BenchController::checked, [&](double ohms) { measured = ohms; });
    controller.drive(DriveSource::Manual, 2, 1);  // refused: another failure is reported before the check ends
    ArmRequest request{"1 kohm", true, true};
    controller.checkImpedance(request);
    ASSERT_IN_TIME(comesTrue([&] { return measured > 0; }));
    EXPECT_NEAR(measured, 1000, 50);
    EXPECT_FALSE(complaints.isEmpty());
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disarmed);
    EXPECT_EQ(controller.telemetry().trainsDelivered, 0U);
}

TEST_F(Controller, ArmingThatIsRefusedLeavesTheBenchDisarmed) {
    RecordProperty("hazard", "H12");
    open();
    arm();
    ASSERT_IN_TIME(comesTo(InterlockState::Armed));
    ArmRequest request{"1 kohm", true, true};
    request.confirmed = "another stimulator into 2 kohm";
    controller.arm(request);
    ASSERT_IN_TIME(comesTo(InterlockState::Disarmed)) << "what was armed before went on";
    ASSERT_IN_TIME(comesTrue([this] { return !complaints.isEmpty(); }));
    EXPECT_THAT(complaints.last().toStdString(), HasSubstr("the operator confirmed \"another stimulator"));
}

TEST_F(Controller, SaysWhatArmingConfirms) {
    RecordProperty("hazard", "H12");
    EXPECT_EQ(controller.confirmationOf(Load::resistor(Ohms(1000))), "");
    open("sim:stimulator?mode=current");
    EXPECT_THAT(controller.confirmationOf(Load::resistor(Ohms(2000))),
                HasSubstr("SIM-1 into 2 kohm, up to 40 V and 25 mA, electrode area not stated"));
    ArmRequest request{"2 kohm", true, true};
    request.confirmed = controller.confirmationOf(Load::resistor(Ohms(2000)));
    controller.fitLoad("2 kohm");
    controller.arm(request);
    EXPECT_IN_TIME(comesTo(InterlockState::Armed)) << "as the bench says it itself";
}

TEST_F(Controller, ArmsAndDeliversByHandAndStopsAtOnce) {
    RecordProperty("hazard", "H2");
    open();
    arm();
    ASSERT_IN_TIME(comesTo(InterlockState::Armed));
    controller.drive(DriveSource::Manual, 0.5, 1);
    ASSERT_IN_TIME(comesTo(InterlockState::Delivering));
    EXPECT_IN_TIME(comesTrue([this] { return controller.telemetry().trainsDelivered >= 3; }));
    controller.stop("test");
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disarmed) << "before stop() returned";
    const auto delivered = controller.telemetry().trainsDelivered;
    const auto at = controller.telemetry().at;
    ASSERT_IN_TIME(comesTrue([&] { return controller.telemetry().at > at + std::chrono::seconds(1); }))
        << "the picture goes on after a stop";
    EXPECT_LE(controller.telemetry().trainsDelivered, delivered);
    arm();
    EXPECT_IN_TIME(comesTo(InterlockState::Armed)) << "a stop is over with the next arming";
}

TEST_F(Controller, RunsAtTheAskedSpeed) {
    open("sim:", 10);
    const auto before = controller.telemetry().at;
    const auto began = std::chrono::steady_clock::now();
    ASSERT_IN_TIME(comesTrue([&] { return controller.telemetry().at > before + std::chrono::seconds(10); }));
    const auto took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    EXPECT_GT(took, 0.5);
}

TEST_F(Controller, TellsWhyItDidNotArm) {
    RecordProperty("hazard", "H3");
    open("sim:stimulator?load=300ohm");
    arm("1 kohm");
    ASSERT_IN_TIME(comesTrue([this] { return !complaints.isEmpty(); }));
    EXPECT_THAT(complaints.first().toStdString(), HasSubstr("measured impedance is 299"));
    EXPECT_EQ(controller.telemetry().state, InterlockState::Disarmed);
}

TEST_F(Controller, AnUnpluggedStimulatorFaultsAndTheSessionIsKept) {
    RecordProperty("hazard", "H2");
    open("sim:stimulator?fault=unplug@3s", 4);
    arm();
    ASSERT_IN_TIME(comesTo(InterlockState::Armed));
    controller.drive(DriveSource::Manual, 1, 1);
    ASSERT_IN_TIME(comesTo(InterlockState::Faulted));
    const auto session = controller.open()->session;
    controller.resetFault();
    ASSERT_IN_TIME(comesTrue([this] { return !complaints.isEmpty(); }));
    EXPECT_THAT(complaints.first().toStdString(), HasSubstr("not reset"));
    controller.close();
    ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == Activity::Closed; }));
    EXPECT_TRUE(std::filesystem::exists(session));
}

TEST_F(Controller, GivesCapturesUntilToldNotTo) {
    open();
    arm();
    ASSERT_IN_TIME(comesTo(InterlockState::Armed));
    controller.drive(DriveSource::Manual, 1, 1);
    std::vector<std::shared_ptr<const Capture>> captures;
    QObject::connect(&controller, &BenchController::captured,
                     [&](std::shared_ptr<const Capture> c) { captures.push_back(c); });
    ScopeSettings settings;
    settings.sampleRate = Hertz(1e6);
    settings.samples = 1000;
    settings.triggerLevel = 2;
    controller.runScope(settings, false);
    ASSERT_IN_TIME(comesTrue([&] { return captures.size() >= 2; }));
    EXPECT_EQ(captures.front()->samples(), 1000U);
    controller.stopScope();
    controller.runScope(settings, true);
    const auto before = captures.size();
    ASSERT_IN_TIME(comesTrue([&] { return captures.size() > before; }));
    const auto trains = controller.telemetry().trainsDelivered;
    ASSERT_IN_TIME(comesTrue([&] { return controller.telemetry().trainsDelivered > trains + 2; }));
    EXPECT_LE(captures.size(), before + 2) << "single takes one (and one may have been under way)";
}

TEST_F(Controller, GivesUntriggeredRecordsWhereTheyAreAskedFor) {
    open("sim:", 4);
    ASSERT_TRUE(controller.open()->untriggered);
    std::vector<std::shared_ptr<const Capture>> captures;
    QObject::connect(&controller, &BenchController::captured,
                     [&](std::shared_ptr<const Capture> c) { captures.push_back(c); });
    ScopeSettings settings;
    controller.runScope(settings, false);
    const auto at = controller.telemetry().at;
    ASSERT_IN_TIME(comesTrue([&] { return controller.telemetry().at > at + std::chrono::seconds(2); }));
    EXPECT_TRUE(captures.empty()) << "they were not asked for";
    controller.runScope(settings, false, Seconds(0.3));
    ASSERT_IN_TIME(comesTrue([&] { return captures.size() >= 3; }));
    for (const auto& capture : captures) EXPECT_TRUE(capture->untriggered);
    controller.stopScope();
}

TEST_F(Controller, TellsThatTheOscilloscopeStoppedAndTakesAnotherOrder) {
    RecordProperty("hazard", "H9");
    open("sim:oscilloscope?fault=unplug@2s..5s", 4);
    QStringList stops;
    QObject::connect(&controller, &BenchController::scopeStopped, [&](const QString& why) { stops << why; });
    int captures = 0;
    QObject::connect(&controller, &BenchController::captured, [&] { ++captures; });
    controller.runScope(ScopeSettings{}, false);
    ASSERT_IN_TIME(comesTrue([&] { return !stops.isEmpty(); }));
    EXPECT_THAT(stops.first().toStdString(), HasSubstr("unplugged"));
    EXPECT_EQ(complaints, stops) << "once, and to everybody";
    ASSERT_IN_TIME(comesTrue([&] { return controller.telemetry().at > std::chrono::seconds(5); }));
    controller.runScope(ScopeSettings{}, false, Seconds(0.2));
    EXPECT_IN_TIME(comesTrue([&] { return captures > 0; }));
    EXPECT_EQ(stops.size(), 1);
    ScopeSettings impossible;
    impossible.samples = 0;
    controller.runScope(impossible, false);
    ASSERT_IN_TIME(comesTrue([&] { return stops.size() == 2; }));
    EXPECT_THAT(stops.last().toStdString(), HasSubstr("record of 0 samples"));
}

TEST_F(Controller, RunsAProtocolAndTellsHowItEnded) {
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&controller, &BenchController::finished,
                     [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    controller.run(
        orderOf("protocol({ title: 'T', needs: ['stimulator', 'oscilloscope'], parameters: {} });\n"
                "function run(p) { log('hello'); bench.arm(); bench.drive('manual', { roughness: 1, pressure: 1 });"
                " record.trial('a', measure.train(bench.capture())); }"));
    ASSERT_IN_TIME(comesTrue([&] { return ended != nullptr; }));
    EXPECT_FALSE(ended->result.outcome.error) << ended->result.outcome.error->message;
    EXPECT_EQ(ended->result.verdict(), "");
    const auto feed = controller.takeRunFeed();
    EXPECT_THAT(feed.log, testing::ElementsAre("hello"));
    ASSERT_EQ(feed.trials.size(), 1U);
    EXPECT_EQ(feed.trials[0]["condition"], "a");
    EXPECT_EQ(feed.captures.size(), 1U);
    EXPECT_EQ(controller.activity(), Activity::Closed);
}

TEST_F(Controller, NoRunBeginsBetweenTheEndOfOneAndWhatTellsIt) {
    const auto order =
        orderOf("protocol({ title: 'T', needs: [], parameters: {} });\nfunction run(p) { log('hello'); }");
    std::vector<std::uint64_t> ended;
    std::vector<Activity> then;
    QObject::connect(&controller, &BenchController::finished, [&](std::shared_ptr<const gui::FinishedRun> run) {
        ended.push_back(run->number);
        then.push_back(controller.activity());
    });
    std::uint64_t second = 0;
    QObject::connect(&controller, &BenchController::changed, [&] {
        if (controller.activity() != Activity::Closed || second != 0) return;
        // Runs at the first possible moment, like a click that was waiting for the end of a run.
        QMetaObject::invokeMethod(
            &controller, [&] { second = controller.run(order); }, Qt::QueuedConnection);
    });
    const auto first = controller.run(order);
    ASSERT_IN_TIME(comesTrue([&] { return ended.size() == 2; }));
    EXPECT_THAT(ended, testing::ElementsAre(first, second));
    EXPECT_NE(first, second);
    EXPECT_THAT(then, testing::Each(Activity::Closed));
}

TEST_F(Controller, StopEndsAScriptThatLoopsForEver) {
    RecordProperty("hazard", "H10");
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&controller, &BenchController::finished,
                     [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    controller.run(
        orderOf("protocol({ title: 'T', needs: ['stimulator'], parameters: {} });\n"
                "function run(p) { bench.arm(); log('armed'); for (;;) {} }"));
    ASSERT_IN_TIME(comesTrue([&] { return controller.telemetry().state == InterlockState::Armed; }));
    controller.stop("test");
    EXPECT_NE(controller.telemetry().state, InterlockState::Armed);
    ASSERT_IN_TIME(comesTrue([&] { return ended != nullptr; }));
    EXPECT_EQ(ended->result.verdict(), "stopped");
}

TEST_F(Controller, PutsAQuestionAndTakesOnlyAFittingAnswer) {
    std::shared_ptr<const gui::FinishedRun> ended;
    std::optional<OperatorQuestion> asked;
    QObject::connect(&controller, &BenchController::finished,
                     [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    QObject::connect(&controller.windowOperator(), &gui::WindowOperator::asked, &controller,
                     [&](const OperatorQuestion& question) { asked = question; });
    controller.run(
        orderOf("protocol({ title: 'T', needs: [], parameters: {} });\n"
                "function run(p) { log('got ' + operator.enter('room', 'Room temperature', "
                "{ unit: 'degC', min: 10, max: 40 })); }"));
    ASSERT_IN_TIME(comesTrue([&] { return asked.has_value(); }));
    EXPECT_EQ(asked->text, "Room temperature");
    EXPECT_FALSE(controller.windowOperator().answer(asked->id, "99"));
    EXPECT_TRUE(controller.windowOperator().answer(asked->id - 1, "30"))
        << "to a question from before: it does nothing";
    EXPECT_TRUE(controller.windowOperator().answer(asked->id, "21.5"));
    ASSERT_IN_TIME(comesTrue([&] { return ended != nullptr; }));
    EXPECT_THAT(controller.takeRunFeed().log, testing::ElementsAre("got 21.5"));
}

TEST_F(Controller, ARunKeepsItsProfileAndDisarmingEndsIt) {
    RecordProperty("hazard", "H12");
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&controller, &BenchController::finished,
                     [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    QString said;
    QObject::connect(&controller, &BenchController::failed, [&](const QString& what) { said = what; });
    controller.run(
        orderOf("protocol({ title: 'T', needs: [], parameters: {} });\n"
                "function run(p) { for (;;) bench.wait(0.1); }"));
    EXPECT_EQ(controller.activity(), Activity::Opening) << "at once, so that no other run is begun";
    ASSERT_IN_TIME(comesTrue([&] { return controller.activity() == Activity::Running; }));
    auto changed = controller.profile();
    const auto before = controller.profile().encoding.amplitudeMax;
    changed.encoding.amplitudeMax = Volts(12);
    controller.setProfile(changed);
    ASSERT_IN_TIME(comesTrue([&] { return said.contains("The profile was not changed"); })) << said.toStdString();
    EXPECT_EQ(controller.profile().encoding.amplitudeMax, before);
    controller.disarm();
    ASSERT_IN_TIME(comesTrue([&] { return ended != nullptr; }));
    EXPECT_EQ(ended->result.verdict(), "stopped");
}

}  // namespace
}  // namespace tacto::test
