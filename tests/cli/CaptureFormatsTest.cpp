// measure and convert with files of other instruments, and with options that correct such files.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Result.h"
#include "tests/cli/Shape.h"
#include "tests/support/TakenAdvice.h"

namespace tacto::test {
namespace {

using ::testing::HasSubstr;

/// Returns a Rigol file: 0 and 5 V alternating, 50 samples each at 100 kS/s.
std::string rigol() {
    std::string text = "X,CH1,CH2,Start,Increment,\r\nSequence,Volt,Volt,-1.0e-03,1.0e-05,\r\n";
    for (int i = 0; i < 1000; ++i)
        text += fmt::format("{},{:.2e},{:.2e},\r\n", i, i / 50 % 2 * 5.0, i / 50 % 2 * 50e-3);
    return text;
}

TEST(CaptureFormatsCommands, MeasureSaysWhichFormatItTookTheFileFor) {
    const Desk desk;
    const auto path = desk.write("scope.csv", rigol());
    const auto json = jsonOf(desk.run({"measure", path, "--json"}));
    EXPECT_EQ(json["format"], "csv-rigol");
    EXPECT_EQ(json["channels"].size(), 2U);
    EXPECT_NEAR(json["channels"][0]["rate_hz"].get<double>(), 1e5, 1e-6);
    EXPECT_NEAR(json["channels"][0]["interval_s"]["mean"].get<double>(), 1e-3, 1e-8);
    EXPECT_THAT(desk.run({"measure", path}).out, HasSubstr("Rigol CSV"));
    const auto refused = desk.run({"measure", path, "--format", "isf"});
    EXPECT_EQ(refused.code, 3) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("CURVE"));
}

TEST(CaptureFormatsCommands, MeasureTakesTheUsersWordOverTheFiles) {
    const Desk desk;
    const auto path = desk.write("scope.csv", rigol());
    const auto ran = desk.run({"measure", path, "--columns", "CH2", "--unit", "CH2=mA", "--probe", "CH2=100",
                               "--sample-rate", "200000", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto json = jsonOf(ran);
    ASSERT_EQ(json["channels"].size(), 1U);
    EXPECT_EQ(json["channels"][0]["unit"], "A");
    EXPECT_NEAR(json["channels"][0]["amplitude"]["mean"].get<double>(), 50e-3 * 1e-3 * 100, 1e-9);
    EXPECT_NEAR(json["channels"][0]["interval_s"]["mean"].get<double>(), 0.5e-3, 1e-8);

    const auto titled = desk.write("titled.csv", "a title\nanother\nwhen;what\n0;1\n1;2\n2;3\n");
    EXPECT_EQ(desk.run({"measure", titled, "--skip-rows", "2", "--time-column", "when"}).code, 0);
}

// The options are taken from the printed refusal, exactly as written there.
TEST(CaptureFormatsCommands, TheOptionsThatARefusalNamesReadTheFile) {
    const Desk desk;
    std::string rows;
    for (int i = 0; i < 400; ++i) rows += fmt::format("{};{};{}\n", 0.5 * i, i / 50 % 2 * 5, i % 7);
    const std::pair<std::string, std::string> files[] = {
        {"when;what;more\n" + rows, "--time-column 1"},       {rows, "--time-column 1"},
        {"t/s;F/V;n\n" + rows + "200;x;1\n", "--columns 3"},  {"t/s;a;a\n" + rows, "--columns 2,3"},
        {"1;2\nt/s;a;b\n" + rows, "--skip-rows 1"},           {"t/s;p/bar;m/kg\n" + rows, "--unit 2=V"},
        {"t/s;a;b\n" + rows + "500;1;1\n", "--sample-rate 2"}};
    for (const auto& [text, advice] : files) {
        const auto path = desk.write("a.csv", text);
        const auto refused = desk.run({"measure", path});
        EXPECT_EQ(refused.code, 3) << refused.out;
        EXPECT_THAT(refused.err, HasSubstr(advice));
        std::vector<std::string> words{"measure", path};
        for (const auto& word : advisedWords(refused.err)) words.push_back(word);
        const auto read = desk.run(words);
        EXPECT_EQ(read.code, 0) << read.err;
    }
}

TEST(CaptureFormatsCommands, ClippingIsWhatTheStatedRangeSays) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    const auto path = desk.write("scope.csv", rigol());
    const auto clippedOf = [](const nlohmann::json& json) {
        return json["channels"][0]["flagged"]["clipped"].get<int>();
    };
    const auto unstated = jsonOf(desk.run({"measure", path, "--json"}));
    EXPECT_EQ(clippedOf(unstated), 0) << "the highest value of a record is not a range";
    EXPECT_GT(unstated["channels"][0]["pulses"].get<int>(), 5);
    const auto at = jsonOf(desk.run({"measure", path, "--range", "CH1=-5:5", "--json"}));
    EXPECT_GT(clippedOf(at), 5);
    EXPECT_EQ(at["channels"][0]["pulses"], 0);
    const auto within = jsonOf(desk.run({"measure", path, "--range", "CH1=-10:10", "--json"}));
    EXPECT_EQ(clippedOf(within), 0);
    EXPECT_EQ(desk.run({"measure", path, "--range", "CH1=5:-5"}).code, 3);

    // Clipped: 7 V at an input that ends at 5.08 V, in steps of 40 mV with noise of one step.
    std::string text = "X,CH1,Start,Increment,\nSequence,Volt,0,1.0e-05,\n";
    std::uint32_t state = 1;
    for (int i = 0; i < 2000; ++i) {
        double noise = -2;
        for (int k = 0; k < 4; ++k) {
            state = state * 1664525U + 1013904223U;
            noise += static_cast<double>(state >> 8U) / (1U << 24U);
        }
        const double volts = i / 50 % 2 * 7 + 0.07 * noise;
        text += fmt::format("{},{:.2f},\n", i, std::min(127.0, std::round(volts / 0.04)) * 0.04);
    }
    const auto clipped = desk.write("clipped.csv", text);
    const auto json = jsonOf(desk.run({"measure", clipped, "--json"}));
    EXPECT_EQ(clippedOf(json), 0);
    EXPECT_EQ(json["channels"][0]["flagged"]["flat_top"], json["channels"][0]["pulses"]);
    EXPECT_THAT(json["warnings"].dump(), HasSubstr("it may be clipped"));
    EXPECT_GT(clippedOf(jsonOf(desk.run({"measure", clipped, "--range", "CH1=-5.12:5.08", "--json"}))), 10);
}

TEST(CaptureFormatsCommands, WrongOptionsAreAMatterOfUsage) {
    const Desk desk;
    const auto path = desk.write("scope.csv", rigol());
    for (const Words& words :
         {Words{"--unit", "CH1"}, Words{"--unit", "=V"}, Words{"--probe", "CH1=ten"}, Words{"--skip-rows", "-1"},
          Words{"--skip-rows", "1.5"}, Words{"--columns", "1,,2"}, Words{"--range", "CH1=5"},
          Words{"--range", "CH1=0:x"}, Words{"--range", "0:1"}, Words{"--sample-rate", "0"},
          Words{"--sample-rate", "nan"}, Words{"--unit", "CH1=V", "--unit", "CH1=mV"},
          Words{"--probe", "CH1=1", "--probe", "CH1=10"}, Words{"--range", "CH1=0:1", "--range", "CH1=0:2"}}) {
        Words all{"measure", path};
        all.insert(all.end(), words.begin(), words.end());
        const auto ran = desk.run(all);
        EXPECT_EQ(ran.code, 2) << words[0] << " " << words[1];
        EXPECT_THAT(ran.err, HasSubstr(words[0])) << words[1];
        EXPECT_EQ(ran.out, "");
    }
    const auto none = desk.run({"measure", path, "--columns", "CH7"});
    EXPECT_EQ(none.code, 3);
    EXPECT_THAT(none.err, HasSubstr("no channel 'CH7'"));
}

TEST(CaptureFormatsCommands, ConvertKeepsEveryValue) {
    // libsigrok 0.5.2 leaks memory for each .sr file; the leak checker needs whole stacks to distinguish that from
    // leaks of ours (tests/lsan.supp).
    const char* options = std::getenv("ASAN_OPTIONS");
    setenv("ASAN_OPTIONS", ((options != nullptr ? options + std::string(":") : "") + "fast_unwind_on_malloc=0").c_str(),
           1);
    const Desk desk;
    const auto path = desk.write("scope.csv", rigol());
    for (const auto* name : {"out.csv", "out.wav", "out.sr"}) {
        const auto ran = desk.run({"convert", path, "--out", desk.at(name), "--json"});
        ASSERT_EQ(ran.code, 0) << ran.err;
        const auto json = jsonOf(ran);
        EXPECT_EQ(json["format"], "csv-rigol");
        EXPECT_EQ(json["samples"], 1000);
        EXPECT_EQ(json["channels"], 2);
        const auto before = jsonOf(desk.run({"measure", path, "--json"}));
        const auto after = jsonOf(desk.run({"measure", desk.at(name), "--json"}));
        for (const auto* value : {"amplitude", "width_s", "interval_s"}) {
            EXPECT_NEAR(after["channels"][1][value]["mean"].get<double>(),
                        before["channels"][1][value]["mean"].get<double>(), 1e-9)
                << name << " " << value;
        }
        EXPECT_EQ(after["channels"][1]["unit"], "V");
        EXPECT_EQ(after["warnings"], before["warnings"]) << "the file itself is nothing to warn of";
    }
    EXPECT_THAT(contentOf(desk.at("out.csv")), ::testing::StartsWith("time_s,CH1_v,CH2_v\n-0.001"));
}

TEST(CaptureFormatsCommands, ConvertNeverWritesOverWhatItReads) {
    const Desk desk;
    const auto path = desk.write("scope.csv", rigol());
    std::filesystem::create_symlink(path, desk.at("link.csv"));
    for (const auto& out : {path, desk.at("./scope.csv"), desk.at("link.csv")}) {
        const auto ran = desk.run({"convert", path, "--out", out});
        EXPECT_EQ(ran.code, 2) << out;
        EXPECT_THAT(ran.err, HasSubstr("the file that is read"));
    }
    EXPECT_EQ(contentOf(path), rigol());
    EXPECT_EQ(desk.run({"convert", path}).code, 2);
    const auto unknown = desk.run({"convert", path, "--out", desk.at("out.isf")});
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr(".csv"));
    EXPECT_EQ(desk.run({"convert", desk.at("none.csv"), "--out", desk.at("out.csv")}).code, 3);
    EXPECT_FALSE(std::filesystem::exists(desk.at("out.csv")));
}

}  // namespace
}  // namespace tacto::test
