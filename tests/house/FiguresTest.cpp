// Reference values in tests are made by a script in tests/reference, and that script still produces them.
#include <algorithm>
#include <cctype>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/support/Figures.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

const fs::path kScripts = "tests/reference";

/// Returns the names of the files with reference values: "estimates", "trials".
std::set<std::string> figureFiles() {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(test::sourceDir() / kScripts))
        if (entry.path().extension() == ".json") names.insert(entry.path().stem());
    return names;
}

/// Returns the test sources by path.
std::map<fs::path, std::string> testSources() {
    std::map<fs::path, std::string> sources;
    for (const auto& entry : fs::recursive_directory_iterator(test::sourceDir() / "tests")) {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
        std::ifstream in(entry.path(), std::ios::binary);
        sources[fs::relative(entry.path(), test::sourceDir())] = {std::istreambuf_iterator<char>(in), {}};
    }
    return sources;
}

TEST(ReferenceFigures, EachFileNamesItsScriptWhichExists) {
    const auto names = figureFiles();
    EXPECT_GE(names.size(), 9U);
    for (const auto& name : names) {
        const auto script = (kScripts / (name + ".py")).string();
        const auto maker = test::figuresOf(name).at("made_by").get<std::string>();
        EXPECT_EQ(maker.substr(0, maker.find(',')), script) << name;
        EXPECT_TRUE(fs::is_regular_file(test::sourceDir() / script)) << script;
    }
}

TEST(ReferenceFigures, EachFileIsReadByATestAndNoneIsMissing) {
    static const std::regex reading(R"re(figuresOf\("(\w+)"\))re");
    std::set<std::string> read;
    for (const auto& [file, text] : testSources()) {
        if (file.filename() == "FiguresTest.cpp") continue;
        for (std::sregex_iterator i(text.begin(), text.end(), reading), end; i != end; ++i) read.insert((*i)[1]);
    }
    EXPECT_EQ(read, figureFiles());
}

/// Returns the numbers with more than seven digits in a text, which are not computed in the test.
std::vector<std::string> longNumbersIn(const std::string& text) {
    static const std::regex number(R"((?:^|[^\w.'])((?:\d|'\d)*\.\d+)(?![\d.]))");
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i) {
        const auto written = (*i)[1].str();
        std::string digits;
        std::copy_if(written.begin(), written.end(), std::back_inserter(digits),
                     [](char c) { return std::isdigit(c); });
        digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
        if (digits.size() > 7) found.push_back(written);
    }
    return found;
}

TEST(ReferenceFigures, AComparisonNamesNoNumberThatNeedsOne) {
    std::size_t comparisons = 0;
    for (const auto& [file, text] : testSources()) {
        for (const std::string_view comparison : {"_NEAR(", "_DOUBLE_EQ(", "_FLOAT_EQ("}) {
            for (auto at = text.find(comparison); at != std::string::npos; at = text.find(comparison, at + 1)) {
                ++comparisons;
                const auto statement = text.substr(at, text.find(");", at) - at);
                EXPECT_THAT(longNumbersIn(statement), testing::IsEmpty())
                    << file << ": " << statement << "\nA script in tests/reference makes such a number";
            }
        }
    }
    EXPECT_GT(comparisons, 800U);
    EXPECT_THAT(longNumbersIn("(x, 0.1640853626951472, 1e-12); (9.80665, 1'234.5678, 12.50000001)"),
                testing::ElementsAre("0.1640853626951472", "1'234.5678", "12.50000001"));
}

TEST(ReferenceFigures, AreWhatTheirScriptsMake) {
    for (const std::string python : {"/usr/bin/python3", "python3"}) {
        if (test::outputOf(python + " -c 'import numpy, scipy'").second != 0) continue;
        const auto check = test::sourceDir() / kScripts / "check.py";
        const auto [said, code] = test::outputOf(python + " '" + check.string() + "'");
        EXPECT_EQ(code, 0) << said;
        EXPECT_THAT(said, testing::HasSubstr("none disagrees"));
        return;
    }
    GTEST_SKIP() << "no python3 with numpy and scipy";
}

}  // namespace
}  // namespace tacto
