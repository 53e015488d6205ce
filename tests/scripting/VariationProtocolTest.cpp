// The protocol that predicts a pilot: without a device, with the same result for the same seed, and stopped half-way.
#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>

#include "core/kinds/ResultKinds.h"
#include "core/session/SessionReader.h"
#include "tests/scripting/RunBench.h"
#include "tests/support/InTime.h"

namespace tacto {
namespace {

using test::RunBench;

ScriptOutcome runVariation(RunBench& rig, const std::map<std::string, std::string>& settings) {
    return runProtocol(rig.shipped("variation", settings)).value();
}

const std::map<std::string, std::string> kSmall = {{"participants", "40"}, {"trials", "5"}};

TEST(VariationProtocol, PredictsWithoutADevice) {
    RunBench rig(true, "sim:", 1, true, {});
    std::size_t last = 0, total = 0;
    auto request = rig.shipped("variation", kSmall);
    request.onProgress = [&](const ScriptProgress& progress) {
        last = progress.done;
        total = progress.total;
    };
    const auto outcome = runProtocol(std::move(request)).value();
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::None);
    const auto& found = outcome.results;
    EXPECT_EQ(found["simulated"], true);
    EXPECT_EQ(found["measured"], false);
    EXPECT_EQ(found["participants"], 40);
    EXPECT_EQ(found["seed"], 1);
    EXPECT_EQ(found["separability"].size(), 6U);
    for (const auto& pair : found["separability"]) {
        EXPECT_GT(pair["jnd"]["value"].get<double>(), 0);
        EXPECT_LE(pair["jnd"]["low"], pair["jnd"]["value"]);
        EXPECT_LE(pair["jnd"]["value"], pair["jnd"]["high"]);
    }
    EXPECT_EQ(found["confusion"].size(), 4U);
    std::size_t answers = 0;
    for (const auto& row : found["confusion"]) {
        EXPECT_EQ(row.size(), 5U);
        for (const auto& cell : row) answers += cell.get<std::size_t>();
    }
    EXPECT_EQ(answers, found["served"].get<std::size_t>() * 4 * 5);
    EXPECT_GT(found["served"].get<int>(), 0);
    // The number of participants served comes first, in the results and in the session.
    ASSERT_GE(found["reasons"].size(), 2U);
    EXPECT_TRUE(found["headline"].get<std::string>().starts_with("The design paper's 10 to 40 V serves "));
    EXPECT_EQ(found["reasons"][0], outcome.reasons.at(0));
    EXPECT_EQ(found["readings"].size(), 3U);
    EXPECT_EQ(found["pilots"].back()["people"], 5);
    EXPECT_EQ(found["people"]["detection_ma"].size(), 40U);
    EXPECT_LT(found["attention_ma"]["value"], found["intolerance_ma"]["value"]);
    EXPECT_GT(found["accuracy"]["median"].get<double>(), 0.25);
    EXPECT_TRUE(found["trials_needed"]["per_participant"]["for_width"].is_number());
    EXPECT_EQ(found["bench"]["conditions"].size(), 4U);
    EXPECT_EQ(last, 40U);
    EXPECT_EQ(total, 40U);

    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    std::size_t figures = 0;
    const auto items = reader.reportItems().value();
    for (const auto& item : items) {
        const auto kind = item.body.value("kind", "");
        figures += kind == "figure" ? 1 : 0;
        if (kind != "figure") continue;
        EXPECT_NE(item.body.value("caption", "").find("predicted, not measured"), std::string::npos)
            << item.body.value("caption", "");
    }
    EXPECT_EQ(figures, 4U);
    for (const auto& table : resultTraits("variation").tables) {
        if (table.shape != ResultTable::Shape::Rows || table.title == "Premises") continue;  // assumptions
        EXPECT_TRUE(table.title.ends_with("predicted, not measured")) << table.title;
    }
    const auto verdicts = reader.verdicts().value();
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_EQ(verdicts[0].verdict, "none");
    EXPECT_EQ(verdicts[0].reasons, outcome.reasons);
}

TEST(VariationProtocol, SameSeedSameResults) {
    const auto resultsOf = [](std::uint64_t seed) {
        RunBench rig(true, "sim:", seed, false, {});
        return runVariation(rig, kSmall).results;
    };
    const auto first = resultsOf(5);
    ASSERT_TRUE(first.is_object());
    EXPECT_EQ(first, resultsOf(5));
    EXPECT_NE(first["accuracies"], resultsOf(6)["accuracies"]);
}

TEST(VariationProtocol, ThePapersFixedAmplitudesAreComparedWithPersonalOnes) {
    RunBench rig(true, "sim:", 2, false, {});
    auto settings = kSmall;
    settings["levels"] = "profile";
    const auto outcome = runVariation(rig, settings);
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.results["levels"], "profile");
    EXPECT_EQ(outcome.results["other_levels"]["levels"], "personal");
    // 10 to 40 V is a factor of 4, as is the range between the thresholds, so few people can bear all of it.
    EXPECT_GT(outcome.results["refused"].get<int>() + outcome.results["not_felt"].get<int>(), 0);
    EXPECT_LT(outcome.results["complete"], outcome.results["other_levels"]["complete"]);
    EXPECT_LE(outcome.results["served"], 2);
    EXPECT_EQ(outcome.results["profile_served"], outcome.results["served"]);
    EXPECT_EQ(outcome.results["personal_served"], outcome.results["other_levels"]["served"]);
    EXPECT_GT(outcome.results["other_levels"]["served"], 30);
}

TEST(VariationProtocol, NoParticipantWhoBearsTheAmplitudesIsAResultToo) {
    RunBench rig(true, "sim:", 1, true, {});
    const auto outcome =
        runVariation(rig, {{"participants", "10"}, {"levels", "profile"}, {"detection", "0.1"}, {"discomfort", "0.2"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.results["complete"], 0);
    EXPECT_EQ(outcome.results["refused"], 40);
    EXPECT_TRUE(outcome.results["trials_needed"].is_null());
    EXPECT_TRUE(outcome.results["accuracy"]["median"].is_null());
}

TEST(VariationProtocol, AStopEndsItAtOnceAndKeepsWhatIsDone) {
    RunBench rig(false, "sim:", 1, true, {});
    auto request = rig.shipped("variation", {{"participants", "20000"}, {"trials", "1000"}});
    std::atomic<bool> begun{false};
    request.onProgress = [&](const ScriptProgress& progress) {
        if (progress.done < 3) return;
        begun = true;
        begun.notify_all();
    };
    auto run = ScriptRun::start(std::move(request)).value();
    begun.wait(false);
    const auto asked = std::chrono::steady_clock::now();
    run->stop("the test");
    const auto outcome = run->wait();
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - asked < std::chrono::seconds(2));
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.error->code, ErrorCode::Stopped) << outcome.error->message;
    ASSERT_TRUE(outcome.results.is_object()) << "what was predicted until then is kept";
    EXPECT_EQ(outcome.results["partial"], true);
    EXPECT_GE(outcome.results["participants"].get<int>(), 3);
    EXPECT_LT(outcome.results["participants"].get<int>(), 20000);
}

TEST(VariationProtocol, WrongOptionsAreRefusedByName) {
    RunBench rig(true, "sim:", 1, false, {});
    const struct {
        const char* call;
        const char* names;
    } wrong[] = {{"analysis.variation({ participants: 0 })", "participants"},
                 {"analysis.variation({ levels: \"mine\" })", "mine"},
                 {"analysis.variation({ source: \"water\" })", "water"},
                 {"analysis.variation({ guess: \"maybe\" })", "maybe"},
                 {"analysis.variation({ detection_ma: 5, discomfort_ma: 4 })", "discomfort_ma"},
                 {"analysis.variation({ attention_ma: 3 })", "attention_ma"},
                 {"analysis.variation({ intolerance_ma: 6 })", "intolerance_ma"},
                 {"analysis.variation({ persons: 5 })", "persons"},
                 {"bench.variation.begin({ attention_ma: 3 })", "attention_ma"},
                 {"bench.variation.conclude()", "bench.variation.begin() is expected first"}};
    for (const auto& [call, names] : wrong) {
        const auto outcome = rig.run(test::withRun(call));
        ASSERT_TRUE(outcome.error) << call;
        EXPECT_NE(outcome.error->message.find(names), std::string::npos) << outcome.error->message;
    }
}

}  // namespace
}  // namespace tacto
