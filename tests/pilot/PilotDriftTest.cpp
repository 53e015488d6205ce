// The drift check of a session whose participant feels less and less: which levels it presents.
#include "core/pilot/PilotSession.h"
#include "core/pilot/VirtualPilotParticipant.h"
#include "tests/pilot/StageFixture.h"

namespace tacto::test {
namespace {

/// A virtual participant, and what they felt.
class Noting final : public PilotParticipant {
public:
    explicit Noting(PilotParticipant& people) : people_(people) {}
    void show(const PilotScreen& screen) override { people_.show(screen); }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override {
        people_.stop = stop;
        return people_.ask(prompt);
    }
    void delivered(const FeltPresentation& presented) override {
        felt.push_back(presented);
        people_.delivered(presented);
    }
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return people_.takeEarly(); }
    void cancel() noexcept override { people_.cancel(); }
    [[nodiscard]] bool holding() const noexcept override { return people_.holding(); }
    [[nodiscard]] std::optional<Hindrance> hindrance() const override { return people_.hindrance(); }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return people_.answersInRealTime(); }
    std::vector<FeltPresentation> felt;

private:
    PilotParticipant& people_;
};

TEST_F(PilotStageTest, NoDriftTrialLiesAboveTheTopOfTheRange) {
    RecordProperty("hazard", "H6");
    VirtualObserverSettings who;
    who.who = drawParticipant({}, 7, 0, Micros(200), SquareCentimetres(4));
    who.adaptation = 3;
    PilotSettings settings;
    settings.code = "P-7K3M";
    settings.isVirtual = true;
    settings.blocks = 2;
    std::vector<std::string> names;
    for (const auto& each : settings.conditions) names.push_back(each.name);
    VirtualPilotParticipant participant(VirtualObserver::create(who).value(), names);
    Noting people(participant);
    stage_.reset();
    PilotSession session(*bench_, people, *record_, settings, &participant.observer(), 1);
    auto& thresholds = session.thresholds();
    auto& test = session.identification();
    const std::function<Result<void>()> steps[] = {[&] { return session.begin(true); },
                                                   [&] { return thresholds.ascendingLimits(); },
                                                   [&] { return thresholds.detection(DetectionMethod::Quest); },
                                                   [&] { return thresholds.range(); },
                                                   [&] { return test.familiarise(); },
                                                   [&] { return test.train(); },
                                                   [&] { return test.testBlock(1); },
                                                   [&] { return test.driftCheck(2); }};
    for (const auto& step : steps) {
        const auto done = step();
        ASSERT_TRUE(done) << done.error().message;
    }
    ASSERT_TRUE(thresholds.found()->usable);
    EXPECT_EQ(test.driftJson()[0]["adapted"], true) << "higher levels were wanted: " << test.driftJson().dump();
    std::size_t trials = 0;
    for (const auto& each : people.felt) {
        if (each.drawnFor.find(" drift ") == std::string::npos) continue;
        ++trials;
        EXPECT_LE(each.level, thresholds.found()->max) << each.drawnFor;
    }
    EXPECT_EQ(trials, 4 * DriftCheckSettings().trials) << "a check, and one after each rest";
}

TEST_F(PilotStageTest, ElectrodesThatMeasureOtherwiseBeforeABlockHoldItBack) {
    RecordProperty("hazard", "H3");
    PilotCare care(*stage_);
    ASSERT_TRUE(record_->write(row::kImpedance, "part 1 second", {{"impedance_ohm", 1000}}));
    EXPECT_TRUE(care.beforeBlock(1)) << "1 kohm";
    begin();
    PilotCare other(*stage_);
    ASSERT_TRUE(record_->write(row::kImpedance, "part 1 second", {{"impedance_ohm", 700}}));
    const auto refused = other.beforeBlock(1);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("30 %"));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

}  // namespace
}  // namespace tacto::test
