// The levels of the drift check in a session with a participant whose sensitivity falls.
#include "core/pilot/PilotSession.h"
#include "core/pilot/VirtualPilotParticipant.h"
#include "tests/pilot/StageFixture.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

/// Passes everything to a virtual participant, and notes what they felt.
class Noting final : public PilotParticipant {
public:
    explicit Noting(PilotParticipant& people) : people_(people) {}
    void show(const PilotScreen& screen) override { people_.show(screen); }
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override {
        people_.stop = stop;
        if (prompt.name == "ending") return answer("end");
        if (prompt.name == "on-demand") {
            offered.push_back(prompt);
            for (const auto& each : prompt.targets)
                if (each.key != "go-on" && each.text.find("(felt 5 times)") == std::string::npos)
                    return answer(each.key);
            return answer("go-on");
        }
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
    std::vector<PilotPrompt> offered;  // prompts on demand

private:
    [[nodiscard]] static PilotAnswer answer(std::string key) {
        PilotAnswer made;
        made.keys = {std::move(key)};
        return made;
    }
    PilotParticipant& people_;
};

TEST_F(PilotStageTest, NoDriftTrialLiesAboveTheTopOfTheRange) {
    RecordProperty("hazard", "H6");
    VirtualObserverSettings who;
    who.who = drawParticipant({}, 7, 0, Micros(200), SquareCentimetres(4));
    who.adaptation = 3;
    PilotSettings settings;
    settings.code = "P-7K3M";
    settings.basis = SessionBasis::Virtual;
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
                                                   [&]() -> Result<void> {
                                                       const auto goesOn = test.driftCheck(2);
                                                       if (!goesOn) return failure(goesOn);
                                                       EXPECT_FALSE(*goesOn) << "they end it here";
                                                       return {};
                                                   }};
    for (const auto& step : steps) {
        accepted(step());
    }
    ASSERT_TRUE(thresholds.found()->usable);
    EXPECT_EQ(test.driftJson()[0]["adapted"], true) << "higher levels were wanted: " << test.driftJson().dump();
    std::size_t onDemand = 0;
    for (const auto& each : people.felt) onDemand += each.drawnFor.find(" on demand ") != std::string::npos;
    EXPECT_EQ(onDemand, 5 * names.size()) << "each at most five times";
    for (const auto& offered : people.offered) {
        ASSERT_EQ(offered.targets.size(), names.size() + 1);
        for (std::size_t place = 0; place < names.size(); ++place)
            EXPECT_EQ(offered.targets[place].key, kAnswerPlaces[place]) << "where the answers of the test are";
    }
    EXPECT_TRUE(record_->find(row::kPhase, "ending before block 2"));
    std::size_t trials = 0;
    for (const auto& each : people.felt) {
        if (each.drawnFor.find(" drift ") == std::string::npos) continue;
        ++trials;
        EXPECT_LE(each.level, thresholds.found()->max) << each.drawnFor;
    }
    EXPECT_EQ(trials, 4 * DriftCheckSettings().trials) << "a check, and one after each rest";
    const auto measured = rows();
    EXPECT_EQ(std::ranges::count_if(measured,
                                    [](const SessionRow& each) {
                                        return each.name == row::kImpedance &&
                                               each.body["name"].get<std::string>().starts_with("seated again");
                                    }),
              3)
        << "the electrodes, before it is armed after each rest";
}

TEST_F(PilotStageTest, ElectrodesThatMeasureOtherwiseBeforeABlockHoldItBack) {
    RecordProperty("hazard", "H3");
    PilotCare care(*stage_);
    ASSERT_TRUE(record_->write(row::kImpedance, "part 1 second", {{"impedance_ohm", 1000}}));
    EXPECT_TRUE(care.beforeBlock(1)) << "1 kohm";
    begin();
    PilotCare other(*stage_);
    ASSERT_TRUE(record_->write(row::kImpedance, "part 1 second", {{"impedance_ohm", 700}}));
    EXPECT_THAT(other.beforeBlock(1), test::refusedSaying("30 %"));
    EXPECT_EQ(bench_->telemetry().trainsDelivered, 0U);
}

}  // namespace
}  // namespace tacto::test
