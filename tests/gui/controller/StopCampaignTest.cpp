// Stops runs at random moments, from the click on Run to the end of closing: after the stop has returned, no train may
// begin. Such races show only in many trials (H2).
#include <gtest/gtest.h>
#include <random>
#include <thread>

#include "app/gui/controller/BenchController.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/base/Random.h"
#include "drivers/sciencemode/ScienceModeDriver.h"
#include "tests/gui/Person.h"
#include "tests/gui/controller/WatchedDriver.h"
#include "tests/support/InTime.h"
#include "tests/support/Trials.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using gui::BenchController;

RunOrder delivering(const BenchController& controller, DeviceUri uri) {
    RunOrder order;
    order.script.name = "test";
    order.script.text =
        "protocol({ title: 'T', needs: ['stimulator'], parameters: {} });\n"
        "function run(p) { bench.arm({ load: 1000 }); bench.drive('manual', { roughness: 1, pressure: 1 });"
        " bench.wait(0.25); }";
    order.declaration = readDeclaration(order.script).value();
    order.settings = applySettings(order.declaration, {}).value();
    order.uris.push_back(std::move(uri));
    order.profile = controller.profile();
    order.profile.encoding.train.pulses = 10;  // trains of 100 ms, so that many stops come during a train
    order.profile.encoding.train.rate = Hertz(100);
    order.limits = controller.limits();
    return order;
}

/// Each trial starts a run and stops it after a random time. `heard` waits until the device has received the stop, if
/// that takes time; `output` counts what the device was told to deliver, or has delivered, so far.
void stopAtRandomMoments(BenchController& controller, const DeviceUri& uri, const std::function<void()>& heard,
                         const std::function<int()>& output) {
    testing::Test::RecordProperty("hazard", "H2");
    std::shared_ptr<const gui::FinishedRun> ended;
    QObject::connect(&controller, &BenchController::finished,
                     [&](std::shared_ptr<const gui::FinishedRun> run) { ended = run; });
    const auto order = delivering(controller, uri);
    const std::uint64_t seed = std::random_device{}();
    testing::Test::RecordProperty("seed", std::to_string(seed));
    Random random(seed, "stops");

    // The duration of an undisturbed run, from click to end.
    const auto began = std::chrono::steady_clock::now();
    controller.run(order);
    ASSERT_IN_TIME(comesTrue([&] { return ended != nullptr; }));
    // An emulated device answers on its own thread.
    ASSERT_IN_TIME(!ended->result.outcome.error) << ended->result.outcome.error->message;
    ASSERT_IN_TIME(output() >= 1);
    const auto whole = std::chrono::steady_clock::now() - began;

    int interrupted = 0;
    for (int trial = 0; trial < raceTrials(); ++trial) {
        ended.reset();
        const auto moment = std::chrono::duration_cast<std::chrono::nanoseconds>(whole * 1.1 * random.uniform());
        controller.run(order);
        // Runs on another thread, because the window's thread must continue; stop() is safe on any thread.
        int before = 0;
        std::thread hand([&] {
            std::this_thread::sleep_for(moment);
            controller.stop("operator");
            heard();
            before = output();
        });
        const bool came = comesTrue([&] { return ended != nullptr; });
        hand.join();
        ASSERT_IN_TIME(came) << "trial " << trial << ", seed " << seed;
        if (ended->result.outcome.error) ++interrupted;
        EXPECT_EQ(output(), before) << "trial " << trial << ", seed " << seed << ", stopped after "
                                    << std::chrono::duration<double>(moment).count() << " s of "
                                    << std::chrono::duration<double>(whole).count();
    }
    testing::Test::RecordProperty("interrupted", interrupted);
    EXPECT_IN_TIME(interrupted >= raceTrials() / 2);
}

TEST(StopAtRandomMomentsInRealTime, OfTheSimulatedStimulator) {
    const auto watch = std::make_shared<Watch>();
    BenchController controller(watchedRegistry(watch, false));
    stopAtRandomMoments(
        controller, *DeviceUri::parse("sim:"), [] {}, [watch] { return watch->trains.load(); });
}

TEST(StopAtRandomMomentsInRealTime, OfAnEmulatedScienceModeStimulator) {
    const SteadyClock clock;
    auto pty = sciencemode::EmulatedPty::open({}, clock);
    ASSERT_IN_TIME(pty.has_value()) << pty.error().message;
    auto& device = **pty;
    BenchController controller([] {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeScienceModeDriver(nullptr));
        return Registry(std::move(drivers));
    });
    // When stop() returns, the stop may still be on its way through the terminal; the device's reaction counts.
    const auto quiet = [&] {
        const auto giveUp = clock.now() + std::chrono::seconds(5);
        while (clock.now() < giveUp &&
               device.inspect([](auto& on, Instant now) { return on.state(now) != sciencemode::Stimulation::None; }))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    stopAtRandomMoments(controller, {"sciencemode", "", {{"tty", device.path()}, {"emulated", "yes"}}}, quiet, [&] {
        return device.inspect([](auto& on, Instant now) { return static_cast<int>(on.pulses(now).size()); });
    });
}

}  // namespace
}  // namespace tacto::test
