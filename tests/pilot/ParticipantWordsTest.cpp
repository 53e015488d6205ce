// The words of the participant: those that are built in are whole, and each fault of a file is one sentence that names
// the key.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/analysis/psychophysics/VirtualObserver.h"
#include "core/base/Csv.h"
#include "core/base/Random.h"
#include "core/pilot/Prompt.h"
#include "core/study/NextDay.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

void writeText(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

json file(const char* code) {
    return json::parse(readTextFile(sourceDir() / "resources/words" / (std::string(code) + ".json"), 100'000).value());
}

Result<ParticipantWords> parsed(const json& words) { return ParticipantWords::parse(words.dump(), "xx", "xx.json"); }

TEST(ParticipantWords, EveryFileOfTheResourcesIsBuiltInAndWhole) {
    const auto& all = ParticipantWords::builtIn();
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(sourceDir() / "resources/words")) {
        const auto code = entry.path().stem().string();
        const auto found = std::ranges::find(all, code, &ParticipantWords::code);
        ASSERT_NE(found, all.end()) << code << ": " << parsed(file(code.c_str())).error().message;
        ++files;
        EXPECT_EQ(found->all().size(), file(code.c_str())["words"].size());
        for (const auto& [key, text] : found->all()) EXPECT_EQ(file(code.c_str())["words"][key], text) << key;
    }
    EXPECT_EQ(files, all.size());
    EXPECT_GE(files, 2U);
    EXPECT_EQ(all.front().all().front().first, "introduction.1") << "as the participant reads them";
}

TEST(ParticipantWords, HaveATextForEachAnswerThatTheRecordKnows) {
    for (const auto& words : ParticipantWords::builtIn()) {
        SCOPED_TRACE(words.code());
        for (const auto& effect : kSideEffects) EXPECT_NE(words.text("effects", effect.key, ""), "") << effect.key;
        for (const auto& word : kNaturalness) EXPECT_NE(words.text("naturalness", word.text, ""), "") << word.text;
        for (const auto key : kAnswerPlaces) EXPECT_NE(words.text("condition", key, ""), "") << key;
        for (const auto& prompt : {strengthPrompt(words), intervalPrompt(words), comparisonPrompt(words),
                                   meantPrompt(words), conditionPrompt(answersIn(0), words), holdPrompt(words)}) {
            EXPECT_THAT(prompt.text, Not(HasSubstr(".question"))) << prompt.name;
            for (const auto& target : prompt.targets) EXPECT_FALSE(target.text.empty()) << target.key;
        }
    }
}

TEST(ParticipantWords, FillTheirPlaces) {
    const auto& words = ParticipantWords::english();
    EXPECT_THAT(seriesPrompt(2, 3, words).text, HasSubstr("Series 2 of 3 starts from zero"));
    EXPECT_EQ(words.text("stop.left", {{"left", "{of}"}, {"of", "3"}}), "3 of 3 left");
    EXPECT_EQ(words.text("no.such"), "no.such");
}

TEST(ParticipantWords, AMissingAnUnknownAndAMisplacedKeyAreEachOneSentence) {
    RecordProperty("hazard", "H12");
    const auto whole = file("de");
    ASSERT_TRUE(parsed(whole));
    std::vector<std::string> keys;
    for (const auto& [key, text] : whole["words"].items()) keys.push_back(key);
    Random random(5, "faults of words");
    for (int i = 0; i < 300; ++i) {
        auto words = whole;
        const auto& key = keys[random.below(keys.size())];
        auto& all = words["words"];
        const bool hasPlaces = all[key].get<std::string>().find('{') != std::string::npos;
        switch (random.below(6)) {
            case 0:
                all.erase(key);
                break;
            case 1:
                all[key + "x"] = all[key];
                break;
            case 2:
                all[key] = all[key].get<std::string>() + " {where}";
                break;
            case 3:
                all[key] = hasPlaces ? json("without") : json("{");
                break;
            case 4:
                all[key] = std::array<json, 4>{"", 7, nullptr, std::string(601, 'a')}[random.below(4)];
                break;
            default:
                all[key] = "two\nlines";
                break;
        }
        const auto refused = parsed(words);
        ASSERT_FALSE(refused) << key;
        EXPECT_EQ(refused.error().code, ErrorCode::ParseError);
        EXPECT_THAT(refused.error().message, HasSubstr("xx.json: "));
        EXPECT_THAT(refused.error().message, HasSubstr(key));
        EXPECT_THAT(refused.error().message, Not(HasSubstr("\n"))) << "one sentence";
    }
    for (const char* text : {"", "{", "[]", "7", "{\"language\": \"x\"}", "\xff", "{\"words\": {}}"})
        EXPECT_THAT(ParticipantWords::parse(text, "xx", "xx.json"), refused(ErrorCode::ParseError)) << text;
    auto other = whole;
    other["author"] = "somebody";
    EXPECT_THAT(parsed(other), refused(ErrorCode::ParseError, "author"));
}

TEST(ParticipantWords, AreReadFromAFolderWhereThereIsOne) {
    const ScratchDir folder;
    EXPECT_TRUE(ParticipantWords::in(folder.path() / "words").value().empty());
    auto french = file("en");
    french["language"] = "Français";
    std::filesystem::create_directories(folder.path() / "words");
    writeText(folder.path() / "words/fr.json", french.dump());
    const auto found = ParticipantWords::in(folder.path() / "words").value();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code(), "fr");
    EXPECT_THAT(found[0].name(), HasSubstr("Français, version 1 ("));
    writeText(folder.path() / "words/it.json", "{}");
    EXPECT_THAT(ParticipantWords::in(folder.path() / "words"), refused(ErrorCode::ParseError, "it.json"));
}

}  // namespace
}  // namespace tacto::test
