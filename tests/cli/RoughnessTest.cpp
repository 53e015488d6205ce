// roughness: real recordings, a recording with a known answer, and refused recordings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/LocaleFreeText.h"
#include "core/base/Result.h"
#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

const std::string kHeader = "t_s,contact,sliding,h,v,R,pressure_pa,P";
const Words kStatistics{"h", "v", "R", "pressure_pa", "P"};

using Row = std::vector<std::string>;

std::vector<Row> rowsOf(const std::string& csv) {
    std::vector<Row> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        Row row{""};
        for (const char c : line) {
            if (c == ',')
                row.emplace_back();
            else
                row.back() += c;
        }
        rows.push_back(row);
    }
    return rows;
}

/// Expects that the JSON's statistics are those of the frames in contact in frames.csv.
void expectSummaryOf(const std::string& csv, const Json& summary) {
    auto rows = rowsOf(csv);
    ASSERT_FALSE(rows.empty());
    ASSERT_EQ(csv.substr(0, csv.find('\n')), kHeader);
    rows.erase(rows.begin());
    ASSERT_EQ(rows.size(), summary["frames"].get<std::size_t>());
    std::size_t contact = 0;
    std::array<std::vector<double>, 5> values;
    for (const auto& row : rows) {
        ASSERT_EQ(row.size(), 8U);
        if (row[1] != "1") continue;
        ++contact;
        for (std::size_t i = 0; i < 5; ++i) {
            if (!row[3 + i].empty()) values[i].push_back(*parseNumber(row[3 + i]));
        }
    }
    EXPECT_EQ(contact, summary["contact_frames"].get<std::size_t>());
    for (std::size_t i = 0; i < 5; ++i) {
        const auto& statistic = summary[kStatistics[i]];
        expectStatistic(statistic, kStatistics[i]);
        ASSERT_EQ(statistic["n"].get<std::size_t>(), values[i].size()) << kStatistics[i];
        if (values[i].empty()) continue;
        double sum = 0;
        for (const double value : values[i]) sum += value;
        const double mean = sum / static_cast<double>(values[i].size());
        EXPECT_NEAR(statistic["mean"].get<double>(), mean, 1e-6 * std::abs(mean)) << kStatistics[i];
        const auto [low, high] = std::minmax_element(values[i].begin(), values[i].end());
        EXPECT_NEAR(statistic["min"].get<double>(), *low, 1e-6 * std::abs(*low)) << kStatistics[i];
        EXPECT_NEAR(statistic["max"].get<double>(), *high, 1e-6 * std::abs(*high)) << kStatistics[i];
    }
}

struct Analysed {
    Json summary;
    std::string frames;
};

Analysed roughness(const std::string& recording) {
    const Desk desk;
    const auto ran = desk.run({"roughness", recording, "--out", desk.at("frames.csv"), "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto summary = jsonOf(ran);
    expectKeys(summary,
               {"frames", "contact_frames", "rate_hz", "flags", "h", "v", "R", "pressure_pa", "P", "simulated",
                "known_limit", "R_slide", "R_expanded_uncertainty"},
               recording);
    return {summary, contentOf(desk.at("frames.csv"))};
}

TEST(Roughness, PrintsADescriptionToFillIn) {
    const Desk desk;
    const auto ran = desk.run({"roughness", "--template"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    desk.write("mine/recording.json", ran.out);
    // Without changes, only the files that it names are missing.
    expectRefused(desk.run({"roughness", desk.at("mine")}), 3, {"acceleration.csv"});
    expectRefused(desk.run({"roughness", desk.path().string()}), 3, {"no recording.json", "roughness --template"});
}

TEST(Roughness, RealSlidesHaveSpectralFeaturePressureAndR) {
    if (!sharedData("biotac")) GTEST_SKIP() << kNoSharedData;
    for (const auto* material : {"mat1_1", "mat6_1", "mat11_1", "mat16_1"}) {
        const auto [summary, frames] = roughness(sharedData("biotac")->string() + "/" + material);
        expectSummaryOf(frames, summary);
        EXPECT_NEAR(summary["rate_hz"].get<double>(), 2200, 1) << material;
        EXPECT_GT(summary["R"]["n"].get<int>(), 100) << material;
        EXPECT_THAT(summary["flags"], testing::IsSupersetOf({Json("band truncated"), Json("uncalibrated R"),
                                                             Json("uncalibrated units")}));
        // Window of round(0.064 fs) = 141 samples, hop of round(0.016 fs) = 35; a frame's time is its centre.
        const auto rows = rowsOf(frames);
        EXPECT_NEAR(*parseNumber(rows[1][0]), 70.5 / 2200, 1e-4);
        EXPECT_NEAR(*parseNumber(rows[11][0]) - *parseNumber(rows[1][0]), 350.0 / 2200, 1e-4);
    }
}

TEST(Roughness, TaxelsAloneHaveNoSpectralFeatureAndNoPressure) {
    if (!sharedData("fabric_slide")) GTEST_SKIP() << kNoSharedData;
    const auto [summary, frames] = roughness(sharedData("fabric_slide")->string() + "/Linen_F150_V20mmps_0.json");
    expectSummaryOf(frames, summary);
    EXPECT_EQ(summary["h"]["n"], 0);
    EXPECT_EQ(summary["pressure_pa"]["n"], 0);
    EXPECT_GT(summary["v"]["n"].get<int>(), 100);
    EXPECT_THAT(summary["flags"], testing::IsSupersetOf({Json("no spectral feature"), Json("not force-normalised"),
                                                         Json("contact assumed"), Json("sliding assumed")}));
}

TEST(Roughness, AnAccelerometerAt100HertzHasNoFeatureSoNoR) {
    if (!sharedData("hapmat")) GTEST_SKIP() << kNoSharedData;
    const auto [summary, frames] = roughness(sharedData("hapmat")->string() + "/Metal.json");
    expectSummaryOf(frames, summary);
    EXPECT_EQ(summary["R"]["n"], 0);
    EXPECT_NEAR(summary["rate_hz"].get<double>(), 100, 1);
    EXPECT_THAT(summary["flags"], testing::IsSupersetOf({Json("band truncated"), Json("no spectral feature"),
                                                         Json("contact assumed"), Json("not force-normalised")}));
    for (const auto& row : rowsOf(frames)) {
        EXPECT_EQ(row[5], row[0] == "t_s" ? "R" : "");
    }
}

TEST(Roughness, TheShippedExamplesAreAnalysed) {
    const auto [linen, ofLinen] = roughness((sourceDir() / "resources/examples/linen-slide").string());
    expectSummaryOf(ofLinen, linen);
    EXPECT_GT(linen["R"]["n"].get<int>(), 0);
    const auto touches = (sourceDir() / "resources/examples/four-touches").string();
    const auto [summary, frames] = roughness(touches);
    expectSummaryOf(frames, summary);
    EXPECT_EQ(summary["simulated"], true);
    EXPECT_EQ(summary["flags"], Json::array({"uncalibrated R"}));
    for (const auto& name : kStatistics) {
        const auto& one = summary[name];
        EXPECT_GT(one["n"].get<int>(), 100) << name;
        EXPECT_GT(one["max"].get<double>() - one["min"].get<double>(), 0.5 * one["max"].get<double>()) << name;
    }
    EXPECT_THAT(Desk().run({"roughness", touches}).out, testing::StartsWith("SIMULATED: "));
}

TEST(Roughness, OfATableAloneADescriptionIsPrintedThatOpensOnceItIsSaved) {
    const Desk desk;
    std::string csv = "Sensor 3\ntime;Fz\n(ms);(mN)\n";
    for (int i = 0; i < 400; ++i) csv += fmt::format("{},0;{},5\n", 5 * i, i < 200 ? 0 : 1000);
    const auto table = desk.write("rec/press.csv", csv);
    const auto described = desk.run({"roughness", table});
    EXPECT_EQ(described.code, 0) << described.err;
    EXPECT_THAT(described.err, testing::HasSubstr("saved as recording.json"));
    EXPECT_THAT(described.err, testing::Not(testing::HasSubstr("to fill in")));
    EXPECT_TRUE(Json::accept(described.out)) << described.out;
    desk.write("rec/recording.json", described.out);
    for (const auto& path : {table, desk.at("rec")}) {
        const auto summary = roughness(path).summary;
        EXPECT_NEAR(summary["pressure_pa"]["mean"].get<double>(), 10'005, 1e-6);
    }
    // The program asks for what the table does not state.
    const auto bare = desk.write("bare.csv", "0.5\n0.25\n0.125\n");
    const auto asked = desk.run({"roughness", bare});
    EXPECT_EQ(asked.code, 0);
    for (const auto* key : {"kind", "rate_hz", "unit"})
        EXPECT_THAT(asked.err, testing::HasSubstr(fmt::format("to fill in: streams[0]: \"{}\"", key)));
    desk.write("recording.json", asked.out);
    expectRefused(desk.run({"roughness", desk.path().string()}), 3, {"streams[0]", "\"kind\""});
    expectRefused(desk.run({"roughness", desk.write("words.txt", "Dear all,\n")}), 3,
                  {"words.txt", "no row of numbers"});
}

/// A second of rest, then contact at 1 N, in a recording with a single force stream.
class ForceRecording : public testing::Test {
protected:
    static std::string samples() {
        std::string text = "time,F\n";
        for (int i = 0; i < 400; ++i) text += fmt::format("{:.3f},{}\n", i * 0.005, i < 200 ? 0.0 : 1.0);
        return text;
    }
    std::string recording(const std::string& csv, const Json& change = Json::object()) const {
        Json stream{{"kind", "force"},  {"file", "force.csv"}, {"time_column", "time"},
                    {"time_unit", "s"}, {"columns", {"F"}},    {"unit", "N"}};
        stream.update(change);
        desk.write("rec/force.csv", csv);
        desk.write("rec/recording.json",
                   Json{{"title", "t"}, {"source", "s"}, {"licence", "l"}, {"streams", {stream}}}.dump(1));
        return desk.at("rec");
    }
    void expectRefusedRecording(const std::string& path, const Words& parts) const {
        const auto before = desk.files();
        expectRefused(desk.run({"roughness", path, "--out", desk.at("frames.csv"), "--json"}), 3, parts);
        expectRefused(desk.run({"run", "live", "--device", "recording:" + path, "--device", "sim:", "--out",
                                desk.at("out"), "--json"}),
                      3, parts);
        EXPECT_EQ(desk.files(), before);
        EXPECT_FALSE(std::filesystem::exists(desk.at("out")));
    }
    const Desk desk;
};

TEST_F(ForceRecording, PressureIsForceOverTheContactAreaAndTheRestIsAbsent) {
    const auto [summary, frames] = roughness(recording(samples()));
    expectSummaryOf(frames, summary);
    EXPECT_EQ(summary["pressure_pa"]["mean"], 10000.0);  // 1 N over 1 cm2
    EXPECT_NEAR(summary["P"]["mean"].get<double>(), 8.0 / 48.0, 1e-12);
    for (const auto* absent : {"h", "v", "R"}) EXPECT_TRUE(summary[absent]["mean"].is_null()) << absent;
    const auto rows = rowsOf(frames);
    EXPECT_EQ(rows[1][1], "0");
    EXPECT_EQ(rows.back()[1], "1");
    EXPECT_EQ(rows.back()[5], "");
}

TEST_F(ForceRecording, ZeroInContactSaysWhyInTextAndJsonAndInALiveRun) {
    RecordProperty("hazard", "H7");
    std::string text = "time,F\n";
    for (int i = 0; i < 400; ++i) text += fmt::format("{:.3f},{}\n", i * 0.005, -1.0 - 0.1 * (i % 3));
    const auto path = recording(text);
    const auto summary = roughness(path).summary;
    EXPECT_EQ(summary["contact_frames"], 0);
    EXPECT_THAT(summary["flags"].dump(), testing::HasSubstr("force below contact: -1.2 to -1 N"));
    const std::string sentence = "between -1.2 and -1 N; is the sign of the normal force reversed?";
    EXPECT_THAT(desk.run({"roughness", path}).out, testing::HasSubstr(sentence));
    EXPECT_THAT(
        desk.run({"run", "live", "--device", "recording:" + path, "--device", "sim:", "--out", desk.at("out")}).out,
        testing::HasSubstr(sentence));
}

TEST_F(ForceRecording, ColumnNamesAreTrimmed) {
    auto text = samples();
    text.replace(0, 6, " time , F ");
    EXPECT_EQ(roughness(recording(text)).frames, roughness(recording(samples())).frames);
}

TEST_F(ForceRecording, AWrongColumnIsNamedWithFileLineAndColumns) {
    expectRefusedRecording(recording(samples(), {{"columns", {"G"}}}), {"force.csv:1", "\"G\"", "time, F"});
    expectRefusedRecording(recording(samples(), {{"time_column", "t"}}), {"force.csv:1", "\"t\"", "time, F"});
}

TEST_F(ForceRecording, AWrongUnitOrKindIsNamedWithThoseThatAreAccepted) {
    expectRefusedRecording(recording(samples(), {{"unit", "lb"}}), {"recording.json", "\"lb\"", "N"});
    expectRefusedRecording(recording(samples(), {{"time_unit", "h"}}), {"recording.json", "\"h\"", "ms"});
    expectRefusedRecording(recording(samples(), {{"kind", "smell"}}), {"recording.json", "smell", "taxels"});
}

TEST_F(ForceRecording, AnEmptyFileIsRefused) {
    expectRefusedRecording(recording(""), {"force.csv:1", "empty", "expected"});
    expectRefusedRecording(recording("time,F\n"), {"force.csv:1", "0 data rows", "expected"});
}

TEST_F(ForceRecording, ATruncatedFileIsRefused) {
    const auto whole = samples();
    expectRefusedRecording(recording(whole.substr(0, whole.size() - 5)), {"force.csv:401", "cut short"});
}

TEST_F(ForceRecording, WhatIsNotANumberIsRefusedWithItsLine) {
    auto text = samples();
    text.replace(text.find("0.050,0"), 7, "0.050,x");
    expectRefusedRecording(recording(text), {"force.csv:12", "\"x\"", "number"});
}

TEST_F(ForceRecording, AFileOutsideTheFolderIsRefused) {
    RecordProperty("hazard", "H10");
    desk.write("other.csv", samples());
    expectRefusedRecording(recording(samples(), {{"file", desk.at("other.csv")}}), {"recording.json", "other.csv"});
    expectRefusedRecording(recording(samples(), {{"file", "../other.csv"}}), {"recording.json", "../other.csv"});
    expectRefusedRecording(recording(samples(), {{"file", "none.csv"}}), {"recording.json", "none.csv"});
}

TEST_F(ForceRecording, ADescriptionThatIsNoDescriptionIsRefused) {
    desk.write("rec/recording.json", "{ streams");
    expectRefusedRecording(desk.at("rec"), {"recording.json", "JSON"});
    desk.write("rec/recording.json", "{}");
    expectRefusedRecording(desk.at("rec"), {"recording.json"});
    expectRefusedRecording(desk.at("none"), {"none"});
}

TEST_F(ForceRecording, FramesAreNotWrittenOverTheRecordingItself) {
    RecordProperty("hazard", "H8");
    const auto path = recording(samples());
    const auto before = desk.files();
    for (const auto* own : {"rec/force.csv", "rec/recording.json", "rec/../rec/force.csv"}) {
        expectRefused(desk.run({"roughness", path, "--out", desk.at(own)}), 2, {own, "recording"});
    }
    EXPECT_EQ(desk.files(), before);
}

TEST_F(ForceRecording, FramesThatCannotBeWrittenAreAnError) {
    expectRefused(desk.run({"roughness", recording(samples()), "--out", desk.at("no/such/frames.csv"), "--json"}), 3,
                  {"frames.csv"});
}

}  // namespace
}  // namespace tacto::test
