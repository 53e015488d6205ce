#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/scripting/engine/ProtocolLibrary.h"
#include "tests/support/Support.h"

namespace tacto {
namespace {

class Library : public ::testing::Test {
protected:
    Library() {
        std::filesystem::create_directories(folder_.path() / "shipped");
        for (const char* name : {"live.js", "separability.js"})
            std::filesystem::copy_file(test::sourceDir() / "resources/protocols" / name,
                                       folder_.path() / "shipped" / name);
        folder_.write("user/separability.js", "// ours");
        folder_.write("user/touch.js", "// touch");
        folder_.write("user/notes.txt", "no script");
    }
    test::ScratchDir folder_;
    ProtocolLibrary library_{folder_.path() / "shipped", folder_.path() / "user"};
};

TEST_F(Library, ListsShippedAndOwnScriptsOnce) {
    std::vector<std::string> names;
    for (const auto& source : library_.list()) names.push_back(source.name);
    EXPECT_EQ(names, (std::vector<std::string>{"live", "separability", "touch"}));
}

TEST_F(Library, TheNameOfAShippedScriptIsNotTakenByAnother) {
    RecordProperty("hazard", "H10");
    EXPECT_TRUE(library_.find("separability").value().shipped);
    EXPECT_TRUE(library_.find("live").value().shipped);
    EXPECT_EQ(originOf(library_.find("live").value()), "shipped with the program");
    EXPECT_EQ(library_.find("live").value().sha256.size(), 64U);

    const auto ours = (folder_.path() / "user/separability.js").string();
    const auto refused = library_.refused();
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_EQ(refused[0].path, ours);
    EXPECT_EQ(refused[0].why,
              ours +
                  ": separability is the name of a protocol that comes with the program; another file name is "
                  "expected");
    EXPECT_EQ(library_.find(ours).error().message, refused[0].why) << "by its path as well";
    // A script cannot replace a shipped script that is missing in the program's folder.
    folder_.write("user/transitions.js", "// ours");
    EXPECT_EQ(library_.find("transitions").error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(library_.refused().size(), 2U);
    // Nor can altered files in the program's folder, which the environment chooses.
    const auto changed = folder_.write("shipped/live.js", "// changed").string();
    for (const auto& by : {std::string("live"), changed}) {
        EXPECT_EQ(
            library_.find(by).error().message,
            changed + ": live is the name of a protocol that comes with the program; another file name is expected");
    }
    EXPECT_EQ(library_.refused().size(), 3U);
}

TEST_F(Library, FindsByPath) {
    EXPECT_EQ(library_.find((folder_.path() / "user/touch.js").string()).value().text, "// touch");
    EXPECT_TRUE(library_.find((folder_.path() / "shipped/separability.js").string()).value().shipped);
}

TEST_F(Library, NamesWhatIsNotThere) {
    EXPECT_EQ(library_.find("serability").error().message,
              "there is no protocol serability; there are live, separability, touch");
    EXPECT_EQ(library_.find("/no/such.js").error().message, "there is no script /no/such.js");
    EXPECT_EQ(library_.find("../user/touch").error().code, ErrorCode::NotFound);
}

TEST_F(Library, RefusesWhatIsNoText) {
    folder_.write("user/bad.js", std::string("a\xFF\xFE", 3));
    folder_.write("user/large.js", std::string(1'000'001, ' '));
    EXPECT_EQ(library_.find("bad").error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(library_.refused().size(), 3U) << "and the one whose name is taken";
    EXPECT_EQ(library_.find("large").error().code, ErrorCode::InvalidArgument);
}

TEST(Resources, AreTheSourceTreesInABuildAndTheEnvironmentsWhereSet) {
    unsetenv("TACTOSCOPE_RESOURCES");
    EXPECT_TRUE(std::filesystem::equivalent(resourcesFolder().value(), test::sourceDir() / "resources"));
    test::ScratchDir folder;
    folder.write("protocols/x.js", "");
    setenv("TACTOSCOPE_RESOURCES", folder.path().c_str(), 1);
    EXPECT_EQ(resourcesFolder().value(), folder.path());
    setenv("TACTOSCOPE_RESOURCES", "/no/such/folder", 1);
    EXPECT_EQ(resourcesFolder().error().code, ErrorCode::NotFound);
    EXPECT_THAT(ProtocolLibrary().find("separability").error().message,
                testing::StartsWith("there is no protocol separability: TACTOSCOPE_RESOURCES is /no/such/folder"));
    unsetenv("TACTOSCOPE_RESOURCES");
}

TEST(Resources, OfTheUserFollowTheXdgFolders) {
    setenv("XDG_DATA_HOME", "/data/home", 1);
    EXPECT_EQ(userProtocolsFolder(), "/data/home/tactoscope/protocols");
    unsetenv("XDG_DATA_HOME");
    setenv("HOME", "/home/someone", 1);
    EXPECT_EQ(userProtocolsFolder(), "/home/someone/.local/share/tactoscope/protocols");
}

}  // namespace
}  // namespace tacto
