#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/acquisition/Recording.h"
#include "tests/support/Support.h"

using namespace tacto;
using tacto::test::ScratchDir;

namespace {

constexpr auto kAcceleration = R"({"kind": "acceleration", "file": "a.csv", "time_column": "time", "time_unit": "s",
                                   "columns": ["X", "Y"], "unit": "g"})";

Recording opened(const ScratchDir& folder, const std::string& csv, const std::string& stream = kAcceleration,
                 const std::string& more = "") {
    folder.write("a.csv", csv);
    folder.write("recording.json",
                 R"({"title": "t", "source": "s", "licence": "MIT", )" + more + R"( "streams": [)" + stream + "]}");
    auto recording = Recording::open(folder.path());
    EXPECT_TRUE(recording) << recording.error().message;
    return recording ? *recording : Recording{};
}

}  // namespace

TEST(Recording, MayNameTheFingertipThatWasRecorded) {
    const ScratchDir folder;
    const std::string samples = "time,X,Y\n0,1,-2\n0.01,0,0.5\n0.02,0,0\n";
    EXPECT_EQ(opened(folder, samples, kAcceleration, R"("fingertip": "B-1", )").fingertip, "B-1");
    EXPECT_EQ(opened(folder, samples).fingertip, "") << "not stated";
}

TEST(Recording, ReadsAFolderAndConvertsItsUnits) {
    const ScratchDir folder;
    const auto recording = opened(folder, "time,X,Y\n0,1,-2\n0.01,0,0.5\n0.02,0,0\n");
    ASSERT_EQ(recording.streams.size(), 1U);
    const auto& stream = recording.streams[0];
    EXPECT_EQ(recording.title, "t");
    EXPECT_EQ(recording.licence, "MIT");
    EXPECT_EQ(stream.info.kind, StreamKind::Acceleration);
    EXPECT_EQ(stream.info.unit, StreamUnit::MetrePerSecondSquared);
    EXPECT_EQ(stream.info.channels, 2U);
    EXPECT_NEAR(stream.info.rate_hz, 100, 1e-9);
    EXPECT_DOUBLE_EQ(stream.samples.values[0], 9.80665);
    EXPECT_DOUBLE_EQ(stream.samples.values[1], -2 * 9.80665);
    EXPECT_TRUE(stream.health.continuous());
}

TEST(Recording, ReadsAJsonFileByItselfAndTimesInMillisecondsAndMicroseconds) {
    const ScratchDir folder;
    folder.write("t.csv", "timestamp, c1, c2\r\n1000,1,2\r\n1028,3,4\r\n1056,5,6\r\n");
    folder.write("f.csv", "us,force\n5000,0.5\n10000,0.75\n");
    const auto json = folder.write("some.json", R"({"streams": [
        {"kind": "taxels", "file": "t.csv", "time_column": "timestamp", "time_unit": "ms", "columns": ["c1", "c2"],
         "unit": "kPa"},
        {"kind": "force", "file": "f.csv", "time_column": "us", "time_unit": "us", "columns": ["force"],
         "unit": "N"}]})");
    const auto recording = Recording::open(json);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->title, "some");
    const auto* taxels = recording->find(StreamKind::Taxels);
    ASSERT_NE(taxels, nullptr);
    EXPECT_EQ(taxels->info.unit, StreamUnit::Pascal);
    EXPECT_THAT(taxels->samples.values, testing::ElementsAre(1000, 2000, 3000, 4000, 5000, 6000));
    EXPECT_THAT(taxels->samples.t_s, testing::ElementsAre(1.0, 1.028, 1.056));
    EXPECT_DOUBLE_EQ(recording->find(StreamKind::Force)->samples.t_s[0], 0.005);
    EXPECT_DOUBLE_EQ(recording->extent().begin_s, 0.005);
    EXPECT_DOUBLE_EQ(recording->extent().end_s, 1.056);
    EXPECT_EQ(recording->find(StreamKind::Acceleration), nullptr);
}

TEST(Recording, BearsTheWild) {
    const ScratchDir folder;
    // Byte-order mark, blanks in names, trailing commas, CR LF, nan, a last row without values, blank rows.
    const auto recording = opened(folder,
                                  "\xEF\xBB\xBF time , X ,Y,,\r\n0,1,2,,\r\n0.01,-nan,nan,,\r\n0.02,3,4,,\r\n"
                                  "0.03,,,,\r\n,,,,\r\n\r\n  \r\n");
    const auto& stream = recording.streams.at(0);
    ASSERT_EQ(stream.samples.samples(), 3U);
    EXPECT_TRUE(std::isnan(stream.samples.values[2]));
    EXPECT_EQ(stream.health.invalidSamples, 1U) << "read, not used silently";
}

TEST(Recording, TakesOnlyTheColumnsItWasToldOf) {
    const ScratchDir folder;
    const auto recording = opened(folder, "note,Y,time,X\nfirst,1,0,2\nsecond,3,0.5,4\n");
    EXPECT_THAT(recording.streams.at(0).samples.values,
                testing::ElementsAre(2 * 9.80665, 9.80665, 4 * 9.80665, 3 * 9.80665));
}

TEST(Recording, ACountThatStandsAloneFarFromAllOthersIsNoReadingAndAContactIs) {
    const ScratchDir folder;
    std::string csv = "time,X,Y\n";
    for (int i = 0; i < 1000; ++i) {
        const bool spike = i == 317 || i == 318, contact = i >= 600 && i < 640;
        csv += fmt::format("{:.3f},{},{}\n", i * 0.001, spike ? 505831 : i % 7, contact ? 60000 : 2000 + i % 5);
    }
    const auto recording = opened(folder, csv, R"({"kind": "acceleration", "file": "a.csv", "time_column": "time",
                                                   "time_unit": "s", "columns": ["X", "Y"], "unit": "count"})");
    const auto& stream = recording.streams.at(0);
    EXPECT_EQ(stream.health.invalidSamples, 2U);
    EXPECT_TRUE(std::isinf(stream.samples.values[2 * 317]));
    EXPECT_EQ(stream.samples.values[2 * 600 + 1], 60000);
}

TEST(Recording, ReportsTimeThatGoesBackwards) {
    RecordProperty("hazard", "H7");
    const ScratchDir folder;
    const auto recording = opened(folder, "time,X,Y\n0,1,1\n0.01,1,1\n0.02,1,1\n0.01,1,1\n0.02,1,1\n0.03,1,1\n");
    EXPECT_EQ(recording.streams.at(0).health.clockSteps, 1U);
    EXPECT_EQ(recording.streams.at(0).samples.samples(), 6U) << "kept as recorded";
}

TEST(Recording, ReadsBaselineAndContact) {
    const ScratchDir folder;
    const auto recording = opened(folder, "time,X,Y\n0,1,1\n1,1,1\n2,1,1\n3,1,1\n4,1,1\n", kAcceleration,
                                  R"("baseline": [0, 1], "contact": [[3, 4], [1.5, 2]], "note": {"any": 1},)");
    ASSERT_TRUE(recording.declared.baseline);
    EXPECT_EQ(recording.declared.baseline->end_s, 1);
    ASSERT_TRUE(recording.declared.contact);
    ASSERT_EQ(recording.declared.contact->size(), 2U);
    EXPECT_EQ(recording.declared.contact->front().begin_s, 1.5) << "in time order";
}

TEST(Recording, SpreadsCoarseStampsAndSaysSo) {
    const ScratchDir folder;
    std::string csv = "time,X,Y\n";
    for (int i = 0; i < 4000; ++i) csv += fmt::format("{:.3f},0,0\n", std::floor(i / 4.0) / 1000);
    const auto recording = opened(folder, csv);
    EXPECT_TRUE(recording.streams.at(0).health.coarseStamps);
    EXPECT_NEAR(recording.streams.at(0).info.rate_hz, 4000, 4);
}
