// The desk with a simulated bench: opening, driving, stopping, capturing, running.
#include <QSignalSpy>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/desk/BenchDesk.h"
#include "app/scripting/ProtocolLibrary.h"
#include "core/electrode/Load.h"
#include "tests/gui/Person.h"

namespace tacto::test {
namespace {

using gui::Activity;
using gui::BenchDesk;
using testing::HasSubstr;

class Desk : public testing::Test {
protected:
    Desk() {
        QObject::connect(&desk, &BenchDesk::failed, [this](const QString& what) { complaints << what; });
    }
    void open(const char* uri = "sim:", double speed = 1) {
        gui::LiveOrder order;
        order.uris.push_back(*DeviceUri::parse(uri));
        if (std::string_view(uri) != "sim:") order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = desk.profile();
        order.speed = speed;
        desk.openLive(order);
        ASSERT_TRUE(comesTrue([this] { return desk.activity() == Activity::Live || !complaints.isEmpty(); }));
        ASSERT_TRUE(complaints.isEmpty()) << complaints.first().toStdString();
    }
    void arm(const char* load = "1 kohm") {
        ArmRequest request;
        request.load = load;
        request.operatorConfirmed = true;
        desk.arm(request);
    }
    bool comesTo(InterlockState state) {
        return comesTrue([&] { return desk.telemetry().state == state; });
    }
    RunOrder orderOf(const std::string& script, std::map<std::string, std::string> settings = {}) {
        RunOrder order;
        order.script.name = "test";
        order.script.text = script;
        order.declaration = readDeclaration(order.script).value();
        order.settings = applySettings(order.declaration, settings).value();
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = desk.profile();
        order.limits = desk.limits();
        return order;
    }

    BenchDesk desk{simulatedRegistry};
    QStringList complaints;
};

TEST_F(Desk, IsClosedUntilABenchIsOpened) {
    EXPECT_EQ(desk.activity(), Activity::Closed);
    EXPECT_EQ(desk.telemetry().state, InterlockState::Disconnected);
    EXPECT_FALSE(desk.open());
    desk.stop("nobody");  // does no harm
    open();
    EXPECT_TRUE(desk.open()->simulated());
    EXPECT_TRUE(desk.open()->paced);
    EXPECT_EQ(desk.open()->streams.size(), 3U);
    EXPECT_TRUE(std::filesystem::exists(desk.open()->session));
    desk.close();
    EXPECT_TRUE(comesTrue([this] { return desk.activity() == Activity::Closed; }));
}

TEST_F(Desk, AnImpedanceCheckEndsDisarmedWhateverIsComplainedAboutMeanwhile) {
    RecordProperty("hazard", "H12");
    open();
    double measured = 0;
    QObject::connect(&desk, &BenchDesk::checked, [&](double ohms) { measured = ohms; });
    desk.drive(DriveSource::Manual, 2, 1);  // refused: a complaint of another kind, before the check ends
    ArmRequest request{"1 kohm", true, true};
    desk.checkImpedance(request);
    ASSERT_TRUE(comesTrue([&] { return measured > 0; }));
    EXPECT_NEAR(measured, 1000, 50);
    EXPECT_FALSE(complaints.isEmpty());
    EXPECT_EQ(desk.telemetry().state, InterlockState::Disarmed);
    EXPECT_EQ(desk.telemetry().trainsDelivered, 0U);
}

TEST_F(Desk, ArmingThatIsRefusedLeavesTheBenchDisarmed) {
    RecordProperty("hazard", "H12");
    open();
    arm();
    ASSERT_TRUE(comesTo(InterlockState::Armed));
    ArmRequest request{"1 kohm", true, true};
    request.confirmed = "another stimulator into 2 kohm";
    desk.arm(request);
    ASSERT_TRUE(comesTo(InterlockState::Disarmed)) << "what was armed before went on";
    ASSERT_TRUE(comesTrue([this] { return !complaints.isEmpty(); }));
    EXPECT_THAT(complaints.last().toStdString(), HasSubstr("the operator confirmed \"another stimulator"));
}

TEST_F(Desk, SaysWhatArmingConfirms) {
    RecordProperty("hazard", "H12");
    EXPECT_EQ(desk.confirmationOf(Load::resistor(Ohms(1000))), "");
    open("sim:stimulator?mode=current");
    EXPECT_THAT(desk.confirmationOf(Load::resistor(Ohms(2000))),
                HasSubstr("SIM-1 into 2 kohm, up to 40 V and 25 mA, electrode area not stated"));
    ArmRequest request{"2 kohm", true, true};
    request.confirmed = desk.confirmationOf(Load::resistor(Ohms(2000)));
    desk.fitLoad("2 kohm");
    desk.arm(request);
    EXPECT_TRUE(comesTo(InterlockState::Armed)) << "as the bench says it itself";
}

TEST_F(Desk, ArmsAndDeliversByHandAndStopsAtOnce) {
    RecordProperty("hazard", "H5");
    open();
    arm();
    ASSERT_TRUE(comesTo(InterlockState::Armed));
    desk.drive(DriveSource::Manual, 0.5, 1);
    ASSERT_TRUE(comesTo(InterlockState::Delivering));
    EXPECT_TRUE(comesTrue([this] { return desk.telemetry().trainsDelivered >= 3; }));
    desk.stop("test");
    EXPECT_EQ(desk.telemetry().state, InterlockState::Disarmed) << "before stop() returned";
    const auto delivered = desk.telemetry().trainsDelivered;
    const auto at = desk.telemetry().at;
    ASSERT_TRUE(comesTrue([&] { return desk.telemetry().at > at + std::chrono::seconds(1); }))
        << "the picture goes on after a stop";
    EXPECT_LE(desk.telemetry().trainsDelivered, delivered);
    arm();
    EXPECT_TRUE(comesTo(InterlockState::Armed)) << "a stop is over with the next arming";
}

TEST_F(Desk, RunsAtTheAskedSpeed) {
    open("sim:", 10);
    const auto before = desk.telemetry().at;
    const auto began = std::chrono::steady_clock::now();
    ASSERT_TRUE(comesTrue([&] { return desk.telemetry().at > before + std::chrono::seconds(10); }));
    const auto took = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    EXPECT_GT(took, 0.5);
}

TEST_F(Desk, TellsWhyItDidNotArm) {
    RecordProperty("hazard", "H3");
    open("sim:stimulator?load=300ohm");
    arm("1 kohm");
    ASSERT_TRUE(comesTrue([this] { return !complaints.isEmpty(); }));
    EXPECT_THAT(complaints.first().toStdString(), HasSubstr("measured impedance is 299"));
    EXPECT_EQ(desk.telemetry().state, InterlockState::Disarmed);
}

TEST_F(Desk, AnUnpluggedStimulatorFaultsAndTheSessionIsKept) {
    RecordProperty("hazard", "H3");
    open("sim:stimulator?fault=unplug@3s", 4);
    arm();
    ASSERT_TRUE(comesTo(InterlockState::Armed));
    desk.drive(DriveSource::Manual, 1, 1);
    ASSERT_TRUE(comesTo(InterlockState::Faulted));
    const auto session = desk.open()->session;
    desk.resetFault();
    ASSERT_TRUE(comesTrue([this] { return !complaints.isEmpty(); }));
    EXPECT_THAT(complaints.first().toStdString(), HasSubstr("not reset"));
    desk.close();
    ASSERT_TRUE(comesTrue([this] { return desk.activity() == Activity::Closed; }));
    EXPECT_TRUE(std::filesystem::exists(session));
}

TEST_F(Desk, GivesCapturesUntilToldNotTo) {
    open();
    arm();
    ASSERT_TRUE(comesTo(InterlockState::Armed));
    desk.drive(DriveSource::Manual, 1, 1);
    std::vector<std::shared_ptr<const Capture>> captures;
    QObject::connect(&desk, &BenchDesk::captured, [&](std::shared_ptr<const Capture> c) { captures.push_back(c); });
    ScopeSettings settings;
    settings.sampleRate = Hertz(1e6);
    settings.samples = 1000;
    settings.triggerLevel = 2;
    desk.runScope(settings, false);
    ASSERT_TRUE(comesTrue([&] { return captures.size() >= 2; }));
    EXPECT_EQ(captures.front()->samples(), 1000U);
    desk.stopScope();
    desk.runScope(settings, true);
    const auto before = captures.size();
    ASSERT_TRUE(comesTrue([&] { return captures.size() > before; }));
    const auto trains = desk.telemetry().trainsDelivered;
    ASSERT_TRUE(comesTrue([&] { return desk.telemetry().trainsDelivered > trains + 2; }));
    EXPECT_LE(captures.size(), before + 2) << "single takes one (and one may have been under way)";
}

TEST_F(Desk, GivesUntriggeredRecordsWhereTheyAreAskedFor) {
    open("sim:", 4);
    ASSERT_TRUE(desk.open()->untriggered);
    std::vector<std::shared_ptr<const Capture>> captures;
    QObject::connect(&desk, &BenchDesk::captured, [&](std::shared_ptr<const Capture> c) { captures.push_back(c); });
    ScopeSettings settings;
    desk.runScope(settings, false);
    const auto at = desk.telemetry().at;
    ASSERT_TRUE(comesTrue([&] { return desk.telemetry().at > at + std::chrono::seconds(2); }));
    EXPECT_TRUE(captures.empty()) << "nobody asked for them";
    desk.runScope(settings, false, Seconds(0.3));
    ASSERT_TRUE(comesTrue([&] { return captures.size() >= 3; }));
    for (const auto& capture : captures) EXPECT_TRUE(capture->untriggered);
    desk.stopScope();
}

TEST_F(Desk, TellsThatTheOscilloscopeStoppedAndTakesAnotherOrder) {
    RecordProperty("hazard", "H9");
    open("sim:oscilloscope?fault=unplug@2s..5s", 4);
    QStringList stops;
    QObject::connect(&desk, &BenchDesk::scopeStopped, [&](const QString& why) { stops << why; });
    int captures = 0;
    QObject::connect(&desk, &BenchDesk::captured, [&] { ++captures; });
    desk.runScope(ScopeSettings{}, false);
    ASSERT_TRUE(comesTrue([&] { return !stops.isEmpty(); }));
    EXPECT_THAT(stops.first().toStdString(), HasSubstr("unplugged"));
    EXPECT_EQ(complaints, stops) << "once, and to everybody";
    ASSERT_TRUE(comesTrue([&] { return desk.telemetry().at > std::chrono::seconds(5); }));
    desk.runScope(ScopeSettings{}, false, Seconds(0.2));
    EXPECT_TRUE(comesTrue([&] { return captures > 0; }));
    EXPECT_EQ(stops.size(), 1);
    ScopeSettings impossible;
    impossible.samples = 0;
    desk.runScope(impossible, false);
    ASSERT_TRUE(comesTrue([&] { return stops.size() == 2; }));
    EXPECT_THAT(stops.last().toStdString(), HasSubstr("record of 0 samples"));
}

TEST_F(Desk, RunsAProtocolAndTellsHowItEnded) {
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&desk, &BenchDesk::finished, [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    desk.run(
        orderOf("protocol({ title: 'T', needs: ['stimulator', 'oscilloscope'], parameters: {} });\n"
                "function run(p) { log('hello'); bench.arm(); bench.drive('manual', { roughness: 1, pressure: 1 });"
                " record.trial('a', measure.train(bench.capture())); }"));
    ASSERT_TRUE(comesTrue([&] { return ended != nullptr; }));
    EXPECT_FALSE(ended->result.outcome.error) << ended->result.outcome.error->message;
    EXPECT_EQ(ended->result.verdict(), "");
    const auto feed = desk.takeRunFeed();
    EXPECT_THAT(feed.log, testing::ElementsAre("hello"));
    ASSERT_EQ(feed.trials.size(), 1U);
    EXPECT_EQ(feed.trials[0]["condition"], "a");
    EXPECT_EQ(feed.captures.size(), 1U);
    EXPECT_EQ(desk.activity(), Activity::Closed);
}

TEST_F(Desk, StopEndsAScriptThatLoopsForEver) {
    RecordProperty("hazard", "H10");
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&desk, &BenchDesk::finished, [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    desk.run(
        orderOf("protocol({ title: 'T', needs: ['stimulator'], parameters: {} });\n"
                "function run(p) { bench.arm(); log('armed'); for (;;) {} }"));
    ASSERT_TRUE(comesTrue([&] { return desk.telemetry().state == InterlockState::Armed; }));
    desk.stop("test");
    EXPECT_NE(desk.telemetry().state, InterlockState::Armed);
    ASSERT_TRUE(comesTrue([&] { return ended != nullptr; }));
    EXPECT_EQ(ended->result.verdict(), "stopped");
}

TEST_F(Desk, PutsAQuestionAndTakesOnlyAFittingAnswer) {
    std::shared_ptr<const gui::FinishedRun> ended;
    std::optional<OperatorQuestion> asked;
    QObject::connect(&desk, &BenchDesk::finished, [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    QObject::connect(&desk.operatorDesk(), &gui::OperatorDesk::asked, &desk,
                     [&](const OperatorQuestion& question) { asked = question; });
    desk.run(
        orderOf("protocol({ title: 'T', needs: [], parameters: {} });\n"
                "function run(p) { log('got ' + operator.enter('room', 'Room temperature', "
                "{ unit: 'degC', min: 10, max: 40 })); }"));
    ASSERT_TRUE(comesTrue([&] { return asked.has_value(); }));
    EXPECT_EQ(asked->text, "Room temperature");
    EXPECT_FALSE(desk.operatorDesk().answer(asked->id, "99"));
    EXPECT_TRUE(desk.operatorDesk().answer(asked->id - 1, "30")) << "to a question from before: it does nothing";
    EXPECT_TRUE(desk.operatorDesk().answer(asked->id, "21.5"));
    ASSERT_TRUE(comesTrue([&] { return ended != nullptr; }));
    EXPECT_THAT(desk.takeRunFeed().log, testing::ElementsAre("got 21.5"));
}

TEST_F(Desk, ARunKeepsItsProfileAndDisarmingEndsIt) {
    RecordProperty("hazard", "H12");
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&desk, &BenchDesk::finished, [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    QString said;
    QObject::connect(&desk, &BenchDesk::failed, [&](const QString& what) { said = what; });
    desk.run(
        orderOf("protocol({ title: 'T', needs: [], parameters: {} });\n"
                "function run(p) { for (;;) bench.wait(0.1); }"));
    EXPECT_EQ(desk.activity(), Activity::Opening) << "at once, so that no other run is begun";
    ASSERT_TRUE(comesTrue([&] { return desk.activity() == Activity::Running; }));
    auto changed = desk.profile();
    const auto before = desk.profile().encoding.amplitudeMax;
    changed.encoding.amplitudeMax = Volts(12);
    desk.setProfile(changed);
    ASSERT_TRUE(comesTrue([&] { return said.contains("The profile was not changed"); })) << said.toStdString();
    EXPECT_EQ(desk.profile().encoding.amplitudeMax, before);
    desk.disarm();
    ASSERT_TRUE(comesTrue([&] { return ended != nullptr; }));
    EXPECT_EQ(ended->result.verdict(), "stopped");
}

}  // namespace
}  // namespace tacto::test
