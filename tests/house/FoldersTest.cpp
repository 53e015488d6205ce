// The drawings of the source tree match the tree: architecture.md lists the folders of core, drivers and app, and
// CONTRIBUTING.md draws each above the folders that it uses.
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include "tests/house/Layers.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;
using Folders = std::map<std::string, std::set<std::string>>;  // folders inside each folder

std::string documentText(const fs::path& file) {
    std::ifstream in(test::sourceDir() / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> foldersIn(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(test::sourceDir() / folder))
        if (entry.is_directory()) names.insert(entry.path().filename());
    return names;
}

Folders foldersOfTheTree() {
    Folders tree;
    for (const char* top : {"core", "drivers", "app"}) tree[top] = foldersIn(top);
    return tree;
}

/// Reads a list of folders: "core/  what it is" begins a folder; "  usb/, system/  what they are" names folders inside.
Folders listedIn(const std::string& document) {
    static const std::regex top(R"(^(\w+)/ +.*$)"), within(R"(^  (\w+/(?:, \w+/)*) +.*$)"), name(R"(\w+)");
    Folders listed;
    std::string current;
    std::istringstream lines(document);
    for (std::string line; std::getline(lines, line);) {
        std::smatch found;
        if (std::regex_match(line, found, top)) {
            current = found[1];
        } else if (line.starts_with("```")) {
            current.clear();
        } else if (!current.empty() && std::regex_match(line, found, within)) {
            const auto names = found[1].str();
            for (std::sregex_iterator i(names.begin(), names.end(), name), end; i != end; ++i)
                listed[current].insert(i->str());
        }
    }
    return listed;
}

struct DrawnRow {
    std::string top;  ///< "core"
    std::vector<std::string> folders;
};

/// Reads rows of boxes: " core   │ safety   analysis: a library each │ what they are"; a first row names the folder.
std::vector<DrawnRow> rowsDrawnIn(const std::string& document) {
    static const std::string side = "│";
    static const std::regex box(R"((\w+)(?:: \w+(?: \w+)*)?)"), word(R"(\w+)");
    std::vector<DrawnRow> rows;
    std::string current;
    std::istringstream lines(document);
    for (std::string line; std::getline(lines, line);) {
        const auto left = line.find(side);
        if (left == std::string::npos) continue;
        const auto right = line.find(side, left + side.size());
        if (right == std::string::npos) continue;
        std::smatch found;
        const auto margin = line.substr(0, left), row = line.substr(left + side.size(), right - left - side.size());
        if (std::regex_search(margin, found, word)) current = found[0];
        auto& drawn = rows.emplace_back(DrawnRow{current, {}});
        for (std::sregex_iterator i(row.begin(), row.end(), box), end; i != end; ++i) drawn.folders.push_back((*i)[1]);
    }
    return rows;
}

Folders drawnIn(const std::string& document) {
    Folders drawn;
    for (const auto& row : rowsDrawnIn(document)) drawn[row.top].insert(row.folders.begin(), row.folders.end());
    return drawn;
}

/// Returns "core/safety" for a target with sources there or below; empty for other targets.
std::string folderOf(const test::Target& target) {
    for (const fs::path source : target.sources) {
        auto part = source.begin();
        const auto top = *part++;
        if (part != source.end() && std::next(part) != source.end()) return top / *part;
    }
    return {};
}

TEST(Folders, ArchitectureListsThem) {
    const auto document = documentText("resources/design/architecture.md");
    auto listed = listedIn(document);
    for (const auto& [top, folders] : foldersOfTheTree()) EXPECT_EQ(listed[top], folders) << top;
    for (const auto& each : foldersIn("core/analysis"))
        EXPECT_TRUE(fs::exists(test::sourceDir() / "core/analysis" / each / "README.md")) << each;
}

TEST(Folders, ContributingDrawsThem) { EXPECT_EQ(drawnIn(documentText("CONTRIBUTING.md")), foldersOfTheTree()); }

TEST(Folders, ContributingDrawsEachAboveWhatItStandsOn) {
    const auto rows = rowsDrawnIn(documentText("CONTRIBUTING.md"));
    std::map<std::string, std::size_t> rowOf;  // rows counted from the top
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (const auto& folder : rows[row].folders) rowOf[rows[row].top + '/' + folder] = row;
    const auto targets = test::targetsOfTheBuild();
    std::size_t links = 0;
    for (const auto& [name, target] : targets) {
        const auto above = folderOf(target);
        for (auto link : target.links) {
            const auto linked = targets.find(link);
            if (linked == targets.end() || above.empty()) continue;
            const auto below = folderOf(linked->second);
            if (below == above || below == "resources/firmware") continue;  // what boards compile, below all
            ++links;
            EXPECT_LT(rowOf[above], rowOf[below])
                << above << " links " << below << ", which is drawn beside or above it";
        }
    }
    EXPECT_GT(links, 80U);
}

TEST(Folders, AreReadFromTheirPictures) {
    EXPECT_EQ(listedIn("core/  Things.\n  base/   Text\n  a/, b/  both\ndrivers/   More.\n  usb/  x\n```\n  no/  y\n"),
              (Folders{{"core", {"base", "a", "b"}}, {"drivers", {"usb"}}}));
    EXPECT_EQ(drawnIn(" app  │ gui   cli │ programs\n      ├──┤\n      │ run │ opens\n"
                      " core │ analysis: a folder  dsp │\n"),
              (Folders{{"app", {"gui", "cli", "run"}}, {"core", {"analysis", "dsp"}}}));
}

}  // namespace
}  // namespace tacto
