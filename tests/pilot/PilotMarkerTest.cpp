// Markers that a recorder gets from a session: for rows on disk, with the rows' times, and without anything that
// depends on a stimulus or an answer.
#include <map>

#include "core/base/Random.h"
#include "tests/pilot/StageFixture.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

class PilotMarkers : public PilotStageTest {
protected:
    struct Told {
        Instant at;
        std::string name;
    };
    void SetUp() override {
        PilotStageTest::SetUp();
        tell();
    }
    void tell() {
        record_->onMarker = [this](const PilotMarker& marker) {
            const auto all = rows();
            ASSERT_FALSE(all.empty());
            bool isThere = false;  // the bench also writes rows
            for (const auto& row : all) isThere = isThere || (row.name == marker.name && row.at == marker.at);
            EXPECT_TRUE(isThere) << marker.name << " is told before its row is on disk";
            told.push_back({marker.at, std::string(marker.name)});
        };
    }
    std::vector<std::string> namesOf(const StageTrial& trial) {
        told.clear();
        EXPECT_TRUE(stage_->trial(trial));
        std::vector<std::string> names;
        for (const auto& each : told) names.push_back(each.name);
        return names;
    }
    std::vector<Told> told;
};

TEST_F(PilotMarkers, EachIsARowOnDiskWithItsTime) {
    RecordProperty("hazard", "H8");
    EXPECT_THAT(namesOf(trial()), ElementsAre("trial-begin", "presentation", "answer"));
    std::vector<std::string> marked;
    std::vector<Instant> times;
    for (const auto& row : rows()) {
        if (!hasMarker(row.name)) continue;
        marked.push_back(row.name);
        times.push_back(row.at);
    }
    ASSERT_THAT(marked, ElementsAre("trial-begin", "presentation", "answer"));
    for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(times[i], told[i].at) << told[i].name;
}

TEST_F(PilotMarkers, APresentationStatesWhenItsFirstTrainWasTriggered) {
    ASSERT_THAT(namesOf(trial()), ElementsAre("trial-begin", "presentation", "answer"));
    const auto* answer = record_->find(row::kAnswer, "test 1");
    ASSERT_NE(answer, nullptr);
    const double onset_s = (*answer)["delivered"][0]["onset_s"];
    EXPECT_NEAR(toSeconds(told[1].at), onset_s, 0.005) << "the loop's period";
    EXPECT_GT(told[1].at, told[0].at);
}

TEST_F(PilotMarkers, AreTheSameWhateverIsPresentedAndAnswered) {
    RecordProperty("hazard", "H9");
    auto other = trial("test 2", 1);
    other.about["condition"] = "smooth-low";
    other.presentation = testPresentation(Milliamps(1), Seconds(2));
    auto empty = trial("test 3", 0);
    empty.about["condition"] = "catch";
    empty.presentation = testPresentation(Milliamps(0), Seconds(0.5));
    auto dense = trial("test 4", 0.5);
    dense.presentation = testPresentation(Milliamps(0.5), Seconds(0.5));
    const auto first = namesOf(trial());
    EXPECT_EQ(namesOf(other), first);
    EXPECT_EQ(namesOf(empty), first);
    EXPECT_EQ(namesOf(dense), first);
    someone_.answers["identification"] = "rough-low";
    other.name = "test 5";
    other.prompt = conditionPrompt({"rough-high", "rough-low", "smooth-high", "smooth-low"});
    EXPECT_EQ(namesOf(other), first);
}

TEST_F(PilotMarkers, SayNothingOfTheIntervalThatHoldsTheTrain) {
    RecordProperty("hazard", "H9");
    std::vector<Instant> lengths;
    for (const bool inSecond : {false, true}) {
        auto detection = trial(inSecond ? "detection 2" : "detection 1");
        detection.presentation = detectionPresentation(Milliamps(0.5), inSecond, Seconds(0.01), Seconds(0.5));
        detection.screen.state = ScreenState::Interval;
        detection.prompt = intervalPrompt();
        ASSERT_THAT(namesOf(detection), ElementsAre("trial-begin", "presentation", "answer"));
        lengths.push_back(told[2].at - told[1].at);
    }
    EXPECT_NEAR(toSeconds(lengths[0]), toSeconds(lengths[1]), 0.006)
        << "the time follows the presentation's beginning, not the train";
}

TEST_F(PilotMarkers, TargetsComeTheSameTimeAfterAnyPresentation) {
    RecordProperty("hazard", "H9");
    Random random(20, "times of trials");
    std::map<std::string, std::pair<double, double>> times;  // shortest and longest time for each kind of trial
    Instant began{0}, targets{0};
    record_->onMarker = [&](const PilotMarker& marker) {
        if (marker.name == row::kPresentation) began = marker.at;
    };
    someone_.onAsk = [&](const PilotPrompt& prompt) { targets = prompt.targetsAt; };
    for (int i = 0; i < trials<int>({.local = 200, .ci = 200, .campaign = 2000}); ++i) {
        const double level = 0.5 * double(random.below(3));
        auto made = trial(fmt::format("test {}", i + 1), level);
        const bool detects = level > 0 && random.below(3) == 0;
        made.presentation =
            detects ? detectionPresentation(Milliamps(level), random.below(2) == 1, Seconds(0.01), Seconds(0.5))
                    : testPresentation(Milliamps(level), Seconds(random.below(2) == 1 ? 0.5 : 2));
        ASSERT_TRUE(stage_->trial(made));
        const double after = toSeconds(targets - began);
        auto& [least, most] = times.try_emplace(detects ? "detection" : "test", after, after).first->second;
        least = std::min(least, after);
        most = std::max(most, after);
    }
    ASSERT_EQ(times.size(), 2U);
    for (const auto& [kind, each] : times) EXPECT_LE(each.second - each.first, 0.006) << kind << ": the loop's period";
}

TEST_F(PilotMarkers, TellOfAStopAndNothingOfAPersonsState) {
    RecordProperty("hazard", "H11");
    for (const char* kind : {row::kGate, row::kSkin, row::kSideEffect, row::kAdverseEvent, row::kNote, row::kEstimate,
                             row::kRange, row::kDrift, "level-accepted", "level-too-strong", ""})
        EXPECT_FALSE(hasMarker(kind)) << kind;
    someone_.stops = 1;
    const auto names = namesOf(trial());
    EXPECT_THAT(names, ElementsAre("trial-begin", "presentation", "participant-stop", "continue", "trial-begin",
                                   "presentation", "answer"));
}

TEST_F(PilotMarkers, WithoutARecorderNoRowIsAdded) {
    record_->onMarker = {};
    ASSERT_TRUE(stage_->trial(trial()));
    EXPECT_EQ(record_->count(row::kPresentation), 0U);
}

}  // namespace
}  // namespace tacto::test
