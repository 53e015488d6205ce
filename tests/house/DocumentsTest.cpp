// Every document and section named in a comment exists; every path named in a document exists; every header says which
// threads may call it.
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/Support.h"

namespace tacto {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Returns all files at the top of the tree and below these folders, except files made by a build.
std::vector<fs::path> filesBelow(std::initializer_list<const char*> folders) {
    std::vector<fs::path> files;
    const auto add = [&](const fs::directory_entry& entry) {
        if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), test::sourceDir()));
    };
    for (const auto& entry : fs::directory_iterator(test::sourceDir())) add(entry);
    for (const char* folder : folders)
        for (const auto& entry : fs::recursive_directory_iterator(test::sourceDir() / folder)) add(entry);
    return files;
}

/// Returns what can be referred to in a document: headings; "7" for "## 7. Exposure"; "2.6" for the sixth item in
/// section 2; "H3" for a row of a table.
std::set<std::string> sectionsOf(const std::string& document) {
    static const std::regex heading(R"(^#+ (?:(\d+)\. )?(.*)$)"), item(R"(^(\d+)\. .*$)"), row(R"(^\| (H\d+) \|.*$)");
    std::set<std::string> sections;
    std::string current;
    std::istringstream lines(document);
    for (std::string line; std::getline(lines, line);) {
        const auto beginning = line.substr(0, 100);  // the regular expression recurses once per character
        std::smatch found;
        if (std::regex_match(beginning, found, heading)) {
            current = found[1];
            sections.insert({current, found[2]});
        } else if (std::regex_match(beginning, found, item) && !current.empty()) {
            sections.insert(current + "." + found[1].str());
        } else if (std::regex_match(beginning, found, row)) {
            sections.insert(found[1]);
        }
    }
    return sections;
}

struct Mention {
    std::string document;               ///< "science.md", "resources/massagers/README.md"
    std::vector<std::string> sections;  ///< "7", "2.6", "H3", "The gate"
    bool operator==(const Mention&) const = default;
};
void PrintTo(const Mention& mention, std::ostream* out) {
    *out << mention.document << " (" << fmt::format("{}", fmt::join(mention.sections, ", ")) << ")";
}

/// Returns the documents named in a text with the sections named after each, across the ends of comment lines.
std::vector<Mention> mentionsIn(const std::string& text) {
    static const std::regex lineEnd(R"(\n[ \t]*(?://+!?<?|\*|#|")?[ \t]*)");
    static const std::regex name(R"re(([\w./-]*[\w-]\.md)\b)re"
                                 R"re((?:,? (?:sections? ((?:\d+(?:\.\d+)?(?: \([^)]*\))?(?:, | and | to )?)+)|)re"
                                 R"re((?:hazard )?(H\d+)|\\?"([^"\\]+)\\?"))?)re");
    static const std::regex number(R"(\d+(?:\.\d+)?)");
    std::vector<Mention> mentions;
    if (text.find(".md") == std::string::npos) return mentions;
    const auto joined = std::regex_replace(text, lineEnd, " ");
    for (std::sregex_iterator i(joined.begin(), joined.end(), name), end; i != end; ++i) {
        Mention mention{(*i)[1], {}};
        const auto numbers = (*i)[2].str();
        for (std::sregex_iterator n(numbers.begin(), numbers.end(), number); n != end; ++n)
            mention.sections.push_back(n->str());
        for (const std::size_t group : {3U, 4U})
            if ((*i)[group].matched) mention.sections.push_back((*i)[group]);
        mentions.push_back(std::move(mention));
    }
    return mentions;
}

TEST(Documents, EveryOneThatIsNamedExistsWithItsSections) {
    const std::set<std::string> read{".h", ".cpp", ".c", ".in", ".js", ".json", ".md", ".py", ".txt", ""};
    const auto files = filesBelow({"app", "core", "drivers", "resources", "tests"});
    std::map<std::string, std::set<std::string>> documents;  // by path
    for (const auto& file : files)
        if (file.extension() == ".md") documents["/" + file.string()] = sectionsOf(contentOf(test::sourceDir() / file));
    std::size_t named = 0;
    for (const auto& file : files) {
        if (!read.contains(file.extension()) || file.filename() == "DocumentsTest.cpp") continue;
        for (const auto& mention : mentionsIn(contentOf(test::sourceDir() / file))) {
            ++named;
            const auto document = std::find_if(documents.begin(), documents.end(), [&](const auto& one) {
                return one.first.ends_with("/" + mention.document);
            });
            if (document == documents.end()) {
                ADD_FAILURE() << file << " names " << mention.document << ", which is not in the tree";
                continue;
            }
            for (const auto& section : mention.sections) {
                EXPECT_TRUE(document->second.contains(section))
                    << file << " names \"" << section << "\" of " << mention.document << ", which it does not have";
            }
        }
    }
    EXPECT_GT(named, 80U);
}

TEST(Documents, EveryPathInThemExists) {
    const std::regex path(R"((?:^|[\s(`])((?:app|core|drivers|resources|tests)/[\w./-]+))");
    std::size_t named = 0;
    for (const auto& file : filesBelow({"resources/design"})) {
        if (file.extension() != ".md" || file == "CHANGELOG.md") continue;
        const auto text = contentOf(test::sourceDir() / file);
        for (std::sregex_iterator i(text.begin(), text.end(), path), end; i != end; ++i) {
            ++named;
            auto given = (*i)[1].str();
            while (given.ends_with('.')) given.pop_back();
            EXPECT_TRUE(fs::exists(test::sourceDir() / given)) << file << " names " << given;
        }
    }
    EXPECT_GT(named, 50U);
}

TEST(Documents, LinksLeadToFiles) {
    const std::regex link(R"(\]\(([^)#]+)\))");
    std::set<fs::path> linked;
    for (const auto& file : filesBelow({"resources"})) {
        if (file.extension() != ".md") continue;
        const auto text = contentOf(test::sourceDir() / file);
        for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i) {
            if ((*i)[1].str().find("://") != std::string::npos) continue;
            const auto target = (file.parent_path() / (*i)[1].str()).lexically_normal();
            EXPECT_TRUE(fs::exists(test::sourceDir() / target)) << file << " links to " << target;
            linked.insert(target);
        }
    }
    for (const auto& file : filesBelow({"resources/help"})) {
        if (!file.has_parent_path()) continue;
        EXPECT_TRUE(linked.contains(file)) << file << " is linked from nowhere";
    }
}

TEST(Documents, TheNewestReleaseIsTheProgramsVersion) {
    const auto first = [](const char* file, const char* before) {
        const std::regex version(std::string(before) + R"((\d+\.\d+\.\d+))");
        const auto text = contentOf(test::sourceDir() / file);
        std::smatch found;
        return std::regex_search(text, found, version) ? found[1].str() : std::string(file) + " names none";
    };
    const auto built = first("CMakeLists.txt", "project\\(Tactoscope VERSION ");
    EXPECT_EQ(first("CHANGELOG.md", "\n## "), built);
    EXPECT_EQ(first("resources/desktop/io.github.tactoscope.Tactoscope.metainfo.xml", "<release version=\""), built);
}

TEST(Headers, SayWhichThreadMayCallThem) {
    std::size_t headers = 0;
    for (const auto& file : filesBelow({"app", "core", "drivers", "tests"})) {
        if (file.extension() != ".h") continue;
        ++headers;
        const auto text = contentOf(test::sourceDir() / file);
        const auto comment = text.substr(0, std::min(text.find("#pragma once"), text.find("#ifndef")));
        // Headers need not repeat what the README of their folder says.
        const auto folder = test::sourceDir() / file.parent_path() / "README.md";
        const auto said = fs::exists(folder) ? contentOf(folder) : std::string();
        EXPECT_THAT(comment + said, testing::ContainsRegex(R"((//| \*) Thread-safety: |Thread: )")) << file;
    }
    EXPECT_GT(headers, 300U);
}

TEST(Documents, AreFoundInComments) {
    using testing::ElementsAre;
    EXPECT_THAT(mentionsIn("// as science.md\n// sections 2.4 (hold and decay), 2.6 and 7.\n"),
                ElementsAre(Mention{"science.md", {"2.4", "2.6", "7"}}));
    EXPECT_THAT(mentionsIn("/// PROTOCOL.md, sections 3 to 5. (safety.md H5), safety.md, \"The gate\"\n"),
                ElementsAre(Mention{"PROTOCOL.md", {"3", "5"}}, Mention{"safety.md", {"H5"}},
                            Mention{"safety.md", {"The gate"}}));
    EXPECT_THAT(mentionsIn("# see resources/design/cli.md."), ElementsAre(Mention{"resources/design/cli.md", {}}));
    EXPECT_THAT(sectionsOf("# Title\n## 2. Roughness\n1. Band-pass\n## Hazards\n| H3 | open |\n"),
                testing::IsSupersetOf({"Title", "2", "2.1", "Hazards", "H3"}));
}

}  // namespace
}  // namespace tacto
