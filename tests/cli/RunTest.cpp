// run: separability on the simulated bench, live from real recordings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/base/Result.h"
#include "tests/cli/Shape.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

const Words kRunKeys{"protocol", "verdict", "simulated", "marks", "devices", "seed", "session", "report", "results"};

Words separability(const std::string& out, const std::string& repeats, const std::string& seed = "1") {
    return {"run", "separability", "--device", "sim:",  "--set", "repeats=" + repeats, "--out",
            out,   "--seed",       seed,       "--json"};
}

double firstTime(const std::string& capture) {
    const auto text = contentOf(capture);
    return std::stod(text.substr(text.find("}\n") + 2));  // after the header's comment line
}

TEST(RunSeparability, TheFourConditionsAreToldApartAndEverythingIsWrittenDown) {
    const Desk desk;
    const auto ran = desk.run({"run", "separability", "--device", "sim:", "--out", desk.at("out"), "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    const auto value = jsonOf(ran);
    expectKeys(value, kRunKeys, "run");
    EXPECT_EQ(value["protocol"], "separability");
    EXPECT_EQ(value["verdict"], "pass");
    EXPECT_EQ(value["simulated"], true);
    EXPECT_TRUE(std::filesystem::exists(value["session"].get<std::string>()));
    EXPECT_TRUE(contentOf(value["report"].get<std::string>()).starts_with("%PDF-"));

    const auto& results = value["results"];
    expectSeparability(results);
    constexpr std::array<double, 4> kVolts{10, 10, 40, 40};
    constexpr std::array<double, 4> kSeconds{2, 0.5, 2, 0.5};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& condition = results["conditions"][i];
        EXPECT_EQ(condition["n"], 25);
        EXPECT_NEAR(condition["amplitude_v"]["mean"].get<double>(), kVolts[i], 0.02 * kVolts[i]);
        EXPECT_GT(condition["amplitude_v"]["sd"].get<double>(), 0) << "a bench has noise";
        EXPECT_NEAR(condition["interval_s"]["mean"].get<double>(), kSeconds[i], 0.01 * kSeconds[i]);
    }

    // The captures agree with the trials: two per train, one interval apart.
    const auto captures = desk.named("out/captures", ".csv");
    ASSERT_EQ(captures.size(), 200U);
    EXPECT_TRUE(contentOf(captures[0]).starts_with("time_s,voltage_v,current_a\n"));
    EXPECT_EQ(jsonOf(desk.run({"measure", captures[0], "--json"}))["simulated"], true) << "the twin's capture";
    const auto alone = desk.write("alone.csv", contentOf(captures[0]));
    EXPECT_EQ(jsonOf(desk.run({"measure", alone, "--json"}))["simulated"], true) << "its own header says so";
    for (const std::size_t trial : {0U, 1U, 50U, 99U}) {
        const auto& made = results["trials"][trial];
        EXPECT_NEAR(firstTime(captures[2 * trial + 1]) - firstTime(captures[2 * trial]),
                    made["interval_s"].get<double>(), 1e-4);
        const auto measured = jsonOf(desk.run({"measure", captures[2 * trial], "--json"}));
        EXPECT_NEAR(measured["channels"][0]["amplitude"]["mean"].get<double>(), made["amplitude_v"].get<double>(),
                    0.01 * made["amplitude_v"].get<double>());
    }

    // Analysing the trials as a table gives the same result.
    std::string table = "condition,amplitude,interval\n";
    for (const auto& trial : results["trials"])
        table += trial["condition"].get<std::string>() + "," + trial["amplitude_v"].dump() + "," +
                 trial["interval_s"].dump() + "\n";
    const auto again = desk.run({"analyze", "separability", desk.write("trials.csv", table), "--json"});
    EXPECT_EQ(again.code, 0) << again.err;
    const auto analysed = jsonOf(again);
    expectSeparability(analysed);
    EXPECT_EQ(analysed["verdict"], value["verdict"]);
    EXPECT_EQ(analysed["confusion"], results["confusion"]);
    for (std::size_t i = 0; i < 4; ++i) {
        for (const auto* quantity : {"amplitude_v", "interval_s"}) {
            EXPECT_NEAR(analysed["conditions"][i][quantity]["mean"].get<double>(),
                        results["conditions"][i][quantity]["mean"].get<double>(), 1e-9);
        }
    }
}

TEST(RunSeparability, TooFewTrialsAreIndeterminateAndExitFive) {
    const Desk desk;
    const auto ran = desk.run(separability(desk.at("out"), "5"));
    EXPECT_EQ(ran.code, 5) << ran.err;
    EXPECT_EQ(jsonOf(ran)["verdict"], "indeterminate");
}

TEST(RunSeparability, TheSameSeedGivesTheSameResultsAndAnotherSeedDoesNot) {
    const Desk desk;
    const auto first = jsonOf(desk.run(separability(desk.at("a"), "2", "7")));
    const auto same = jsonOf(desk.run(separability(desk.at("b"), "2", "7")));
    const auto other = jsonOf(desk.run(separability(desk.at("c"), "2", "8")));
    EXPECT_EQ(first["seed"], 7);
    EXPECT_EQ(first["results"], same["results"]);
    EXPECT_NE(first["results"], other["results"]);
    auto captures = desk.files("a/captures");
    EXPECT_EQ(std::erase_if(captures, [](const auto& file) { return file.first.ends_with("origin.json"); }), 1U);
    ASSERT_EQ(captures.size(), 16U);
    for (const auto& [path, content] : captures) {
        EXPECT_EQ(content, contentOf(desk.path() / "b" / "captures" / std::filesystem::path(path).filename())) << path;
    }
}

TEST(RunSeparability, OutTwiceInTheSameFolderWritesNothingOver) {
    RecordProperty("hazard", "H8");
    const Desk desk;
    const auto first = jsonOf(desk.run(separability(desk.at("out"), "2")));
    const auto before = desk.files("out");
    const auto second = jsonOf(desk.run(separability(desk.at("out"), "2")));
    const auto after = desk.files("out");
    for (const auto& [path, content] : before) {
        ASSERT_TRUE(after.contains(path)) << path;
        EXPECT_EQ(after.at(path), content) << path;
    }
    EXPECT_NE(first["session"], second["session"]);
    EXPECT_NE(first["report"], second["report"]);
    EXPECT_EQ(after.size(), 2 * before.size());
    const auto beside = std::filesystem::path(second["session"].get<std::string>()).parent_path() / "captures";
    EXPECT_TRUE(std::filesystem::exists(beside)) << beside;
}

TEST(RunSeparability, ALoadThatTheLimitsForbidStopsTheRunBeforeItsFirstTrain) {
    RecordProperty("hazard", "H1");
    const Desk desk;
    auto words = separability(desk.at("out"), "2");
    words.insert(words.end(), {"--set", "source=direct", "--set", "load=100"});
    const auto ran = desk.run(words);
    EXPECT_EQ(ran.code, 4) << ran.err;
    EXPECT_EQ(jsonOf(ran)["verdict"], "stopped");
    EXPECT_THAT(ran.err, HasSubstr("10 mA"));
    EXPECT_THAT(ran.err, HasSubstr("separability.js:"));
}

TEST(RunSeparability, ALoadThatIsNotTheDeclaredOneIsNotArmed) {
    RecordProperty("hazard", "H3");
    const Desk desk;
    auto words = separability(desk.at("out"), "2");
    words.insert(words.begin() + 2, {"--device", "sim:stimulator?load=300"});
    const auto ran = desk.run(words);
    EXPECT_EQ(ran.code, 4) << ran.err;
    EXPECT_THAT(ran.err, testing::AllOf(HasSubstr("measured impedance is 299"), HasSubstr("declared load is 1 kohm"),
                                        HasSubstr("20 %")));
}

TEST(RunSeparability, AnElectrodeThatLiftsStopsTheRun) {
    RecordProperty("hazard", "H3");
    const Desk desk;
    auto words = separability(desk.at("out"), "3");
    words.insert(words.begin() + 2, {"--device", "sim:stimulator?mode=current&fault=open@12s"});
    const auto ran = desk.run(words);
    EXPECT_EQ(ran.code, 4) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_EQ(value["verdict"], "stopped");
    EXPECT_TRUE(value["results"].is_null());
    EXPECT_THAT(ran.err, HasSubstr("open"));
    EXPECT_EQ(desk.run({"verify", value["session"]}).code, 0);
}

TEST(Run, EachKindPrintsItsOwnFiguresAndWritesTheReportThatIsAskedFor) {
    const Desk desk;
    struct Case {
        const char* protocol;
        const char* shows;
    };
    for (const auto& each : {Case{"transitions", "Amplitude (JND)"}, Case{"encoding-comparison", "Smallest pair (JND)"},
                             Case{"sensor-calibration", "Told apart"}}) {
        const auto ran =
            desk.run({"run", each.protocol, "--device", "sim:", "--report", "none", "--out", desk.at(each.protocol)});
        EXPECT_THAT(ran.out, HasSubstr(each.shows)) << each.protocol;
        EXPECT_EQ(ran.out.find("Repeatability (%)"), std::string::npos) << "no empty table of a calibration";
        EXPECT_EQ(ran.out.find("nan"), std::string::npos) << ran.out;
        EXPECT_EQ(ran.out.find("  report "), std::string::npos);
        EXPECT_TRUE(desk.named(each.protocol, ".pdf").empty());
        EXPECT_TRUE(desk.named(each.protocol, ".html").empty());
    }
    auto words = separability(desk.at("html"), "2");
    words.insert(words.end(), {"--report", "html"});
    const auto html = jsonOf(desk.run(words));
    EXPECT_THAT(html["report"].get<std::string>(), testing::EndsWith(".html"));
    EXPECT_TRUE(desk.named("html", ".pdf").empty());
    words.back() = "docx";
    const auto refused = desk.run(words);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--report is \"docx\"; none, html or pdf is expected"));
}

/// Returns the words of an HTML report, without its pictures.
std::string wordsOf(std::string html) {
    for (const auto& [from, to] : {std::pair("<svg", "</svg>"), std::pair("src=\"data:", "\"/>")}) {
        for (auto begin = html.find(from); begin != std::string::npos; begin = html.find(from, begin))
            html.erase(begin, std::min(html.find(to, begin), html.size()) - begin);
    }
    return html;
}

TEST(Run, NoShippedProtocolShowsANumberThatAReaderCannotRead) {
    const Desk desk;
    const std::regex unreadable("\\b(nan|inf|null|undefined)\\b|[0-9]e[-+][0-9]", std::regex::icase);
    for (const auto* protocol : {"separability", "stimulator-calibration", "load-safety", "transitions", "variation",
                                 "encoding-comparison", "sensor-calibration"}) {
        const auto ran =
            desk.run({"run", protocol, "--device", "sim:", "--report", "html", "--out", desk.at(protocol)});
        const auto pages = desk.named(protocol, ".html");
        ASSERT_EQ(pages.size(), 1U) << protocol << ran.err;
        for (const auto& text : {ran.out, wordsOf(contentOf(pages.front()))}) {
            std::smatch found;
            EXPECT_FALSE(std::regex_search(text, found, unreadable))
                << protocol << ": "
                << text.substr(std::size_t(std::max<std::ptrdiff_t>(0, found.position() - 80)), 160);
        }
    }
}

TEST(RunLoadSafety, ItsReportHasSixPagesAtMostAndSaysFromHowManyTrainsAWindowIs) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    const auto ran =
        desk.run({"run", "load-safety", "--device", "sim:", "--set", "area=1", "--json", "--out", desk.at("out")});
    const Json result = Json::parse(ran.out, nullptr, false);
    int windows = 0;
    for (const auto& row : result["results"]["rows"]) {
        if (row["item"] != "rms_current_5s" || row["value"].is_null()) continue;
        EXPECT_EQ(row["note"], "from 4 captured trains, repeated") << row["load"];
        ++windows;
    }
    EXPECT_GT(windows, 6);
    const auto pages = contentOf(desk.named("out", ".pdf").at(0));
    const std::string mark = "/Type /Page\n";
    int count = 0;
    for (auto at = pages.find(mark); at != std::string::npos; at = pages.find(mark, at + 1)) ++count;
    EXPECT_GE(count, 3);
    EXPECT_LE(count, 6);
}

TEST(Run, WhoDidItAndTheAmbientConditionsStandInItsReport) {
    const Desk desk;
    Words words{
        "run",  "encoding-comparison", "--device",         "sim:",     "--operator", "Åsa <b>Lind</b>", "--report",
        "html", "--ambient",           "22.5 °C, 45 % RH", "--sample", "S-014",      "--out",           desk.at("out")};
    ASSERT_EQ(desk.run(words).code, 0);
    const auto page = contentOf(desk.named("out", ".html").at(0));
    EXPECT_THAT(page, HasSubstr("Åsa &lt;b&gt;Lind&lt;/b&gt;"));
    EXPECT_THAT(page, HasSubstr("22.5 °C, 45 % RH"));
    EXPECT_THAT(page, HasSubstr("S-014"));
    EXPECT_THAT(page, HasSubstr("not recorded")) << "the reviewer";
    words[5] = "two\nlines";
    words.back() = desk.at("refused");
    const auto refused = desk.run(words);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("the operator is \"two\\x0alines\"; one line of text"));
    words[5] = std::string(201, 'x');
    EXPECT_THAT(desk.run(words).err, HasSubstr("the operator has 201 characters; at most 200 are accepted"));
    EXPECT_TRUE(desk.named("refused", "").empty());
}

TEST(RunSeparability, TextSaysThatItIsSimulatedAndWhereThingsAre) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    const auto ran = desk.run({"run", "separability", "--device", "sim:", "--set", "repeats=2", "--out", "out"});
    EXPECT_EQ(ran.code, 5) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("SIMULATED"));
    EXPECT_THAT(ran.out, HasSubstr("indeterminate"));
    EXPECT_THAT(ran.out, HasSubstr(desk.named("out", ".tacto").at(0).substr(desk.path().string().size() + 1)));
}

TEST(RunLive, ARealFingerDrivesTheStimulatorAndIsRecorded) {
    if (!sharedData("biotac")) GTEST_SKIP() << kNoSharedData;
    const Desk desk;
    for (const auto* material : {"mat1_1", "mat6_1", "mat11_1", "mat16_1"}) {
        const auto ran =
            desk.run({"run", "live", "--device", "recording:" + sharedData("biotac")->string() + "/" + material,
                      "--device", "sim:", "--out", desk.at(material), "--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        const auto value = jsonOf(ran);
        expectKeys(value, kRunKeys, "run");
        EXPECT_TRUE(value["verdict"].is_null());
        EXPECT_GT(value["results"]["trains_delivered"].get<int>(), 2) << material;
        EXPECT_TRUE(std::filesystem::exists(value["report"].get<std::string>()));
        const auto verified = desk.run({"verify", value["session"], "--json"});
        EXPECT_EQ(verified.code, 0);
        EXPECT_GT(jsonOf(verified)["samples"].get<int>(), 10000) << "the finger is in the session";
    }
}

TEST(RunLive, TheShippedExampleRuns) {
    const Desk desk;
    const auto ran =
        desk.run({"run", "live", "--device", "recording:" + (sourceDir() / "resources/examples/linen-slide").string(),
                  "--device", "sim:", "--out", desk.at("out"), "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_GT(jsonOf(ran)["results"]["trains_delivered"].get<int>(), 2);
}

TEST(RunLive, TheFirstExampleMovesAmplitudeAndInterval) {
    const Desk desk;
    const auto script = desk.protocol("extremes.js", R"js(
protocol({ title: "Extremes", purpose: "How far an example drives the trains.", needs: ["sensor", "stimulator"] });
function run(p) {
  bench.drive("sensor");
  bench.arm({ load: 1000 });
  const states = bench.watch(30).filter((s) => s.contact);
  bench.disarm();
  const volts = states.map((s) => s.amplitude_v).filter(Number.isFinite);
  const seconds = states.map((s) => s.interval_s).filter(Number.isFinite);
  return verdict({ verdict: null, least_v: Math.min(...volts), most_v: Math.max(...volts),
                   least_s: Math.min(...seconds), most_s: Math.max(...seconds),
                   delivered: bench.live().trains_delivered });
})js");
    const auto touches = (sourceDir() / "resources/examples/four-touches").string();
    const auto ran = desk.run(
        {"run", script, "--device", "recording:" + touches, "--device", "sim:", "--out", desk.at("out"), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto results = jsonOf(ran)["results"];
    EXPECT_LT(results["least_v"].get<double>(), 17) << results.dump();
    EXPECT_GT(results["most_v"].get<double>(), 20) << results.dump() << ": 1.2 times from train to train";
    EXPECT_LT(results["least_s"].get<double>(), 0.8) << results.dump();
    EXPECT_GT(results["most_s"].get<double>(), 1.5) << results.dump();
    EXPECT_GT(results["delivered"].get<int>(), 3) << results.dump();
}

TEST(RunLive, TheVirtualClockIsFasterThanTheRealOneAndRealtimeIsNot) {
    const Desk desk;
    const auto seconds = [&](const Words& more) {
        Words words{"run", "live", "--device", "sim:", "--out", desk.at("out")};
        words.insert(words.end(), more.begin(), more.end());
        const auto begun = std::chrono::steady_clock::now();
        EXPECT_EQ(desk.run(words).code, 0);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    };
    EXPECT_IN_TIME(seconds({"--set", "duration=120"}) < 60);
    EXPECT_GE(seconds({"--set", "duration=1.5", "--realtime"}), 1.5);
}

TEST(RunCaptureFolder, AnOscilloscopeFromFilesGivesTheTrialsOfThoseFiles) {
    const Desk desk;
    auto words = separability(desk.at("first"), "3", "5");
    words.insert(words.end(), {"--set", "source=direct"});
    const auto first = jsonOf(desk.run(words));
    words = separability(desk.at("second"), "3", "5");
    words.insert(words.begin() + 2, {"--device", "capture:" + desk.at("first/captures")});
    words.insert(words.end(), {"--set", "source=direct"});
    const auto ran = desk.run(words);
    const auto second = jsonOf(ran);
    ASSERT_TRUE(second["results"].is_object()) << ran.err;
    ASSERT_EQ(second["results"]["trials"].size(), 12U);
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_NEAR(second["results"]["trials"][i]["amplitude_v"].get<double>(),
                    first["results"]["trials"][i]["amplitude_v"].get<double>(), 1e-3);
    }
}

TEST(Run, ResultsOfAnyShapeLeaveTheVerdictStanding) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    for (const char* results : {"loads: [1]", "loads: 5", "loads: [{ name: 3, verdict: {} }]", "confusion: 1",
                                "confusion: [[1, 'x'], 2]", "trials_needed: 'many'", "reference: 5, amplitude: [1]",
                                "amplitude: { levels: [1], readings: [1] }, reference: {}"}) {
        const auto script =
            desk.protocol("shape.js", fmt::format("protocol({{ title: 'S' }});\nfunction run(p) {{ return "
                                                  "verdict({{ verdict: 'pass', {} }}); }}",
                                                  results));
        const auto ran = desk.run({"run", script, "--device", "sim:", "--out", desk.at("out")});
        EXPECT_EQ(ran.code, 0) << results << "\n" << ran.err;
        EXPECT_THAT(ran.out, HasSubstr("pass")) << results;
    }
}

TEST(RunLoadSafety, RefusesASettingThatNothingReadsAndNamesAnAnswerThatWasNotAskedFor) {
    const Desk desk;
    const auto misspelt =
        desk.run({"run", "load-safety", "--device", "sim:", "--set", "aera=3", "--out", desk.at("a")});
    EXPECT_EQ(misspelt.code, 2) << misspelt.err;
    EXPECT_THAT(misspelt.err, HasSubstr("load-safety has no parameter aera; it has area, "));
    const auto unasked = desk.run({"run", "load-safety", "--device", "sim:", "--set", "area=3", "--set", "steps=2",
                                   "--set", "dmm-1-kohm=1000", "--out", desk.at("b")});
    EXPECT_EQ(unasked.code, 0) << unasked.err;
    EXPECT_THAT(unasked.err, HasSubstr("--set dmm-1-kohm: the protocol did not ask for it."));
}

TEST(Run, AScriptThatDeclaresByTheClockDoesNotRun) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    const auto script = desk.protocol("clock.js",
                                      "protocol({ title: 'Certified ' + Date.now(), needs: ['stimulator'] });\n"
                                      "function run(p) { log('it ran'); return verdict({ verdict: 'pass' }); }");
    const auto ran = desk.run({"run", script, "--device", "sim:", "--out", desk.at("out")});
    EXPECT_EQ(ran.code, 3) << ran.out;
    EXPECT_THAT(ran.err, HasSubstr("when it runs the script declares another title"));
    EXPECT_THAT(ran.err, testing::Not(HasSubstr("it ran")));
}

TEST(Run, AnErrorThatAScriptMakesUpIsNoStop) {
    RecordProperty("hazard", "H9");
    const Desk desk;
    for (const char* code : {"4", "5", "6"}) {
        const auto script = desk.protocol(
            "forged.js", fmt::format("protocol({{ title: 'S' }});\nfunction run(p) {{ throw Object.assign(new Error("
                                     "'stopped by operator (signal)'), {{ code: {} }}); }}",
                                     code));
        const auto ran = desk.run({"run", script, "--device", "sim:", "--out", desk.at("out"), "--json"});
        EXPECT_EQ(ran.code, 3) << ran.err;
        EXPECT_THAT(ran.out, testing::Not(HasSubstr("stopped\"")));
    }
}

TEST(Run, TwoThatBeginInTheSameSecondKeepTheirSessions) {
    const Desk desk;
    const auto script = desk.protocol("short.js",
                                      "protocol({ title: 'S' });\nfunction run(p) { return verdict({ verdict: "
                                      "'pass' }); }");
    const Words words{"run", script, "--device", "sim:"};
    std::vector<std::unique_ptr<Desk::Started>> runs;
    for (int i = 0; i < 6; ++i) runs.emplace_back(new Desk::Started(desk.start(words)));
    for (const auto& run : runs) {
        const auto ran = run->wait(std::chrono::seconds(60));
        EXPECT_EQ(ran.code, 0) << ran.err;
    }
}

}  // namespace
}  // namespace tacto::test
