// Tests a stop at every moment between an operator's order and its output: while the order waits, while devices open,
// between opening and start, during any later call, and while the window closes (H2).
#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "app/gui/controller/BenchController.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "tests/gui/Person.h"
#include "tests/gui/controller/WatchedDriver.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using gui::Activity;
using gui::BenchController;
using testing::HasSubstr;

/// Holds a thread until the test opens the barrier. Opens by itself after 20 s, so that a failing test ends.
class Barrier {
public:
    void wait() {
        reached_ = true;
        static_cast<void>(open_.wait_for(std::chrono::seconds(20)));
    }
    [[nodiscard]] bool reached() const { return reached_; }
    void release() { let_.set_value(); }

private:
    std::atomic<bool> reached_{false};
    std::promise<void> let_;
    std::shared_future<void> open_{let_.get_future()};
};

class ControllerStop : public testing::Test {
protected:
    void SetUp() override {
        RecordProperty("hazard", "H2");
        makeController();
    }
    void makeController() {
        controller = std::make_unique<BenchController>(watchedRegistry(watch));
        QObject::connect(controller.get(), &BenchController::failed,
                         [this](const QString& what) { complaints << what; });
        QObject::connect(controller.get(), &BenchController::finished,
                         [this](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    }
    [[nodiscard]] gui::LiveOrder live() const {
        gui::LiveOrder order;
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.needed = {Role::Stimulator};
        order.profile = controller->profile();
        return order;
    }
    /// A script that arms, delivers three trains and ends.
    [[nodiscard]] RunOrder delivering() const {
        RunOrder order;
        order.script.name = "test";
        order.script.text =
            "protocol({ title: 'T', needs: ['stimulator'], parameters: {} });\n"
            "function run(p) { bench.arm(); bench.drive('manual', { roughness: 1, pressure: 1 }); bench.wait(1.2); }";
        order.declaration = readDeclaration(order.script).value();
        order.settings = applySettings(order.declaration, {}).value();
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = controller->profile();
        order.limits = controller->limits();
        return order;
    }
    void openLive() {
        controller->openLive(live());
        ASSERT_IN_TIME(comesTrue([this] { return controller->activity() == Activity::Live; }));
    }
    void arm() {
        ArmRequest request;
        request.operatorConfirmed = true;
        controller->arm(request);
    }
    /// Opens a bench and holds its thread in a call of the stimulator until `barrier` opens.
    void openHeld(const std::shared_ptr<Barrier>& barrier) {
        const auto hold = std::make_shared<std::atomic<bool>>(false);
        watch->onCall = [barrier, hold, own = std::this_thread::get_id()](int) {
            if (std::this_thread::get_id() != own && hold->exchange(false)) barrier->wait();
        };
        openLive();
        *hold = true;
        ASSERT_IN_TIME(comesTrue([&] { return barrier->reached(); }));
    }
    void expectStoppedRun() {
        ASSERT_IN_TIME(comesTrue([this] { return ended != nullptr; }));
        EXPECT_EQ(ended->result.verdict(), "stopped");
        ASSERT_TRUE(ended->result.outcome.error);
        EXPECT_EQ(ended->result.outcome.error->code, ErrorCode::Stopped) << ended->result.outcome.error->message;
        EXPECT_EQ(watch->trains, 0);
    }

    std::shared_ptr<Watch> watch = std::make_shared<Watch>();
    QStringList complaints;
    std::shared_ptr<const gui::FinishedRun> ended;
    std::unique_ptr<BenchController> controller;
};

TEST_F(ControllerStop, WhileDevicesOpenEndsTheRun) {
    const auto barrier = std::make_shared<Barrier>();
    watch->onOpen = [barrier](const OpenContext&) { barrier->wait(); };
    controller->run(delivering());
    ASSERT_IN_TIME(comesTrue([&] { return barrier->reached(); }));
    ASSERT_IN_TIME(comesTrue([this] { return controller->activity() == Activity::Opening; }));
    controller->stop("Esc");
    barrier->release();
    expectStoppedRun();
    EXPECT_GE(watch->offs, 1) << "what was opened was switched off";
    EXPECT_THAT(ended->result.outcome.error->message, HasSubstr("stopped while devices were opening"));
    EXPECT_TRUE(ended->result.session.empty());

    watch->onOpen = nullptr;
    ended.reset();
    controller->run(delivering());
    ASSERT_IN_TIME(comesTrue([this] { return ended != nullptr; }));
    EXPECT_FALSE(ended->result.outcome.error) << "a new order runs: " << ended->result.outcome.error->message;
    EXPECT_GE(watch->trains, 3);
}

TEST_F(ControllerStop, WhileDevicesOpenEndsTheOpeningOfALiveBench) {
    const auto barrier = std::make_shared<Barrier>();
    watch->onOpen = [barrier](const OpenContext&) { barrier->wait(); };
    controller->openLive(live());
    ASSERT_IN_TIME(comesTrue([&] { return barrier->reached(); }));
    controller->stop("Esc");
    barrier->release();
    ASSERT_IN_TIME(comesTrue([this] { return !complaints.isEmpty() && controller->activity() == Activity::Closed; }));
    EXPECT_THAT(complaints.first().toStdString(), HasSubstr("stopped while devices were opening"));
    EXPECT_GE(watch->offs, 1);
    EXPECT_EQ(watch->trains, 0);
}

TEST_F(ControllerStop, TheWindowThatClosesWhileDevicesOpenEndsTheOpening) {
    const auto stopSeen = std::make_shared<std::atomic<bool>>(false);
    const auto opening = std::make_shared<std::atomic<bool>>(false);
    // The driver takes until the window has closed.
    watch->onOpen = [=](const OpenContext& context) {
        *opening = true;
        const auto giveUp = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (!context.stopped() && std::chrono::steady_clock::now() < giveUp) std::this_thread::yield();
        *stopSeen = context.stopped();
    };
    controller->run(delivering());
    ASSERT_IN_TIME(comesTrue([&] { return opening->load(); }));
    controller.reset();
    EXPECT_TRUE(*stopSeen);
    EXPECT_EQ(watch->trains, 0);
    EXPECT_GE(watch->offs, 1);
}

TEST_F(ControllerStop, AtAnyCallFromOpeningToTheEndIsFollowedByNoTrain) {
    // Counts the calls from the first question to the device, through prepare and start, to the end of the run.
    int calls = 1'000;
    for (int at = 1; at <= calls; ++at) {
        watch->calls = 0;
        ended.reset();
        std::atomic<int> trainsAtStop{-1};
        watch->onCall = [&](int number) {
            if (number != at) return;
            controller->stop("test");
            trainsAtStop = watch->trains.load();
        };
        controller->run(delivering());
        ASSERT_IN_TIME(comesTrue([this] { return ended != nullptr; })) << "stopped at call " << at;
        if (trainsAtStop < 0) {  // the run ended before this call
            EXPECT_FALSE(ended->result.outcome.error) << ended->result.outcome.error->message;
            EXPECT_GE(watch->trains, 3);
            calls = at;
            break;
        }
        // The call in progress continues; a train that it starts is switched off afterwards.
        EXPECT_LE(watch->trains, trainsAtStop + 1) << "stopped at call " << at;
        EXPECT_GE(watch->offs, 1);
        EXPECT_EQ(ended->result.verdict(), "stopped") << "stopped at call " << at;
        watch->trains = watch->offs = 0;
    }
    EXPECT_GE(calls, 8);
    EXPECT_LT(calls, 1'000);
}

TEST_F(ControllerStop, BetweenTheArmClickAndItsTaskNothingIsArmed) {
    const auto barrier = std::make_shared<Barrier>();
    openHeld(barrier);
    arm();
    controller->drive(DriveSource::Manual, 1, 1);
    controller->stop("Esc");
    barrier->release();
    ASSERT_IN_TIME(comesTrue([this] { return complaints.size() == 2; }));
    EXPECT_THAT(complaints.first().toStdString(), HasSubstr("stopped before"));
    EXPECT_EQ(controller->telemetry().state, InterlockState::Disarmed);
    EXPECT_EQ(watch->trains, 0) << "not even a check pulse";
    arm();
    EXPECT_IN_TIME(comesTrue([this] { return controller->telemetry().state == InterlockState::Armed; }))
        << "a new click arms";
}

TEST_F(ControllerStop, BetweenTheRunClickAndItsTaskNothingIsOpened) {
    const auto barrier = std::make_shared<Barrier>();
    openHeld(barrier);
    const auto opened = std::make_shared<std::atomic<int>>(0);
    watch->onOpen = [opened](const OpenContext&) { ++*opened; };
    controller->run(delivering());
    controller->stop("Esc");
    barrier->release();
    expectStoppedRun();
    EXPECT_EQ(*opened, 0);
}

TEST_F(ControllerStop, AnOpeningThatWaitsBehindAStopDoesNotBegin) {
    const auto opened = std::make_shared<std::atomic<int>>(0);
    const auto barrier = std::make_shared<Barrier>();
    openHeld(barrier);
    watch->onOpen = [opened](const OpenContext&) { ++*opened; };
    controller->openLive(live());
    controller->stop("Esc");
    barrier->release();
    ASSERT_IN_TIME(comesTrue([this] { return !complaints.isEmpty() && controller->activity() == Activity::Closed; }));
    EXPECT_EQ(*opened, 0);
}

TEST_F(ControllerStop, WithNothingOpenVoidsWhatWasAskedForBefore) {
    controller->stop("Esc");
    openLive();
    EXPECT_TRUE(complaints.isEmpty()) << "what is asked for after it is done";
}

}  // namespace
}  // namespace tacto::test
