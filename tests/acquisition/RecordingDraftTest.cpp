// A recording.json for a table that has none: it contains what the table states, and asks for the rest.
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

#include "core/acquisition/Recording.h"
#include "core/acquisition/RecordingDraft.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

using namespace tacto;
using tacto::test::ScratchDir;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

namespace {

RecordingDraft draftOf(const ScratchDir& folder, const std::string& csv) {
    const auto draft = draftRecording(folder.write("a.csv", csv));
    EXPECT_TRUE(draft) << draft.error().message << "\n" << csv;
    return draft ? *draft : RecordingDraft{};
}

}  // namespace

TEST(RecordingDraft, SaysWhatTheHeaderSaysAndOpensWhereNothingIsLeft) {
    struct Kind {
        const char* kind;
        std::vector<std::string> columns;
        std::vector<std::pair<const char*, double>> units;
    };
    const std::vector<Kind> kinds{
        {"acceleration", {"ax", "ay", "az"}, {{"m/s²", 1}, {"g", 9.80665}, {"mg", 0.00980665}}},
        {"force", {"Fz"}, {{"N", 1}, {"mN", 1e-3}, {"kN", 1e3}}},
        {"taxels", {"taxel1", "taxel2", "taxel3"}, {{"Pa", 1}, {"kPa", 1e3}, {"hPa", 100}}}};
    const std::vector<std::pair<const char*, double>> times{{"s", 1}, {"ms", 1e-3}, {"µs", 1e-6}, {"ns", 1e-9}};
    const auto count = tacto::test::trials<unsigned>({.local = 100, .ci = 500, .campaign = 5000});
    for (unsigned seed = 1; seed <= count; ++seed) {
        std::mt19937 random(seed);
        const auto from = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
        const auto& kind = kinds[static_cast<std::size_t>(from(0, 2))];
        const auto [unit, factor] = kind.units[static_cast<std::size_t>(from(0, 2))];
        const auto [timeUnit, toSeconds] = times[static_cast<std::size_t>(from(0, 3))];
        const bool timed = from(0, 1) == 1, below = from(0, 1) == 1, german = from(0, 1) == 1;
        const char separator = german ? ';' : ',';
        const double rate_hz = from(2, 40) * 100;
        std::string csv;
        for (int i = from(0, 3); i > 0; --i) csv += fmt::format("Session{}{}\n", separator, i);
        if (!timed) csv += fmt::format("Sample rate: {} kHz\n", rate_hz / 1000);
        std::string header = timed ? below ? "time" : fmt::format("time ({})", timeUnit) : std::string();
        std::string units = timed && below ? fmt::format("({})", timeUnit) : std::string();
        for (const auto& column : kind.columns) {
            header += fmt::format("{}{}", header.empty() ? "" : std::string(1, separator),
                                  below ? column : fmt::format("{} [{}]", column, unit));
            units += fmt::format("{}({})", units.empty() ? "" : std::string(1, separator), unit);
        }
        csv += header + "\n" + (below ? units + "\n" : "");
        std::vector<double> values;
        for (int row = 0; row < 50; ++row) {
            std::string line = timed ? fmt::format("{}", std::llround(row / rate_hz / 1e-9)) : std::string();
            if (timed) {
                // Rounded to the nanosecond, in the unit of the file.
                const int digits = static_cast<int>(std::lround(9 + std::log10(toSeconds)));
                while (line.size() <= static_cast<std::size_t>(digits)) line.insert(0, "0");
                if (digits > 0) line.insert(line.size() - static_cast<std::size_t>(digits), 1, german ? ',' : '.');
            }
            for (std::size_t c = 0; c < kind.columns.size(); ++c) {
                const int mantissa = from(-9999, 9999);
                values.push_back(mantissa / 100.0 * factor);
                if (!line.empty()) line += separator;
                line += fmt::format("{}{}{}{:02}", mantissa < 0 ? "-" : "", std::abs(mantissa) / 100,
                                    german ? ',' : '.', std::abs(mantissa) % 100);
            }
            csv += line + "\n";
        }
        const ScratchDir folder;
        const auto draft = draftOf(folder, csv);
        EXPECT_THAT(draft.open, IsEmpty()) << csv.substr(0, 300) << draft.json;
        folder.write("recording.json", draft.json);
        for (const auto& path : {folder.path(), folder.path() / "a.csv"}) {
            const auto recording = Recording::open(path);
            ASSERT_TRUE(recording) << recording.error().message << "\n" << draft.json << csv.substr(0, 300);
            const auto& stream = recording->streams.at(0);
            ASSERT_EQ(nameOf(stream.info.kind), kind.kind);
            ASSERT_EQ(stream.samples.samples(), 50U);
            ASSERT_NEAR(stream.info.rate_hz, rate_hz, 1e-4 * rate_hz);
            for (std::size_t i = 0; i < values.size(); ++i)
                ASSERT_NEAR(stream.samples.values[i], values[i], 1e-12 * std::abs(values[i]))
                    << draft.json << csv.substr(0, 300);
        }
    }
}

TEST(RecordingDraft, AsksForWhatTheTableDoesNotSayAndOpensOnceItIsFilledIn) {
    const ScratchDir folder;
    std::string csv;
    for (int i = 0; i < 100; ++i) csv += fmt::format("{:.5f}\n", std::sin(i));
    const auto draft = draftOf(folder, csv);
    EXPECT_THAT(draft.open,
                testing::UnorderedElementsAre(HasSubstr("\"kind\""), HasSubstr("\"rate_hz\""), HasSubstr("\"unit\"")));
    folder.write("recording.json", draft.json);
    const auto open = Recording::open(folder.path());
    ASSERT_FALSE(open) << "not filled in yet";
    EXPECT_THAT(open.error().message, HasSubstr("streams[0]"));
    auto filled = Json::parse(draft.json);
    filled["streams"][0].update({{"kind", "acceleration"}, {"rate_hz", 1000}, {"unit", "g"}});
    folder.write("recording.json", filled.dump());
    const auto recording = Recording::open(folder.path());
    ASSERT_TRUE(recording) << recording.error().message;
    EXPECT_EQ(recording->streams.at(0).samples.samples(), 100U);
    EXPECT_NEAR(recording->streams.at(0).samples.values[1], 9.80665 * 0.84147, 1e-4);
}

TEST(RecordingDraft, SeparatesTheStreamsOfOneTable) {
    const ScratchDir folder;
    std::string csv = "timestamp,label,acc_x,acc_y,acc_z,Fz,ch1,ch2,temperature\n";
    csv.erase(csv.find("label,"), 6);
    for (int i = 0; i < 50; ++i) csv += fmt::format("{},1,2,3,0.5,{},{},20\n", 28 * i, 100 + i, 200 + i);
    const auto draft = draftOf(folder, csv);
    const auto json = Json::parse(draft.json);
    ASSERT_EQ(json["streams"].size(), 3U) << draft.json;
    EXPECT_EQ(json["streams"][0]["columns"], Json({"acc_x", "acc_y", "acc_z"}));
    EXPECT_EQ(json["streams"][1]["columns"], Json::array({"Fz"}));
    EXPECT_EQ(json["streams"][2]["columns"], Json({"ch1", "ch2"}));
    EXPECT_EQ(json["streams"][0]["time_unit"], "ms") << "28 ms are 36 Hz; 28 s or 28 us are none of a fingertip";
    EXPECT_THAT(draft.taken, testing::Contains(HasSubstr("temperature")));
    EXPECT_THAT(draft.open, testing::Each(HasSubstr("\"unit\""))) << "and nothing else";
}

TEST(RecordingDraft, WhatIsNoTableIsRefusedAndAFileWithoutADescriptionSaysHowToGetOne) {
    const ScratchDir folder;
    const auto text = folder.write("a.txt", "Dear all,\nthe data follow.\n");
    const auto none = draftRecording(text);
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("no row of numbers"));
    EXPECT_EQ(draftRecording(folder.path() / "absent.csv").error().code, ErrorCode::NotFound);
    const auto bare = Recording::open(folder.write("b.csv", "time,F\n0,1\n1,2\n"));
    ASSERT_FALSE(bare);
    EXPECT_THAT(bare.error().message, HasSubstr("tactoscope-cli roughness"));
    // A description next to the table is ignored if it is not JSON or names another file.
    folder.write("recording.json", "");
    EXPECT_EQ(descriptionBeside(folder.path() / "b.csv"), "");
    folder.write("recording.json", R"({"streams": [{"file": "c.csv"}, 3]})");
    EXPECT_EQ(descriptionBeside(folder.path() / "b.csv"), "");
}
