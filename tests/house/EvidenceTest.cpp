// Every test named in pilot-evidence.md exists, and each section there that gives evidence names some. Every hazard of
// safety.md has tests, and tests record no other hazards.
#include <fstream>
#include <gmock/gmock.h>
#include <regex>
#include <set>

#include "core/base/Csv.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

/// Returns all names of this form in a text, with their two groups joined by a dot.
std::set<std::string> namesIn(const std::string& text, const std::regex& form) {
    std::set<std::string> names;
    for (std::sregex_iterator at(text.begin(), text.end(), form), end; at != end; ++at)
        names.insert((*at)[1].str() + "." + (*at)[2].str());
    return names;
}

std::set<std::string> declaredIn(const std::string& source) {
    static const std::regex declaration(R"(\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))");
    return namesIn(source, declaration);
}

TEST(Evidence, NamesTestsThatExistForEachSection) {
    std::set<std::string> declared;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::sourceDir() / "tests"))
        if (entry.path().extension() == ".cpp") declared.merge(declaredIn(readTextFile(entry.path()).value()));
    ASSERT_GT(declared.size(), 1000U);
    std::ifstream lines(test::sourceDir() / "resources/design/pilot-evidence.md");
    static const std::regex quoted("`([A-Za-z0-9]\\w*)\\.(\\w+)`");
    std::set<int> sections;
    for (std::string line; std::getline(lines, line);) {
        if (line.size() < 3 || !line.starts_with("| ") || line[2] < '0' || line[2] > '9') continue;
        SCOPED_TRACE(line.substr(0, 80));
        sections.insert(std::stoi(line.substr(2)));
        const auto names = namesIn(line, quoted);
        EXPECT_FALSE(names.empty());
        for (const auto& name : names) EXPECT_TRUE(declared.contains(name)) << name << " is not there";
    }
    EXPECT_THAT(sections, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
}

TEST(Hazards, OfSafetyEachHasTestsAndNoTestNamesAnother) {
    static const std::regex row(R"(\n\| (H\d+)( )\| )"), recorded(R"re(RecordProperty\("hazard",\s*"(\w+)()"\))re");
    const auto known = namesIn(readTextFile(test::sourceDir() / "resources/design/safety.md").value(), row);
    EXPECT_GE(known.size(), 12U);
    std::set<std::string> tested;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::sourceDir() / "tests")) {
        const auto ending = entry.path().extension();
        if (ending == ".cpp" || ending == ".h") tested.merge(namesIn(readTextFile(entry.path()).value(), recorded));
    }
    const auto bare = [](const std::set<std::string>& names) {
        std::set<std::string> ids;
        for (const auto& name : names) ids.insert(name.substr(0, name.find('.')));
        return ids;
    };
    EXPECT_EQ(bare(tested), bare(known));
}

TEST(Evidence, DeclarationsAreFound) {
    EXPECT_THAT(declaredIn("TEST_F(Desk,\n       ACode) {\nTEST(One, Two)\nTEST_P(Suite, OfMany) {}"),
                testing::ElementsAre("Desk.ACode", "One.Two", "Suite.OfMany"));
    EXPECT_TRUE(declaredIn("INSTANTIATE_TEST_SUITE_P(Of, Suite, Values(1));").empty());
}

}  // namespace
}  // namespace tacto
