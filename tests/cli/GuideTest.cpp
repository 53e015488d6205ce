// The guide and the README keep their promises: each command in them does what the text next to it says.
#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "tests/cli/RunCli.h"
#include "tests/support/OtherProgram.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

const auto kGuide = sourceDir() / "resources" / "help" / "guide";

struct Promise {
    std::string command;
    int code = 0;  ///< expected exit code: stated in the comment after the command, else 0
};

/// Returns the commands in a page's fenced blocks.
std::vector<Promise> promisesOf(std::istream& page) {
    std::vector<Promise> promises;
    bool fenced = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```")) {
            fenced = !fenced;
        } else if (fenced && !line.empty()) {
            constexpr std::string_view kCode = "exit code ";
            const auto comment = line.find(" #");
            const auto code = comment == std::string::npos ? comment : line.find(kCode, comment);
            promises.push_back({line, code == std::string::npos ? 0 : line.at(code + kCode.size()) - '0'});
        }
    }
    return promises;
}

std::string forTheShell(const std::string& word) {
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// A reader's terminal: an empty folder with the resources of the source tree, and the program under its name.
class Terminal {
public:
    Terminal() { fs::create_directory_symlink(sourceDir() / "resources", desk_.path() / "resources"); }

    /// Runs a line in the shell; returns its output and exit code.
    [[nodiscard]] std::pair<std::string, int> run(const std::string& line) const {
        const auto program = fs::path(TACTO_CLI).parent_path().string();
        const auto script = "PATH=" + forTheShell(program) + ":$PATH; cd " + forTheShell(desk_.path().string()) +
                            " || exit 99\n{ " + line + "\n} </dev/null";
        std::string command = "exec env -i";
        for (const auto& word : desk_.environment()) command += ' ' + forTheShell(word);
        return outputOf(command + " sh -c " + forTheShell(script));
    }

private:
    Desk desk_;
};

class Guide : public testing::TestWithParam<std::string> {};

TEST_P(Guide, EachCommandDoesWhatItSays) {
    std::ifstream page(kGuide / (GetParam() + ".md"));
    const Terminal terminal;
    for (const auto& promise : promisesOf(page)) {
        const auto [output, code] = terminal.run(promise.command);
        ASSERT_EQ(code, promise.code) << promise.command << '\n' << output;
    }
}

std::vector<std::string> pagesOfTheGuide() {
    std::vector<std::string> pages;
    for (const auto& entry : fs::directory_iterator(kGuide)) pages.push_back(entry.path().stem());
    std::ranges::sort(pages);
    return pages;
}

INSTANTIATE_TEST_SUITE_P(Pages, Guide, testing::ValuesIn(pagesOfTheGuide()), [](const auto& page) {
    auto name = page.param;
    std::ranges::replace(name, '-', '_');
    return name;
});

/// ./dev cli is the program; ./dev run and ./dev test are the commands that build and test it.
TEST(Readme, EachCommandDoesWhatItSays) {
    std::ifstream page(sourceDir() / "README.md");
    const Terminal terminal;
    std::size_t ran = 0;
    for (auto promise : promisesOf(page)) {
        constexpr std::string_view kCli = "./dev cli ";
        if (!promise.command.starts_with(kCli)) continue;
        promise.command.replace(0, kCli.size(), "tactoscope-cli ");
        const auto [output, code] = terminal.run(promise.command);
        EXPECT_EQ(code, promise.code) << promise.command << '\n' << output;
        ++ran;
    }
    EXPECT_EQ(ran, 3U);
}

TEST(Readme, CommandsAreFoundInPages) {
    std::istringstream page("text\n```\na b   # why: exit code 4\nc 'exit code 3'\n```\nd\n```\ne\n```\n");
    const auto found = promisesOf(page);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].code, 4);
    EXPECT_EQ(found[1].code, 0);
    EXPECT_EQ(found[2].command, "e");
    const Terminal terminal;
    EXPECT_EQ(terminal.run("echo 'it'\"'\"'s' && false   # a comment").second, 1);
    EXPECT_EQ(terminal.run("ls resources | grep -c help").first, "1\n");
}

}  // namespace
}  // namespace tacto::test
