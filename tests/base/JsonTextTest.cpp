#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>

#include "core/base/JsonText.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string refusal(std::string_view text, const JsonLimits& limits = {}) {
    const auto parsed = parseJson(text, "lab.json", limits);
    return parsed ? "accepted as " + parsed->dump() : parsed.error().message;
}

TEST(JsonText, ReadsWhatTheLibraryReads) {
    for (const char* text : {R"({"a": [1, -2, 3.5e-3, true, false, null, "x\u00e9", {}], "b": {"a": []}})", "[]", "7",
                             "\"text\"", " {} \n", "18446744073709551615", "\xEF\xBB\xBF[1]"}) {
        const auto parsed = parseJson(text, "lab.json");
        ASSERT_TRUE(parsed) << text << ": " << parsed.error().message;
        EXPECT_EQ(*parsed, json::parse(text)) << text;
    }
}

TEST(JsonText, RefusesAKeyThatStandsTwice) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(refusal(R"({"a": 1, "b": {"max": 1, "x": {"max": 2}, "max": 3}})"),
              "lab.json: the key \"max\" of one object is given twice; once is expected");
    EXPECT_THAT(refusal(R"([{"max": 1}, {"max": 2}])"), HasSubstr("accepted"));
    // A key with an escape is still the same key.
    EXPECT_THAT(refusal(R"({"max": 1, "m\u0061x": 2})"), HasSubstr("is given twice"));
}

TEST(JsonText, RefusesWhatNestsTooDeep) {
    RecordProperty("hazard", "H10");
    const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
    EXPECT_THAT(refusal(nested(32)), HasSubstr("accepted"));
    EXPECT_EQ(refusal(nested(33)), "lab.json: it nests deeper than 32 levels");
    EXPECT_EQ(refusal(nested(400'000)), "lab.json: it nests deeper than 32 levels");
    EXPECT_EQ(refusal(std::string(400'000, '[')), "lab.json: it nests deeper than 32 levels");
    std::string objects;
    for (int i = 0; i < 33; ++i) objects += "{\"a\":";
    EXPECT_EQ(refusal(objects), "lab.json: it nests deeper than 32 levels");
    EXPECT_THAT(refusal(nested(5), {.depth = 4}), HasSubstr("deeper than 4"));
}

TEST(JsonText, RefusesWhatIsTooLong) {
    RecordProperty("hazard", "H10");
    EXPECT_THAT(refusal("[\"" + std::string(96, 'x') + "\"]", {.bytes = 100}), HasSubstr("accepted"));
    EXPECT_EQ(refusal("[\"" + std::string(97, 'x') + "\"]", {.bytes = 100}),
              "lab.json: 101 bytes; at most 100 are accepted");
}

TEST(JsonText, RefusesWhatIsNotJsonWithItsLine) {
    RecordProperty("hazard", "H10");
    EXPECT_EQ(refusal("{\n\"a\": 1\n\"b\": 2}"), "lab.json: line 3 is not JSON");
    for (const char* text : {"", "{", "[1,]", "{\"a\":1,}", "nan", "[NaN]", "[Infinity]", "{a: 1}", "[1] 2", "{} {}",
                             "'x'", "// no\n[]", "[01]", "\"\xFF\"", "\"\xED\xA0\x80\"", "\"\t\""}) {
        EXPECT_THAT(refusal(text), HasSubstr("is not JSON")) << text;
    }
    EXPECT_THAT(refusal(std::string_view("[1]\0", 4)), HasSubstr("is not JSON"));
    EXPECT_THAT(refusal("[1e999]"), HasSubstr("out of range"));
    EXPECT_THAT(refusal("[-1e999]"), HasSubstr("out of range"));
}

TEST(JsonText, NamesTheKeyThatIsNotKnown) {
    const json value = {{"max", 1}, {"mxa", 2}};
    EXPECT_TRUE(onlyKeys(value, {"max", "mxa", "unit"}, "lab.json: limits[2]"));
    EXPECT_EQ(onlyKeys(value, {"max", "unit"}, "lab.json: limits[2]").error().message,
              "lab.json: limits[2]: \"mxa\" is not a known key; accepted are max, unit");
    EXPECT_EQ(onlyKeys(json::array({1}), {"max"}, "x").error().message, "x: [1] stands where an object is expected");
    EXPECT_EQ(shownJson(std::string(80, 'a')).size(), 60U);
}

TEST(JsonText, IsTheOnlyReaderAndWriterOfJsonInTheProgram) {
    RecordProperty("hazard", "H10");
    // QJsonDocument converts only JSON that the program itself made, never JSON from outside.
    const std::regex other(
        R"re((json|Json|basic_json\s*<[^>]*>)\s*::\s*(parse|accept|sax_parse|from_\w+)\s*\(|"_json\b|>>\s*\w*[jJ]son)re"
        R"re(|(\.|->)dump\()re");
    std::vector<std::string> found;
    std::size_t files = 0;
    for (const char* folder : {"core", "drivers", "app"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(test::sourceDir() / folder)) {
            const auto ending = entry.path().extension();
            if (ending != ".cpp" && ending != ".h") continue;
            ++files;
            std::ifstream in(entry.path());
            std::string line;
            for (int number = 1; std::getline(in, line); ++number) {
                // Each match contains one of these; matching every line with the expression would take seconds.
                if (line.find("son") == std::string::npos && line.find("dump(") == std::string::npos) continue;
                if (std::regex_search(line, other))
                    found.push_back(fmt::format("{}:{}", entry.path().string(), number));
            }
        }
    }
    EXPECT_GT(files, 300U);
    ASSERT_EQ(found.size(), 3U) << testing::PrintToString(found);  // two for reading (text and binary), one for writing
    EXPECT_THAT(found, testing::Each(HasSubstr("core/base/JsonText.cpp")));
}

}  // namespace
}  // namespace tacto
