#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "core/bench/Profile.h"
#include "core/bench/arming/CommandPreview.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using test::accepted;
using test::refusedSaying;

TEST(Profile, TheShippedFileIsTheProgramsDefault) {
    const auto shipped = accepted(loadProfile(test::sourceDir() / "resources" / "encodings" / "default.json"));
    Profile expected;
    expected.encoding.amplitudeRatioPerTrain = 1.2;
    expected.encoding.intervalRatioPerTrain = 1.34;
    EXPECT_EQ(toJson(shipped).dump(1), toJson(expected).dump(1));
}

TEST(Profile, AFileThatNamesNoLimitOnAStepHasNone) {
    EXPECT_FALSE(parseProfile("{\"encoding\": {\"amplitude_max_v\": 30}}", "test")->encoding.movesInSteps());
}

TEST(Profile, ReadsBackWhatItWrites) {
    Profile profile;
    profile.name = "left index finger";
    profile.electrodeArea = SquareCentimetres(3);
    profile.ceilings.push_back({Quantity::PeakCurrent, 20});
    profile.encoding.amplitudeMax = Volts(30);
    const auto again = accepted(parseProfile(toJson(profile).dump(), "test"));
    EXPECT_EQ(toJson(again), toJson(profile));
    EXPECT_FALSE(toJson(profile).contains("electrode")) << "nothing is said of it";
    profile.electrode = {"TENS 40", "Ag/AgCl", "hydrogel"};
    EXPECT_EQ(accepted(parseProfile(toJson(profile).dump(), "test")).electrode, profile.electrode);
    EXPECT_EQ(toJson(profile)["electrode"]["medium"], "hydrogel");
}

TEST(Profile, RefusesWhatItDoesNotKnowByName) {
    const std::pair<const char*, const char*> cases[] = {
        {"{\"encodings\": {}}", "encodings"},
        {"{\"safety\": {\"area\": 3}}", "area"},
        {"{\"safety\": {\"electrode_area_cm2\": -1}}", "electrode_area_cm2"},
        {"{\"safety\": {\"ceilings\": {\"amps\": 1}}}", "amps"},
        {"{\"safety\": {\"load_low_ohm\": 20000}}", "load_low_ohm"},
        {"{\"encoding\": {\"amplitude_max_v\": \"40\"}}", "amplitude_max_v"},
        {"not json", "JSON"},
        {"[]", "object"},
    };
    for (const auto& [text, named] : cases) {
        const auto parsed = parseProfile(text, "lab.json");
        ASSERT_FALSE(parsed) << text;
        EXPECT_NE(parsed.error().message.find(named), std::string::npos) << parsed.error().message;
        EXPECT_TRUE(parsed.error().message.find("lab.json") == 0 ||
                    parsed.error().message.find("safety") != std::string::npos)
            << parsed.error().message;
    }
}

TEST(ProfileReach, AProfileThatTheDeviceCannotReachIsNamedWithTheDeviceAndItsMost) {
    RecordProperty("hazard", "H12");
    Profile profile;
    profile.name = "fingertip";
    SourceTraits pulsePal;  // ± 10 V
    pulsePal.drive = Drive::Voltage;
    pulsePal.amplitudeMax = 10;
    pulsePal.compliance = Volts(10);
    const auto beyond = beyondReach(profile, pulsePal, "Pulse Pal 2");
    ASSERT_TRUE(beyond);
    for (const auto* part : {"\"fingertip\"", "10 to 40 V", "Pulse Pal 2", "10 V at most", "trains above that",
                             "amplitude_max_v is 10 or less"}) {
        EXPECT_NE(beyond->find(part), std::string::npos) << part << ": " << *beyond;
    }
    profile.encoding.amplitudeMin = Volts(20);
    EXPECT_NE(beyondReach(profile, pulsePal, "Pulse Pal 2")->find("all its trains"), std::string::npos);
    profile.encoding.amplitudeMin = Volts(5);
    profile.encoding.amplitudeMax = Volts(10);
    EXPECT_FALSE(beyondReach(profile, pulsePal, "Pulse Pal 2"));
}

TEST(ProfileReach, ACurrentSourceIsJudgedByItsComplianceAndAtTheHighestLoad) {
    Profile profile;  // 10 to 40 V into 500 Ω to 10 kΩ
    SourceTraits p24;
    p24.drive = Drive::Current;
    p24.amplitudeMax = 130;
    p24.compliance = Volts(150);
    EXPECT_FALSE(beyondReach(profile, p24, "P24"));
    p24.compliance = Volts(30);
    EXPECT_NE(beyondReach(profile, p24, "P24").value_or("").find("30 V at most"), std::string::npos);
    p24.compliance = Volts(150);
    p24.amplitudeMax = 2;
    EXPECT_NE(beyondReach(profile, p24, "P24").value_or("").find("20 V at most (2 mA into 10000 Ω"), std::string::npos);
}

TEST(Profile, WithAKeyThatStandsTwiceIsRefusedAndKeepsNoCeilingOfEither) {
    RecordProperty("hazard", "H1");
    EXPECT_THAT(
        parseProfile(R"({"safety": {"ceilings": {"peak_current": 20}, "electrode_area_cm2": 3, "ceilings": {}}})",
                     "lab.json"),
        refusedSaying(testing::Eq("lab.json: the key \"ceilings\" of one object is given twice; once is expected")));
}

TEST(Profile, ThatNestsWithoutEndIsRefusedUnderEveryKey) {
    RecordProperty("hazard", "H10");
    const std::string deep = std::string(400'000, '[') + std::string(400'000, ']');
    for (const char* key : {"name", "roughness", "encoding", "safety"}) {
        const auto parsed = parseProfile(fmt::format("{{\"{}\": {}}}", key, deep), "lab.json");
        ASSERT_FALSE(parsed) << key;
        EXPECT_EQ(parsed.error().message, "lab.json: it nests deeper than 32 levels") << key;
    }
}

}  // namespace
}  // namespace tacto
