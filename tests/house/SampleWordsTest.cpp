// sample_words.py draws pieces of prose for reading aloud: sixty, of every kind, always the same for one seed.
#include <gmock/gmock.h>
#include <map>
#include <regex>
#include <sstream>

#include "tests/support/OtherProgram.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

std::string drawn(int seed) {
    const auto tool = test::sourceDir() / "tests" / "house" / "sample_words.py";
    auto [output, code] = test::outputOf("python3 -B '" + tool.string() + "' --seed " + std::to_string(seed));
    EXPECT_EQ(code, 0) << output;
    return output;
}

TEST(SampleWords, AreSixtyOfEveryKindAndTheSameForTheSameSeed) {
    const auto sample = drawn(7);
    EXPECT_EQ(sample, drawn(7));
    EXPECT_NE(sample, drawn(8));
    static const std::regex piece(R"(^(\d+)\. \[(\w+)\] .+)");
    std::map<std::string, int> kinds;
    std::istringstream lines(sample);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        std::smatch found;
        const auto beginning = line.substr(0, 100);  // the regular expression recurses once per character
        ASSERT_TRUE(std::regex_match(beginning, found, piece)) << line;
        EXPECT_EQ(found[1].str(), std::to_string(++number));
        ++kinds[found[2]];
    }
    for (const char* kind : {"comment", "message", "heading", "change"}) EXPECT_EQ(kinds[kind], 12) << kind;
    EXPECT_LE(kinds["commit"], 12) << "as many as the history has";
    EXPECT_LE(kinds.size(), 5U);
}

}  // namespace
}  // namespace tacto
