// Every shipped script runs on the simulated bench, started as in a laboratory.
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinds/ResultKinds.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "tests/scripting/RunBench.h"

namespace tacto {
namespace {

using test::RunBench;

ProtocolLibrary shipped() { return {test::sourceDir() / "resources" / "protocols", {}}; }

ScriptOutcome runShipped(RunBench& rig, const std::string& name, const std::map<std::string, std::string>& settings) {
    auto source = shipped().find(name).value();
    const auto declaration = readDeclaration(source).value();
    auto request = rig.request(std::move(source));
    request.parameters = applySettings(declaration, settings).value().parameters;
    return runProtocol(std::move(request)).value();
}

std::vector<std::string> shippedNames() {
    std::vector<std::string> names;
    for (const auto& source : shipped().list()) names.push_back(source.name);
    return names;
}

TEST(ShippedProtocols, AreThoseOfTheFolder) {
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(test::sourceDir() / "resources" / "protocols"))
        files.push_back(file.path().stem().string());
    EXPECT_THAT(shippedNames(), testing::UnorderedElementsAreArray(files));
}

/// Scripts for study sessions need a study: tests/cli/PilotTest.cpp runs them.
std::vector<std::string> namesWithoutStudy() {
    auto names = shippedNames();
    std::erase_if(names, [](const std::string& name) { return name.starts_with("pilot-"); });
    return names;
}

TEST(ShippedProtocols, TakeNoSettingThatNothingReads) {
    for (const auto& name : shippedNames()) {  // with a misspelt name, the area would not be checked
        const auto declaration = readDeclaration(shipped().find(name).value()).value();
        EXPECT_FALSE(applySettings(declaration, {{"electrode_area", "5"}})) << name;
    }
}

TEST(ShippedProtocols, OfAStudyAreRefusedWithoutOne) {
    for (const auto* name : {"pilot-thresholds", "pilot-identification"}) {
        RunBench rig;
        const auto outcome = runShipped(rig, name, {});
        ASSERT_TRUE(outcome.error) << name;
        EXPECT_NE(outcome.error->message.find("in a session of a study only"), std::string::npos)
            << outcome.error->message;
        EXPECT_TRUE(rig.outputOff());
    }
}

/// Scripts cannot import anything, so questions that two scripts share are written in both, with the same words.
TEST(ShippedProtocols, OfAStudyAskForTheSameInTheSameWords) {
    const auto parametersOf = [](const char* name) {
        return readDeclaration(shipped().find(name).value()).value().parameters;
    };
    const auto others = parametersOf("pilot-identification");
    std::size_t shared = 0;
    for (const auto& one : parametersOf("pilot-thresholds")) {
        const auto other = std::ranges::find(others, one.name, &ProtocolParameter::name);
        if (other == others.end()) continue;
        ++shared;
        auto same = one;
        if (one.name == "blocks") same.label = other->label;  // the test has blocks, the thresholds script has none
        EXPECT_TRUE(same == *other) << one.name;
    }
    EXPECT_EQ(shared, others.size());
}

/// True if the member exists, null or not.
bool has(const nlohmann::json& record, const std::string& path) {
    const auto dot = path.rfind('.');
    const auto& within = dot == path.npos ? record : memberAt(record, path.substr(0, dot));
    return within.is_object() && within.contains(dot == path.npos ? path : path.substr(dot + 1));
}

/// Returns keys that the analysis or the last step declares and the results lack.
std::vector<std::string> missingMembers(const nlohmann::json& results) {
    const auto kind = results.at("kind").get<std::string>();
    auto declared = resultTraits(kind).members;
    for (const auto& function : hostFunctions())
        if (function.fullName() == "bench." + kind + ".conclude")
            declared.insert(declared.end(), function.members.begin(), function.members.end());
    std::erase_if(declared, [&](const auto& key) { return has(results, key); });
    return declared;
}

/// Returns columns that are empty in every record of a table: keys that no analysis writes.
std::set<std::string> emptyColumns(const nlohmann::json& results) {
    static const std::set<std::string> kWhereAsked{"reason",   "note",       "reason",      "spearman.note",
                                                   "spearman", "spearman.n", "profile.name"};
    std::set<std::string> missing;
    for (const auto& table : resultTraits(results.at("kind").get<std::string>()).tables) {
        const auto& value = table.at.empty() ? results : memberAt(results, table.at);
        nlohmann::json records = rowsOf(table, results);
        if (table.shape == ResultTable::Shape::Facts && value.is_object()) records.push_back(value);
        for (const auto& column : table.columns) {
            const auto minus = column.at.find('-');  // "a-b"
            for (const auto& key : {column.at.substr(0, minus),
                                    minus == std::string::npos ? "" : column.at.substr(minus + 1), column.beside}) {
                if (records.empty() || key.empty() || kWhereAsked.contains(key)) continue;
                if (std::ranges::none_of(records, [&](const auto& record) { return has(record, key); }))
                    missing.insert(table.title + ": " + key);
            }
        }
    }
    return missing;
}

class EveryShippedProtocol : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryShippedProtocol, RunsOnTheSimulatedBench) {
    const auto declared = readDeclaration(shipped().find(GetParam()).value()).value();
    RunBench rig(true, "sim:", 1, true, {declared.needs.begin(), declared.needs.end()});
    std::map<std::string, std::string> settings;
    if (GetParam() == "separability") settings["repeats"] = "2";
    if (GetParam() == "transitions") settings["repeats"] = "1";
    if (GetParam() == "variation") settings = {{"participants", "20"}, {"trials", "5"}};
    if (GetParam() == "encoding-comparison") settings = {{"repeats", "2"}, {"level_repeats", "2"}};
    if (GetParam() == "live" || GetParam() == "massager") settings["duration"] = "5";
    if (GetParam() == "load-safety") settings["steps"] = "2";
    if (GetParam() == "sensor-calibration") settings = {{"more", ""}, {"slides", "3"}};
    const auto outcome = runShipped(rig, GetParam(), settings);
    EXPECT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_TRUE(rig.outputOff());
    rig.closeBench();
    ASSERT_TRUE(rig.writer().close());
    const auto reader = SessionReader::open(rig.folder().path() / "run.tacto").value();
    EXPECT_GE(reader.reportItems().value().size(), 2U);
    EXPECT_EQ(emptyColumns(outcome.results), std::set<std::string>{});
    EXPECT_THAT(missingMembers(outcome.results), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryShippedProtocol, ::testing::ValuesIn(namesWithoutStudy()),
                         [](const auto& tested) {
                             std::string name = tested.param;
                             std::replace(name.begin(), name.end(), '-', '_');  // a test's name must not contain '-'
                             return name;
                         });

TEST(Separability, OfTheSimulatedFingerPasses) {
    RunBench rig;
    const auto outcome = runShipped(rig, "separability", {{"repeats", "20"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Pass) << outcome.results.dump(1);
    EXPECT_TRUE(outcome.log.empty()) << outcome.log.front();
    const auto& conditions = outcome.results["conditions"];
    ASSERT_EQ(conditions.size(), 4U);
    const struct {
        const char* name;
        double amplitude_v, interval_s;
    } expected[] = {{"smooth-low", 10, 2}, {"smooth-high", 10, 0.5}, {"rough-low", 40, 2}, {"rough-high", 40, 0.5}};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(conditions[i]["name"], expected[i].name);
        EXPECT_EQ(conditions[i]["n"], 20);
        EXPECT_NEAR(conditions[i]["amplitude_v"]["mean"].get<double>(), expected[i].amplitude_v,
                    0.05 * expected[i].amplitude_v);
        EXPECT_NEAR(conditions[i]["interval_s"]["mean"].get<double>(), expected[i].interval_s,
                    0.02 * expected[i].interval_s);
    }
    EXPECT_EQ(outcome.results["pairs"].size(), 6U);
    EXPECT_EQ(outcome.results["confusion"].size(), 4U);
    EXPECT_GE(outcome.results["accuracy"]["low"].get<double>(), 0.95);
}

TEST(Separability, DrivenDirectlyIsIndeterminateWithTooFewTrials) {
    RunBench rig;
    const auto outcome = runShipped(rig, "separability", {{"repeats", "5"}, {"source", "direct"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::Indeterminate);
    EXPECT_FALSE(outcome.reasons.empty());
}

TEST(Separability, IntoALoadThatDrawsTooMuchIsRefusedByTheLimits) {
    RecordProperty("hazard", "H1");
    RunBench rig(true, "sim:stimulator?load=100ohm");
    const auto outcome = runShipped(rig, "separability", {{"repeats", "2"}, {"source", "direct"}, {"load", "100"}});
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.error->code, ErrorCode::LimitExceeded) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::None);
}

TEST(Separability, ATrainThatIsRefusedWhileTheFingertipDrivesIsNamed) {
    RecordProperty("hazard", "H1");
    RunBench rig(true, "sim:stimulator?load=50ohm");
    const auto outcome = runShipped(rig, "separability", {{"repeats", "2"}, {"load", "50"}});
    ASSERT_TRUE(outcome.error);
    EXPECT_EQ(outcome.error->code, ErrorCode::LimitExceeded) << outcome.error->message;
    EXPECT_NE(outcome.error->message.find("mA"), std::string::npos) << outcome.error->message;
}

TEST(Separability, SameSeedSameResults) {
    const auto resultsOf = [](std::uint64_t seed) {
        RunBench rig(true, "sim:", seed);
        return runShipped(rig, "separability", {{"repeats", "3"}}).results;
    };
    const auto first = resultsOf(5);
    EXPECT_FALSE(first.is_null());
    EXPECT_EQ(first, resultsOf(5));
    EXPECT_NE(first["trials"], resultsOf(6)["trials"]);
}

TEST(Live, DrivesTheStimulatorAndJudgesNothing) {
    RunBench rig;
    const auto outcome = runShipped(rig, "live", {{"duration", "20"}});
    ASSERT_FALSE(outcome.error) << outcome.error->message;
    EXPECT_EQ(outcome.verdict, ScriptVerdict::None);
    EXPECT_NEAR(outcome.results["duration_s"].get<double>(), 20, 0.01);
    EXPECT_GE(outcome.results["trains_delivered"].get<int>(), 8);
}

}  // namespace
}  // namespace tacto
