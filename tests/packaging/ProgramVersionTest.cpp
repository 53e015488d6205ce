// resources/packaging/ProgramVersion.cmake on trees that git knows, and on some that it does not: the oracle is git.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/OtherProgram.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

/// A tree with one commit, made at half past midnight of 2026-11-20 in India: in UTC it was the 19th.
class Version : public testing::Test {
protected:
    Version() {
        fs::create_directories(tree() / "resources/packaging");
        fs::create_directories(tree() / "app");
        for (const auto* file : {"ProgramVersion.cmake", "ProgramVersion.cpp.in"})
            fs::copy(sourceDir() / "resources/packaging" / file, tree() / "resources/packaging" / file);
        write("app/main.cpp", "int main() {}\n");
    }
    fs::path tree() const { return scratch_.path() / "tree"; }
    void write(const fs::path& file, const std::string& text) const { std::ofstream(tree() / file) << text; }
    std::string git(const std::string& words) const {
        const auto [said, code] = outputOf(
            "cd '" + tree().string() +
            "' && GIT_COMMITTER_DATE='2026-11-20T00:30:00+05:30' git -c user.name=N -c user.email=e@x " + words);
        EXPECT_EQ(code, 0) << said;
        return said.substr(0, said.find('\n'));
    }
    void commit() const {
        git("init -q");
        git("add .");
        git("commit -q -m First");
    }
    /// Returns the version of release 9.8.7.
    std::string version() const {
        const auto script = (tree() / "resources/packaging/ProgramVersion.cmake").string();
        const auto said = outputOf("TZ=America/Los_Angeles cmake -D release=9.8.7 -P '" + script + "'").first;
        return said.substr(0, said.find('\n'));
    }
    std::string between(const std::string& ending = "") const {
        return "9.8.7+git20261119." + git("rev-parse HEAD").substr(0, 7) + ending;
    }

private:
    ScratchDir scratch_;
};

TEST_F(Version, BetweenReleasesIsThatOfTheCommitAndItsDay) {
    commit();
    EXPECT_EQ(version(), between());
    write("README.md", "What is in no commit and not built\n");
    EXPECT_EQ(version(), between());
}

TEST_F(Version, OfAReleaseIsItsTag) {
    commit();
    git("tag v9.8.6");
    EXPECT_EQ(version(), between());
    git("tag v9.8.7");
    EXPECT_EQ(version(), "9.8.7");
    write("app/main.cpp", "int main() { return 1; }\n");
    EXPECT_EQ(version(), between(".dirty"));
}

TEST_F(Version, SaysThatSomethingWasChanged) {
    commit();
    write("app/main.cpp", "int main() { return 1; }\n");
    EXPECT_EQ(version(), between(".dirty"));
    git("checkout -q app/main.cpp");
    EXPECT_EQ(version(), between());
    write("app/Another.cpp", "");
    EXPECT_EQ(version(), between(".dirty"));
}

TEST_F(Version, WithoutGitIsTheReleases) {
    EXPECT_EQ(version(), "9.8.7");
    // Unpacked in a repository of something else.
    git("init -q ..");
    git("add .");
    git("commit -q -m 'Not ours'");
    EXPECT_EQ(version(), "9.8.7");
}

TEST_F(Version, IsWrittenAnewOnlyWhereItChanged) {
    commit();
    const auto out = tree() / "ProgramVersion.cpp";
    const auto write = [&](const std::string& libraries) {
        const auto [said, code] = outputOf("cmake -D release=9.8.7 -D 'compiler=Clang 1' -D 'libraries=" + libraries +
                                           "' -D 'out=" + out.string() + "' -P '" +
                                           (tree() / "resources/packaging/ProgramVersion.cmake").string() + "'");
        EXPECT_EQ(code, 0) << said;
        std::ifstream in(out);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const auto text = write("Qt=6.4.2;fmt=9.1");
    EXPECT_THAT(text, testing::HasSubstr("{\"" + between() + "\", \"" + git("rev-parse HEAD") +
                                         "\", \"2026-11-19\", false, \"Clang 1\""));
    EXPECT_THAT(text, testing::HasSubstr("Library{\"Qt\", \"6.4.2\"}, ProgramVersion::Library{\"fmt\", \"9.1\"}"));
    const auto before = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(out, before);
    write("Qt=6.4.2;fmt=9.1");
    EXPECT_EQ(fs::last_write_time(out), before);
    write("Qt=6.4.3;fmt=9.1");
    EXPECT_NE(fs::last_write_time(out), before);
}

TEST(BuiltVersion, IsTheSameInWordsAndInJson) {
    const std::string cli = TACTO_BUILD "/bin/tactoscope-cli";
    const auto json = nlohmann::json::parse(outputOf(cli + " --version --json").first);
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    EXPECT_THAT(
        keys, testing::UnorderedElementsAre("version", "commit", "dirty", "date", "compiler", "libraries", "licence"));
    const auto words = outputOf(cli + " --version").first;
    for (const auto* key : {"version", "commit", "compiler", "licence"})
        EXPECT_THAT(words, testing::HasSubstr(json[key].get<std::string>())) << key;
    for (const auto& [name, version] : json["libraries"].items()) {
        EXPECT_THAT(words, testing::HasSubstr(name + " " + version.get<std::string>()));
        EXPECT_NE(version, "") << name;
    }
    for (const auto* name : {"Qt", "QCustomPlot", "QScintilla", "EDFlib", "zxcvbn"})
        EXPECT_TRUE(json["libraries"].contains(name)) << name;
    // What the package manager says of them.
    for (const auto& [name, package] :
         {std::pair("QCustomPlot", "libqcustomplot-dev"), std::pair("QScintilla", "libqscintilla2-qt6-dev"),
          std::pair("EDFlib", "libedf-dev")}) {
        const auto [packaged, code] = outputOf(std::string("dpkg-query -W -f '${Version}' ") + package);
        if (code == 0) EXPECT_THAT(packaged, testing::StartsWith(json["libraries"][name].get<std::string>())) << name;
    }
    for (const auto* wrong : {"--version --xml", "--version --json --json", "--version 2"})
        EXPECT_EQ(outputOf(cli + " " + wrong).second, 2) << wrong;
}

}  // namespace
}  // namespace tacto::test
