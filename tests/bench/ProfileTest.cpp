#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Csv.h"
#include "core/bench/Profile.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

TEST(Profile, TheShippedFileIsTheProgramsDefault) {
    const auto shipped = loadProfile(test::sourceDir() / "resources" / "encodings" / "default.json");
    ASSERT_TRUE(shipped) << shipped.error().message;
    EXPECT_EQ(toJson(*shipped).dump(1), toJson(Profile{}).dump(1));
}

TEST(Profile, ReadsBackWhatItWrites) {
    Profile profile;
    profile.name = "left index finger";
    profile.electrodeArea = SquareCentimetres(3);
    profile.ceilings.push_back({Quantity::PeakCurrent, 20});
    profile.encoding.amplitudeMax = Volts(30);
    const auto again = parseProfile(toJson(profile).dump(), "test");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(toJson(*again), toJson(profile));
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

}  // namespace
}  // namespace tacto
