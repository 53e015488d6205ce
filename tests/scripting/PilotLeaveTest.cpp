// A STOP that is pressed while the run of a pilot session ends.
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

#include "app/run/PilotRun.h"
#include "app/run/Shipped.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/scripting/DataHome.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

/// A person who gives no answers and presses STOP at any time, as ParticipantDesk reports it.
class PressingPerson final : public PilotParticipant {
public:
    void show(const PilotScreen& /*screen*/) override {
        const std::scoped_lock lock(mutex_);
        listens_ = true;
    }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override {
        return fail(ErrorCode::NotFound, "no answer to {}", prompt.name);
    }
    void delivered(const FeltPresentation& /*felt*/) override {}
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return {}; }
    void cancel() noexcept override {}
    void leave() noexcept override {
        const std::scoped_lock lock(mutex_);
        listens_ = false;
        stop = nullptr;
    }
    [[nodiscard]] bool holding() const noexcept override { return true; }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return false; }
    /// Presses STOP. Returns true if the session received it.
    bool press() {
        const std::scoped_lock lock(mutex_);
        if (!listens_ || !stop) return false;
        stop("participant");
        return true;
    }

private:
    std::mutex mutex_;
    bool listens_ = false;  // guarded by mutex_
};

class PilotLeave : public DataHome {};

TEST_F(PilotLeave, AStopIsHeardUntilTheRunEndsAndFindsNoBenchThatIsGone) {
    RecordProperty("hazard", "H2");
    const ScratchDir folder;
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSimulatedDriver());
    Registry registry(std::move(drivers));
    RunOrder order;
    order.script = ProtocolLibrary().find("pilot-thresholds").value();
    order.declaration = readDeclaration(order.script).value();
    order.settings = applySettings(order.declaration, {{"participant", "virtual:7"}}).value();
    order.needed = order.declaration.needs;
    order.limits = shippedLimits().value();
    order.profile = shippedProfile().value();
    PressingPerson person;
    PilotOrder pilot;
    pilot.study = folder.path() / "study";
    pilot.people = &person;
    auto run = PilotRun::prepare(std::move(order), std::move(pilot), registry);
    ASSERT_TRUE(run) << run.error().message;
    ASSERT_TRUE((*run)->start({}));
    static_cast<void>((*run)->run().script()->wait());
    EXPECT_TRUE(person.press()) << "the script has ended, and the bench is there";
    std::atomic<bool> ends{false};
    std::thread presser([&] {
        while (!ends) static_cast<void>(person.press());
    });
    static_cast<void>((*run)->finish());
    EXPECT_FALSE(person.press()) << "the run has ended";
    run->reset();
    EXPECT_FALSE(person.press()) << "its bench is gone";
    ends = true;
    presser.join();
}

}  // namespace
}  // namespace tacto::test
