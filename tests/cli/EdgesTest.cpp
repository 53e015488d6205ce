// The programs at the limits of the system: file names, missing folders, a full disk, a user without a home, a window
// without a display.
#include <algorithm>
#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <random>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/cli/Shape.h"
#include "tests/support/OtherProgram.h"

namespace tacto::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string pulses() {
    std::string text = "time_s,voltage_v\n";
    // Contains noise, which no format can compress well.
    for (int i = 0; i < 1000; ++i)
        text += fmt::format("{:.5f},{:.4f}\n", i * 1e-5, i / 50 % 2 * 5 + i * 7919 % 1000 * 1e-4);
    return text;
}

/// Quotes the word for a shell.
std::string quoted(const std::string& word) { return "'" + word + "'"; }

TEST(Edges, ACaptureIsWrittenUnderEveryNameThatTheFileSystemAllows) {
    const Desk desk;
    const auto in = desk.write("in.csv", pulses());
    std::mt19937 random(20261129);
    std::vector<std::size_t> lengths{5, 240, 245, 249, 250, 251, 254, 255};
    for (int k = 0; k < 12; ++k) lengths.push_back(5 + random() % 251);
    for (const auto length : lengths) {
        for (const std::string ending : {".csv", ".wav", ".sr"}) {
            const std::string letters[] = {"x", "é", "語", "😀", " ", "'", "-", ";"};
            std::string name = "x";
            while (name.size() + ending.size() < length) {
                const auto& letter = letters[random() % (length % 2 == 0 ? 5 : 8)];
                name += name.size() + letter.size() + ending.size() <= length ? letter : "y";
            }
            name += ending;
            const auto written = desk.run({"convert", in, "--out", name});
            ASSERT_EQ(written.code, 0) << name.size() << ": " << written.err;
            EXPECT_EQ(desk.run({"measure", name}).code, 0) << name;
            std::filesystem::remove(desk.at(name));
        }
    }
    EXPECT_EQ(desk.files().size(), 1U) << "nothing is left beside them";
}

TEST(Edges, WhatCannotBeWrittenIsNamedAsItWasAskedForWithTheSystemsReason) {
    RecordProperty("hazard", "H8");
    const Desk desk;
    const auto in = desk.write("in.csv", pulses());
    std::filesystem::create_directory(desk.at("folder.csv"));
    std::mt19937 random(20261129);
    for (const std::string ending : {".csv", ".wav", ".sr"}) {
        std::string folder;
        for (int k = 0; k < 8; ++k) folder += static_cast<char>('a' + random() % 26);
        const std::pair<std::string, std::string> refused[] = {
            {folder + "/out" + ending, "No such file or directory"},
            {"in.csv/out" + ending, "Not a directory"},
            {std::string(256 - ending.size(), 'x') + ending, "File name too long"}};
        for (const auto& [name, reason] : refused) {
            const auto ran = desk.run({"convert", in, "--out", name});
            EXPECT_EQ(ran.code, 3);
            EXPECT_EQ(ran.err, "tactoscope-cli: " + name + " could not be written: " + reason + "\n");
        }
        // A full disk must not damage an existing file.
        desk.write("old" + ending, "the earlier file");
        const auto [said, code] = outputOf(fmt::format("cd {} && ulimit -f 1 && {} convert in.csv --out old{}",
                                                       quoted(desk.path().string()), TACTO_CLI, ending));
        EXPECT_EQ(code, 3) << said;
        EXPECT_EQ(said, "tactoscope-cli: old" + ending + " could not be written: File too large\n");
        EXPECT_EQ(contentOf(desk.at("old" + ending)), "the earlier file");
    }
    EXPECT_EQ(desk.run({"convert", in, "--out", "folder.csv"}).err,
              "tactoscope-cli: folder.csv could not be written: Is a directory\n");
    EXPECT_EQ(desk.files().size(), 4U) << "nothing is left beside them";
}

TEST(Edges, ASessionBelowALongPathSaysTheReason) {
    const Desk desk;
    std::string folder = desk.path().string();
    while (folder.size() < 520) folder += "/" + std::string(40, 'd');
    const auto ran = desk.run({"run", "separability", "--device", "sim:", "--out", folder});
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, HasSubstr("cannot be made: its path has "));
    EXPECT_THAT(ran.err, HasSubstr("bytes; at most "));
}

TEST(Edges, ANameThatIsNotUtf8IsNamedWithItsBytes) {
    const Desk desk;
    const std::string name = "caf\xE9.csv";
    desk.write(name, pulses());
    for (const Words& words : {Words{"measure", name}, Words{"convert", name, "--out", "out.csv"},
                               Words{"convert", "in.csv", "--out", name}, Words{"report", name, "--out", "r.pdf"}}) {
        const auto ran = desk.run(words);
        EXPECT_EQ(ran.code, 3);
        EXPECT_THAT(ran.err, HasSubstr("the argument \"caf\\xe9.csv\" is not UTF-8"));
        EXPECT_EQ(std::ranges::count(ran.err, '\n'), 1) << ran.err;
    }
}

TEST(Edges, WithoutAHomeNothingIsWrittenIntoTheCurrentFolder) {
    const Desk desk;
    desk.write("in.csv", pulses());
    for (const std::string home : {"-u HOME", "HOME=", "HOME=."}) {
        const auto [said, code] = outputOf(fmt::format("cd {} && env -u XDG_DATA_HOME {} {} measure in.csv --json",
                                                       quoted(desk.path().string()), home, TACTO_CLI));
        EXPECT_EQ(code, 0) << said;
        EXPECT_EQ(desk.files().size(), 1U);
    }
}

TEST(Edges, AUserWithoutAnAccountIsToldAboutHome) {
    if (::getuid() != 0) GTEST_SKIP() << "only root can become a user without an account";
    const Desk desk;
    const auto [said, code] = outputOf(fmt::format(
        "cd / && setpriv --reuid 54321 --clear-groups env -u XDG_DATA_HOME -u HOME {} measure in.csv", TACTO_CLI));
    EXPECT_EQ(code, 3) << said;
    EXPECT_THAT(said, StartsWith("tactoscope-cli: HOME is \"\", and the system knows no home folder of user 54321"));
}

/// Runs the window program in this environment, without the tester's own settings.
std::pair<std::string, int> windowWith(const std::string& environment, const Desk& desk) {
    return outputOf(fmt::format("cd {0} && timeout 60 env -i PATH=/usr/bin:/bin HOME={0} XDG_RUNTIME_DIR={0} {1} {2}",
                                quoted(desk.path().string()), environment, TACTO_WINDOW));
}

TEST(Edges, AWindowWithoutADisplayEndsWithASentence) {
    const Desk desk;
    const auto none = fmt::format(":{}", 20'000 + ::getpid() % 30'000);  // no server has this display number
    const auto display = "DISPLAY=" + none;
    for (const std::string& named :
         {display, std::string("WAYLAND_DISPLAY=wayland-0"), display + " WAYLAND_DISPLAY=wayland-0",
          display + " XDG_SESSION_TYPE=wayland", std::string("QT_QPA_PLATFORM=nonsense"), std::string()}) {
        const auto [said, code] = windowWith(named, desk);
        EXPECT_EQ(code, 3) << named << ": " << said;
        EXPECT_THAT(said, StartsWith("tactoscope: no display: ")) << named;
        EXPECT_THAT(said, EndsWith("; tactoscope-cli needs none\n")) << named;
        EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
        if (named.starts_with("DISPLAY")) {
            EXPECT_THAT(said, HasSubstr("DISPLAY is \"" + none + "\""));
        }
        if (named.starts_with("WAYLAND")) {
            EXPECT_THAT(said, HasSubstr("WAYLAND_DISPLAY is \"wayland-0\""));
        }
    }
}

#ifndef TACTOSCOPE_ADDRESS_SANITIZED  // the sanitizer's library would have to be preloaded first
TEST(Edges, ADisplayThatDoesNotAnswerIsNotWaitedForForEver) {
    const Desk desk;
    // The other end does not answer, as may happen with ssh -X.
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const int server = ::socket(AF_INET, SOCK_STREAM, 0);
    ASSERT_EQ(::bind(server, reinterpret_cast<const sockaddr*>(&address), size), 0);
    ASSERT_EQ(::listen(server, 5), 0);
    ASSERT_EQ(::getsockname(server, reinterpret_cast<sockaddr*>(&address), &size), 0);
    const auto display = fmt::format("127.0.0.1:{}", ntohs(address.sin_port) - 6000);
    const auto [said, code] = windowWith("LD_PRELOAD=" TACTO_SHORT_ALARM_LIBRARY " DISPLAY=" + display, desk);
    ::close(server);
    EXPECT_EQ(code, 3) << said;
    EXPECT_THAT(said, HasSubstr("which has not answered for 30 s; tactoscope-cli needs none\n"));
}
#endif

}  // namespace
}  // namespace tacto::test
