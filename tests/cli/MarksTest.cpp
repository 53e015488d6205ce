// The marks next to every result that depends on roughness R: in --json, on the terminal and in the report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/dsp/RoughnessFlags.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

const std::string kLinen = (sourceDir() / "resources/examples/linen-slide").string();

std::string reportOf(const Json& run) {
    auto path = std::filesystem::path(run["report"].get<std::string>());
    return contentOf(path.replace_extension(".html").string());
}

TEST(Marks, ALiveRunOfARecordingCarriesEveryFlagOfIt) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    const auto flags = jsonOf(desk.run({"roughness", kLinen, "--json"}))["flags"];
    ASSERT_EQ(flags.size(), 7U) << flags.dump();
    const Words live{"run", "live", "--device", "recording:" + kLinen, "--device", "sim:", "--out", desk.at("out")};
    auto words = live;
    words.emplace_back("--json");
    const auto ran = desk.run(words);
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_THAT(value["marks"], IsSupersetOf(flags.get<std::vector<Json>>())) << value["marks"].dump();
    EXPECT_THAT(value["marks"], Contains(Json("The stimulator is not calibrated.")));
    EXPECT_THAT(value["marks"], Contains(testing::Truly([](const Json& mark) {
                    return mark.get<std::string>().starts_with("Known limit of R");
                })));
    const auto report = reportOf(value);
    const auto text = desk.run(live).out;
    for (const auto& flag : flags) {
        const auto sentence = flagSentence(flag.get<std::string>());
        EXPECT_NE(sentence, flag.get<std::string>());
        EXPECT_THAT(report, HasSubstr(sentence));
        EXPECT_THAT(text, HasSubstr(sentence));
    }
    EXPECT_THAT(report, HasSubstr("do not by themselves rank felt roughness"));
    EXPECT_THAT(text, HasSubstr("do not by themselves rank felt roughness"));
}

TEST(Marks, AnEncodingWithoutReferenceSurfacesIsUncalibratedROneThatMeasuredThemIsNot) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    const auto live =
        jsonOf(desk.run({"run", "live", "--device", "sim:", "--set", "duration=2", "--out", desk.at("a"), "--json"}));
    EXPECT_THAT(live["marks"], Contains(Json("uncalibrated R")));
    const auto measured = jsonOf(
        desk.run({"run", "separability", "--device", "sim:", "--set", "repeats=2", "--out", desk.at("b"), "--json"}));
    EXPECT_THAT(measured["marks"], Not(Contains(Json("uncalibrated R")))) << measured["marks"].dump();
    EXPECT_THAT(measured["marks"], Contains(Json("The uncertainty of R is not known."))) << "one slide each";
    const auto text = desk.run({"roughness", kLinen}).out;
    EXPECT_THAT(text, HasSubstr("R is not calibrated: no reference surface"));
    EXPECT_THAT(text, HasSubstr("Known limit of R"));
}

TEST(Marks, AProfileIsOfTheFingertipThatItWasMadeWith) {
    RecordProperty("hazard", "H7");
    const Desk desk;
    const auto made =
        jsonOf(desk.run({"run", "sensor-calibration", "--device", "sim:", "--set", "more=", "--set", "slides=3",
                         "--set", "duration_s=2", "--set", "weights_g=50; 200", "--out", desk.at("made"), "--json"}));
    ASSERT_EQ(made["verdict"], "pass") << made.dump();
    EXPECT_THAT(made["marks"], Not(Contains(Json("uncalibrated R")))) << "its slides were there to measure it";
    const auto profile = desk.write("profile.json", made["results"]["profile"]["profile"].dump());
    const auto live = [&](const char* seed) {
        return desk.run({"run", "live", "--device", "sim:", "--set", "duration=2", "--profile", profile, "--seed", seed,
                         "--out", desk.at("out"), "--json"});
    };
    const auto same = live("1"), another = live("2");
    EXPECT_THAT(jsonOf(same)["marks"], Not(Contains(Json("uncalibrated R"))));
    EXPECT_THAT(jsonOf(same)["marks"].dump(), HasSubstr("U of R (95 %, one slide): "));
    EXPECT_EQ(same.err, "");
    EXPECT_THAT(jsonOf(another)["marks"],
                IsSupersetOf({Json("uncalibrated R"), Json("calibrated on another fingertip")}));
    EXPECT_THAT(another.err, HasSubstr("was made with the fingertip SIM-1, and this one is SIM-2"));
    EXPECT_THAT(reportOf(jsonOf(another)), HasSubstr("was made with the fingertip SIM-1"));
}

}  // namespace
}  // namespace tacto::test
