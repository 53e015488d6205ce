// recording: opens EDF, BDF and XDF files in place: ours by the names of their channels, others' by a recording.json,
// which the refusal prints ready to fill in.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/Random.h"
#include "core/exchange/recordings/OpenRecording.h"
#include "tests/exchange/recordings/Made.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using namespace test;
using Json = nlohmann::json;
using testing::HasSubstr;

std::vector<double> stampsAt(double rate_hz, std::size_t count) {
    std::vector<double> stamps;
    for (std::size_t i = 0; i < count; ++i) stamps.push_back(10 + static_cast<double>(i) / rate_hz);
    return stamps;
}
double wave(std::size_t i, std::size_t c) { return std::sin(0.1 * static_cast<double>(i)) + static_cast<double>(c); }

std::string xdfWith(std::uint32_t id, std::string_view name, std::string_view type, double rate_hz,
                    const std::vector<XdfChannel>& channels) {
    return xdfHeader(id, name, type, "float32", channels.size(), rate_hz, channels) +
           xdfSamples(id, stampsAt(rate_hz, 300), channels.size(), wave);
}

/// Returns the recording.json that a refusal prints.
Json printedJson(const std::string& message) {
    const auto at = message.find("\n{");
    EXPECT_NE(at, std::string::npos) << message;
    return at == std::string::npos ? Json() : Json::parse(message.substr(at));
}

TEST(OpenRecording, OursOpenByTheNamesOfTheirChannels) {
    const ScratchDir folder;
    const auto file = folder.write(
        "ours.xdf", kXdfBegin +
                        xdfWith(1, "acceleration", "acceleration", 1000,
                                {{"acceleration_x", "m/s2"}, {"acceleration_y", "m/s2"}, {"acceleration_z", "m/s2"}}) +
                        xdfWith(2, "force", "force", 200, {{"force", "N"}}) +
                        xdfWith(3, "force-2", "force", 200, {{"force-2", "N"}}) +
                        xdfWith(4, "taxels", "taxels", 200, {{"taxels_c1", "Pa"}, {"taxels_c2", "Pa"}}) +
                        xdfWith(5, "frames", "frames", 60, {{"pressure_pa", "Pa"}, {"R", "1"}}));
    const auto recording = openRecording(file);
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_EQ(recording->streams.size(), 3U);
    EXPECT_EQ(recording->find(StreamKind::Acceleration)->info.channels, 3U);
    EXPECT_NEAR(recording->find(StreamKind::Force)->info.rate_hz, 200, 1e-6);
    EXPECT_EQ(recording->find(StreamKind::Taxels)->info.unit, StreamUnit::Pascal);
    EXPECT_FLOAT_EQ(recording->find(StreamKind::Taxels)->samples.values[5], wave(2, 1));
    EXPECT_EQ(recording->path, file);
}

TEST(OpenRecording, AnAbsentSampleOfOursIsAGap) {
    const ScratchDir folder;
    EdfMade made{.recording = "Startdate 30-NOV-2026 X X Tactoscope_0.2.0_SIMULATED"};
    made.signals = {{.label = "force", .unit = "N"}};
    const auto file = folder.write("ours.edf", made.file([](std::size_t, std::size_t k) {
        return k < 10 || (k >= 100 && k < 140) ? -32768 : static_cast<int>(k);
    }));
    const auto recording = openRecording(file);
    ASSERT_TRUE(recording) << recording.error().message;
    const auto& force = *recording->find(StreamKind::Force);
    EXPECT_EQ(force.samples.samples(), 250U);
    EXPECT_EQ(force.health.gaps, 1U);
    EXPECT_EQ(force.health.invalidSamples, 0U);
    EXPECT_EQ(recording->simulated, true);
}

TEST(OpenRecording, TheRefusalOfAnothersFileListsItAndItsJsonOpensIt) {
    struct Case {
        const char* name;
        std::string content;
        std::vector<const char*> listed;
        Json filled;  ///< what the user puts where it says null
    };
    EdfMade made;
    made.signals = {{.label = "Acc X", .unit = "g"}, {.label = "Acc Y", .unit = "g"}, {.label = "Fz", .unit = ""}};
    const std::vector<Case> cases{
        {"a.xdf",
         kXdfBegin + xdfWith(1, "Shimmer", "Accelerometer", 500, {{"x", "g"}, {"y", "g"}, {"z", "g"}}) +
             xdfWith(2, "Load cell", "", 100, {{"Fz", "mN"}}) + xdfHeader(3, "Keys", "Markers", "string", 1, 0),
         {"Shimmer", "x [g]", "500 Hz", "Load cell", "Fz [mN]", "300 samples", "Keys", "texts"},
         Json::object()},
        {"b.xdf",
         kXdfBegin + xdfWith(1, "", "", 500, {}) + xdfHeader(2, "two", "", "int16", 2, 10) +
             xdfHeader(3, "two", "", "double64", 4, 1000) +
             xdfChunk(3, littleEndianBytes(std::uint32_t{3}) + std::string("\x01\x02\x08", 3) + littleEndianBytes(1.0) +
                             std::string(32, '\1') + "\x08" + littleEndianBytes(2.0) + std::string(32, '\2')),
         {"two", "4 channels without a name"},
         {{"kind", "acceleration"}, {"unit", "g"}}},
        {"c.edf",
         made.file([](std::size_t, std::size_t k) { return static_cast<int>(k); }),
         {"Acc X [g]", "Fz", "300 samples"},
         {{"unit", "mN"}}}};
    for (const auto& one : cases) {
        SCOPED_TRACE(one.name);
        const ScratchDir folder;
        const auto file = folder.write(one.name, one.content);
        const auto refused = openRecording(file);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::NotFound);
        for (const auto* listed : one.listed) EXPECT_THAT(refused.error().message, HasSubstr(listed));
        auto json = printedJson(refused.error().message);
        for (auto& stream : json.at("streams"))
            for (auto& [key, value] : stream.items())
                if (value.is_null()) value = one.filled.at(key);
        folder.write("recording.json", json.dump());
        for (const auto& path : {file, folder.path()}) {
            const auto opened = openRecording(path);
            ASSERT_TRUE(opened) << opened.error().message << json.dump(1);
            EXPECT_EQ(opened->streams.size(), json.at("streams").size());
        }
    }
}

/// Opens one XDF stream with two channels by an entry of recording.json.
Result<Recording> openedAs(const Json& entry, const std::vector<XdfChannel>& channels) {
    const ScratchDir folder;
    folder.write("a.xdf", kXdfBegin + xdfWith(1, "S", "", 100, channels) + xdfWith(2, "T", "", 100, channels));
    Json stream{{"kind", "force"}, {"file", "a.xdf"}, {"stream", "S"}, {"columns", {1}}};
    stream.update(entry);
    for (auto it = stream.begin(); it != stream.end();) it = it->is_null() ? stream.erase(it) : std::next(it);
    folder.write("recording.json", Json{{"streams", {stream}}}.dump());
    return openRecording(folder.path());
}

TEST(OpenRecording, UnitsComeFromTheFileElseFromTheJson) {
    struct Case {
        const char *kind, *inFile, *inJson;
        double factor;
        StreamUnit unit;
    };
    using enum StreamUnit;
    for (const auto& one : {Case{"force", "mN", nullptr, 1e-3, Newton}, Case{"force", "", "kN", 1e3, Newton},
                            Case{"force", "N", "N", 1, Newton}, Case{"force", "µV", nullptr, 1, Count},
                            Case{"force", "microvolts", nullptr, 1, Count}, Case{"force", "mV", nullptr, 1e3, Count},
                            Case{"force", "uV", "N", 1, Newton}, Case{"force", "lbf", "count", 1, Count},
                            Case{"acceleration", "g", nullptr, 9.80665, MetrePerSecondSquared},
                            Case{"acceleration", "m/s^2", nullptr, 1, MetrePerSecondSquared}}) {
        const auto recording = openedAs({{"kind", one.kind}, {"unit", one.inJson ? Json(one.inJson) : Json()}},
                                        {{"a", one.inFile}, {"b", one.inFile}});
        SCOPED_TRACE(fmt::format("{} in {}", one.kind, one.inFile));
        ASSERT_TRUE(recording) << recording.error().message;
        EXPECT_EQ(recording->streams[0].info.unit, one.unit);
        EXPECT_NEAR(recording->streams[0].samples.values[5], one.factor * wave(5, 0), 1e-6 * one.factor);
    }
}

TEST(OpenRecording, AnEntryThatDoesNotFitIsRefusedByName) {
    const std::vector<XdfChannel> channels{{"a", "N"}, {"a", "N"}, {"v", "furlong"}};
    const std::pair<Json, const char*> cases[] = {{{{"stream", nullptr}}, "\"S\", \"T\""},
                                                  {{{"stream", "U"}}, "\"S\", \"T\""},
                                                  {{{"stream", 9}}, "number 9"},
                                                  {{{"columns", {"a"}}}, "2 channels are called so"},
                                                  {{{"columns", {"w"}}}, "\"w\""},
                                                  {{{"columns", {4}}}, "number 4"},
                                                  {{{"columns", {"v"}}}, "furlong"},
                                                  {{{"unit", "mN"}}, "states \"N\""},
                                                  {{{"unit", "Pa"}}, "\"Pa\""},
                                                  {{{"rate_hz", 100}}, "rate_hz"},
                                                  {{{"time_column", "a"}, {"time_unit", "s"}}, "time_column"},
                                                  {{{"columns", {1, 2}}}, "2 columns"},
                                                  {{{"factor", 0}}, "factor"}};
    for (const auto& [entry, named] : cases) {
        const auto recording = openedAs(entry, channels);
        ASSERT_FALSE(recording) << entry.dump();
        EXPECT_THAT(recording.error().message, HasSubstr(named)) << entry.dump();
        EXPECT_THAT(recording.error().message, HasSubstr("streams[0]")) << entry.dump();
    }
    EXPECT_TRUE(openedAs({{"stream", 2}}, channels)) << "by its number in the file";
}

TEST(OpenRecording, StampsAreNeverSmoothed) {
    const ScratchDir folder;
    auto stamps = stampsAt(100, 400);
    for (std::size_t i = 0; i < stamps.size(); ++i) stamps[i] = stamps[i / 4 * 4];  // four samples at a time
    const auto file =
        folder.write("a.xdf", kXdfBegin + xdfHeader(1, "force", "force", "float32", 1, 100, {{"force", "N"}}) +
                                  xdfSamples(1, stamps, 1, wave));
    const auto recording = openRecording(file);
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->streams[0].samples.t_s, stamps);
    EXPECT_EQ(recording->streams[0].health.repeats, 300U);
    EXPECT_FALSE(recording->streams[0].health.coarseStamps);
}

TEST(OpenRecording, AStreamWhoseClockWasResetIsRefusedWithTheTime) {
    const auto offsets = xdfOffset(1, 50, 1) + xdfOffset(1, 55, 1) + xdfOffset(1, 20, 36);
    for (const char* label : {"force", "Fz"}) {
        const ScratchDir folder;
        const auto file = folder.write("a.xdf", kXdfBegin + xdfWith(1, "S", "", 100, {{label, "N"}}) + offsets);
        const auto recording = openRecording(file);
        ASSERT_FALSE(recording);
        EXPECT_THAT(recording.error().message, HasSubstr("its clock was reset after 56.000 s")) << label;
    }
}

TEST(OpenRecording, DamageIsSaid) {
    const ScratchDir folder;
    const auto file =
        folder.write("a.xdf", kXdfBegin + xdfWith(1, "force", "force", 100, {{"force", "N"}}) + "\x03garbage");
    const auto recording = openRecording(file);
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_EQ(recording->warnings.size(), 1U);
    EXPECT_THAT(recording->warnings[0], HasSubstr("a.xdf"));
    EXPECT_THAT(recording->warnings[0], HasSubstr("damaged"));
}

}  // namespace
}  // namespace tacto
