// Compares the markers of a whole rehearsal with its record: rows in order with their times, for any recorders.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run/PilotRun.h"
#include "app/run/Shipped.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/session/SessionReader.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/scripting/DataHome.h"
#include "tests/support/InTime.h"
#include "tests/support/MarkerRecorder.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class MarkerSession : public DataHome {
protected:
    [[nodiscard]] Result<std::unique_ptr<PilotRun>> prepare(const std::filesystem::path& study,
                                                            std::optional<MarkerAddress> markers) {
        RunOrder order;
        order.script = ProtocolLibrary().find("pilot-identification").value();
        order.declaration = readDeclaration(order.script).value();
        order.settings = applySettings(order.declaration, {{"participant", "virtual:7"}, {"blocks", "1"}}).value();
        order.needed = order.declaration.needs;
        order.limits = shippedLimits().value();
        order.profile = shippedProfile().value();
        PilotOrder pilot;
        pilot.study = study;
        pilot.markers = std::move(markers);
        return PilotRun::prepare(std::move(order), std::move(pilot), registry_);
    }
    [[nodiscard]] static Registry simulated() {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        return Registry(std::move(drivers));
    }
    /// Returns the rows of the study's only session.
    [[nodiscard]] static std::vector<SessionRow> rowsOf(const std::filesystem::path& folder) {
        const auto study = Study::open(folder, nullptr, Study::Access::Read).value();
        const auto part = study.sessions().front().parts.front().file;
        return SessionReader::open(study.pathOf(part), study.sealOf(part).value()).value().events().value();
    }
    [[nodiscard]] static std::string lineOf(std::size_t number, const SessionRow& row) {
        const auto ns = std::chrono::nanoseconds(row.at).count();
        return fmt::format("{} {}.{:09} {}", number, ns / 1'000'000'000, ns % 1'000'000'000, row.name);
    }
    [[nodiscard]] static std::string answersOf(const RunResult& result) {
        return result.outcome.results["trials"].dump() + result.outcome.results["thresholds"].dump();
    }

    Registry registry_ = simulated();
    const ScratchDir studies_;
};

TEST_F(MarkerSession, LinesAreTheRowsOfTheRecordInOrderAndSayNoMore) {
    RecordProperty("hazard", "H9");
    const MarkerAddress at{"127.0.0.1", freePort()};
    const auto folder = studies_.path() / "marked";
    auto run = prepare(folder, at);
    ASSERT_TRUE(run) << run.error().message;
    const auto code = (*run)->session().stage().settings().code;
    const MarkerRecorder recorder(at.port);
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (recorder.lines().empty() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    ASSERT_IN_TIME(!recorder.lines().empty());
    ASSERT_TRUE((*run)->start({}));
    const auto result = (*run)->finish();
    ASSERT_FALSE(result.outcome.error) << result.outcome.error->message;
    run->reset();
    while (!recorder.ended() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    ASSERT_IN_TIME(recorder.ended());

    const auto rows = rowsOf(folder);
    std::vector<std::string> expected{"0 0.000000000 connected"};
    std::map<std::string, std::vector<std::string>> ofTrials;  // outcomes of the trials, by condition
    std::vector<std::string> sinceBegin;
    for (const auto& row : rows) {
        if (!hasMarker(row.name)) continue;
        expected.push_back(lineOf(expected.size(), row));
        if (row.name == row::kTrialBegin) sinceBegin.clear();
        sinceBegin.push_back(row.name);
        if (row.name != row::kAnswer || row.body.value("phase", "") != "test") continue;
        ofTrials[row.body.value("condition", "")].push_back(fmt::format("{}", fmt::join(sinceBegin, " ")));
    }
    const auto lines = recorder.lines();
    EXPECT_EQ(lines, expected);
    ASSERT_EQ(ofTrials.size(), 5U) << "four conditions, and nothing";
    for (const auto& [condition, each] : ofTrials)
        for (const auto& names : each) EXPECT_EQ(names, "trial-begin presentation answer") << condition;

    for (const auto& line : lines) {
        for (const char* secret :
             {"rough", "smooth", "high", "low", "catch", "none", "test ", "mA", "virtual", "strong"})
            EXPECT_THAT(line, testing::Not(HasSubstr(secret)));
        EXPECT_THAT(line, testing::Not(HasSubstr(code)));
        EXPECT_THAT(line, testing::MatchesRegex("[0-9]+ [0-9]+\\.[0-9]+ [a-z-]+"));
    }
    ASSERT_TRUE(result.markers);
    EXPECT_EQ(*result.markers, (MarkerTally{expected.size() - 1, 0, 0, 1}));
    const auto said = std::ranges::find(rows, "markers", &SessionRow::name);
    ASSERT_NE(said, rows.end()) << "the record says what became of them";
    EXPECT_EQ(said->body, toJson(*result.markers));
}

TEST_F(MarkerSession, RecordersThatHangOrGoOrAreNotThereChangeNothingOfTheSession) {
    RecordProperty("hazard", "H2");
    auto plain = prepare(studies_.path() / "plain", std::nullopt);
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_TRUE((*plain)->start({}));
    const auto undisturbed = (*plain)->finish();
    EXPECT_FALSE(undisturbed.markers);
    plain->reset();

    const MarkerAddress at{"127.0.0.1", freePort()};
    auto run = prepare(studies_.path() / "marked", at);
    ASSERT_TRUE(run) << run.error().message;
    const MarkerRecorder hangs(at.port, MarkerRecorder::Reads::Nothing);
    auto goes = std::make_unique<MarkerRecorder>(at.port);
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while ((!hangs.connected() || goes->lines().empty()) && std::chrono::steady_clock::now() < until)
        std::this_thread::yield();
    ASSERT_TRUE((*run)->start({}));
    while (goes->lines().size() < 100 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    goes.reset();
    const auto disturbed = (*run)->finish();
    EXPECT_EQ(answersOf(disturbed), answersOf(undisturbed));
    ASSERT_TRUE(disturbed.markers);
    EXPECT_EQ(disturbed.markers->recorders, 2U);
    run->reset();

    auto alone = prepare(studies_.path() / "alone", at);
    ASSERT_TRUE(alone) << alone.error().message;
    ASSERT_TRUE((*alone)->start({}));
    const auto unheard = (*alone)->finish();
    EXPECT_EQ(answersOf(unheard), answersOf(undisturbed));
    ASSERT_TRUE(unheard.markers);
    EXPECT_EQ(unheard.markers->unheard, unheard.markers->made);
    EXPECT_THAT(markersSentence(*unheard.markers), HasSubstr("no recorder was connected"));
}

TEST_F(MarkerSession, WhereThePortIsTakenNothingIsBegun) {
    const HeldPort held;
    const auto folder = studies_.path() / "study";
    const auto refused = prepare(folder, MarkerAddress{"127.0.0.1", held.port()});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Io);
    EXPECT_FALSE(std::filesystem::exists(folder));
}

}  // namespace
}  // namespace tacto::test
