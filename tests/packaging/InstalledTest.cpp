// What `cmake --install` makes, moved to another place: programs and resources find each other there, and what a
// desktop and Debian expect is there.
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/OtherProgram.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Installed : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<ScratchDir>();
        const auto built = folder_->path() / "built";
        const auto [said, code] =
            outputOf("umask 022; cmake --install " TACTO_BUILD " --strip --prefix " + built.string());
        ASSERT_EQ(code, 0) << said;
        fs::create_directory(folder_->path() / "a folder");
        fs::rename(built, root());
    }
    static void TearDownTestSuite() { folder_.reset(); }

    static fs::path root() { return folder_->path() / "a folder" / "moved"; }
    static std::string text(const fs::path& file) {
        std::ifstream in(root() / file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// Runs an installed program with a home of its own and without a display.
    static std::pair<std::string, int> run(const std::string& program, const std::string& arguments) {
        const auto home = folder_->path() / "home";
        fs::create_directories(home);
        return outputOf("cd '" + home.string() + "' && env -u TACTOSCOPE_RESOURCES -u XDG_DATA_HOME -u DISPLAY HOME='" +
                        home.string() + "' '" + (root() / "bin" / program).string() + "' " + arguments);
    }
    static std::string version() {
        const auto said = run("tactoscope-cli", "--version").first;
        return said.substr(0, said.find('\n')).substr(std::string("tactoscope-cli ").size());
    }
    static bool isThere(const char* program) { return outputOf("command -v " + std::string(program)).second == 0; }

private:
    static inline std::unique_ptr<ScratchDir> folder_;
};

TEST_F(Installed, AProtocolRunsToItsReport) {
    const auto [said, code] = run("tactoscope-cli", "run separability --device sim: --out out --json");
    EXPECT_EQ(code, 0) << said;
    std::set<std::string> made;
    for (const auto& each : fs::directory_iterator(root().parent_path().parent_path() / "home/out")) {
        made.insert(each.path().extension());
        if (each.path().extension() == ".html")
            EXPECT_THAT(text(each.path()), HasSubstr("Tactoscope " + version())) << "as in the session";
    }
    EXPECT_THAT(made, testing::IsSupersetOf({".html", ".pdf", ".tacto"})) << said;
}

TEST_F(Installed, ResourcesAreThoseBesideThePrograms) {
    const auto protocols = root() / "share/tactoscope/protocols";
    fs::copy(protocols / "separability.js", protocols / "only-here.js");
    EXPECT_THAT(run("tactoscope-cli", "protocols --json").first, HasSubstr("\"only-here\""));
    fs::remove(protocols / "only-here.js");
}

TEST_F(Installed, EveryProgramSaysItsVersionOrWhatItIs) {
    EXPECT_EQ(run("tactoscope", "--version").first, "tactoscope " + version() + "\n");
    for (const auto* inner : {"tactoscope-script", "tactoscope-watchdog"})
        EXPECT_THAT(run(inner, "--help").first, HasSubstr("is started by Tactoscope")) << inner;
    EXPECT_THAT(outputOf("zcat '" + (root() / "share/doc/tactoscope/changelog.gz").string() + "'").first,
                testing::StartsWith("tactoscope (" + version() + ") unstable; urgency=medium\n\n  * "));
}

TEST_F(Installed, ProgramsAreStrippedAndCanBeLoadedAnywhere) {
    std::size_t programs = 0;
    for (const auto& each : fs::directory_iterator(root() / "bin")) {
        if (each.path().filename() == "tactoscope-install-rules") continue;  // a script
        const auto header = outputOf("readelf --wide --file-header --sections '" + each.path().string() + "'").first;
        EXPECT_THAT(header, HasSubstr("DYN (Position-Independent Executable file)")) << each.path();
        EXPECT_THAT(header, testing::Not(HasSubstr(".symtab"))) << each.path();
        ++programs;
    }
    EXPECT_EQ(programs, 5U);
}

TEST_F(Installed, NoProgramKnowsInWhichFolderItWasBuilt) {
    for (const auto& each : fs::directory_iterator(root() / "bin"))
        for (const auto& folder : {sourceDir().string(), std::string(TACTO_BUILD)})
            EXPECT_EQ(text(each.path()).find(folder + "/"), std::string::npos) << each.path() << " names " << folder;
}

TEST_F(Installed, RulesForAnotherDeviceOrGroupComeFromThoseInstalled) {
    const auto target = root().parent_path() / "rules";
    const auto [said, code] =
        run("tactoscope-install-rules", "--device 1234:ABCD --group plugdev '" + target.string() + "'");
    EXPECT_EQ(code, 0) << said;
    const auto shipped = text("lib/udev/rules.d/70-tactoscope.rules"), made = text(target / "70-tactoscope.rules");
    EXPECT_EQ(std::regex_replace(made, std::regex(", GROUP=\"plugdev\", MODE=\"0660\""), ""), shipped);
    EXPECT_THAT(text(target / "71-tactoscope-devices.rules"), HasSubstr("ATTR{idProduct}==\"abcd\""));
    EXPECT_EQ(run("tactoscope-install-rules", "--seat 1").second, 2);
}

TEST_F(Installed, ADesktopAcceptsWhatItIsTold) {
    const std::string id = "io.github.tactoscope.Tactoscope";
    const auto entry = text("share/applications/" + id + ".desktop");
    EXPECT_THAT(entry, HasSubstr("\nExec=tactoscope %f\n"));
    EXPECT_THAT(entry, HasSubstr("\nIcon=" + id + "\n"));
    EXPECT_THAT(text("share/icons/hicolor/scalable/apps/" + id + ".svg"), HasSubstr("<svg"));
    EXPECT_THAT(text("share/metainfo/" + id + ".metainfo.xml"), HasSubstr("desktop-id\">" + id + ".desktop<"));
    EXPECT_EQ(text("lib/udev/rules.d/70-tactoscope.rules"), text(sourceDir() / "resources/udev/70-tactoscope.rules"));
    if (isThere("desktop-file-validate")) {
        const auto said =
            outputOf("desktop-file-validate '" + (root() / "share/applications").string() + "/" + id + ".desktop'");
        EXPECT_EQ(said.first, "");
        EXPECT_EQ(said.second, 0);
    }
    if (isThere("appstreamcli")) {
        const auto said = outputOf("appstreamcli validate --no-net '" + (root() / "share/metainfo").string() + "/" +
                                   id + ".metainfo.xml'");
        EXPECT_THAT(said.first, HasSubstr("Validation ")) << "it read the file";
        std::istringstream lines(said.first);
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("E:") || line.starts_with("W:"))
                EXPECT_THAT(line, HasSubstr("url-homepage-missing"))
                    << "which Debian 13 warns of; there is no such page";
    }
}

TEST_F(Installed, TheGuideLiesWhereDocumentsDo) {
    EXPECT_THAT(text("share/doc/tactoscope/guide/index.html"), HasSubstr("<html"));
    EXPECT_THAT(text("share/doc/tactoscope/copyright"), HasSubstr("License: GPL-3.0-or-later"));
}

TEST_F(Installed, EachLinkOfTheGuideLeadsToAFileAndEachPageIsMarkedInTheContents) {
    const auto guide = root() / "share/doc/tactoscope/guide";
    const std::regex link(R"re((?:href|src)="([^"#]*)(?:#([^"]*))?")re");
    std::size_t links = 0;
    for (const auto& entry : fs::directory_iterator(guide)) {
        if (entry.path().extension() != ".html") continue;
        const auto page = text(entry.path());
        const auto name = entry.path().filename().string();
        for (std::sregex_iterator found(page.begin(), page.end(), link), end; found != end; ++found, ++links) {
            const auto target = (*found)[1].str(), part = (*found)[2].str();
            if (target.find("://") != std::string::npos) continue;
            ASSERT_TRUE(fs::exists(guide / target)) << name << " leads to " << target;
            if (!part.empty())
                EXPECT_THAT(text(target.empty() ? entry.path() : guide / target), HasSubstr("id=\"" + part + '"'))
                    << name << " leads to " << target << '#' << part;
        }
        EXPECT_THAT(page, HasSubstr("href=\"" + name + "\" aria-current=\"page\"")) << name;
    }
    EXPECT_GT(links, 100U);
}

TEST_F(Installed, EveryProgramHasAManPage) {
    if (!isThere("help2man")) GTEST_SKIP() << "help2man is not installed: no man pages";
    for (const auto& each : fs::directory_iterator(root() / "bin")) {
        const auto name = each.path().filename().string();
        const auto page = outputOf("zcat '" + (root() / "share/man/man1" / (name + ".1.gz")).string() + "'").first;
        EXPECT_THAT(page, HasSubstr("\n.SH NAME\n")) << name;
        EXPECT_THAT(page, testing::Not(HasSubstr("\n.PP\n["))) << name;
    }
    // Each command of the help is a part of the page, with its options.
    const auto page = outputOf("zcat '" + (root() / "share/man/man1/tactoscope-cli.1.gz").string() + "'").first;
    const auto help = run("tactoscope-cli", "help").first;
    static const std::regex command("\n  tactoscope-cli ([a-z-]+)"), hyphen("-");
    std::size_t commands = 0;
    for (std::sregex_iterator each(help.begin(), help.end(), command), end; each != end; ++each, ++commands)
        EXPECT_THAT(page, HasSubstr("\n.SS " + std::regex_replace(each->str(1), hyphen, "\\-") + "\n"));
    EXPECT_GT(commands, 15U);
    EXPECT_THAT(page, HasSubstr("\\fB\\-\\-certificate\\-details\\fR"));
}

TEST_F(Installed, EverybodyMayReadItAndNobodyElseChangeIt) {
    std::size_t files = 0;
    for (const auto& each : fs::recursive_directory_iterator(root())) {
        const auto mode = static_cast<unsigned>(each.status().permissions()) & 07777U;
        const bool runs = each.is_directory() || each.path().parent_path().filename() == "bin";
        EXPECT_EQ(mode, runs ? 0755U : 0644U) << each.path();
        ++files;
    }
    EXPECT_GT(files, 80U);
}

}  // namespace
}  // namespace tacto::test
