// The text of the shipped udev rules, and `./dev install-rules`.
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>
#include <sys/wait.h>

#include "drivers/system/Permission.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

std::string textOf(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::filesystem::path rules() { return sourceDir() / "resources/udev/70-tactoscope.rules"; }

/// Returns the devices in lines that begin with `key`, as "0483:5740", in lower case as in sysfs.
std::set<std::string> permitted(const std::string& key, const std::string& also = "") {
    const std::regex line((key == "ATTR" ? "^SUBSYSTEM==\"usb\", " : "^") + key +
                          "\\{idVendor\\}==\"([0-9a-f]{4})\", " + key +
                          "\\{idProduct\\}==\"([0-9a-f]{4})\", TAG\\+=\"uaccess\"" + also);
    std::set<std::string> found;
    std::istringstream text(textOf(rules()));
    for (std::string row; std::getline(text, row);) {
        std::smatch match;
        if (std::regex_search(row, match, line)) found.insert(match[1].str() + ":" + match[2].str());
    }
    return found;
}

TEST(UdevRules, LetTheSeatsUserOpenEveryDeviceThatIsDriven) {
    const std::set<std::string> usb{"0483:5740", "2341:003e", "1eaf:0004", "1209:0001", "0b49:064f"};
    const std::set<std::string> hidraw{"054c:0ce6", "054c:0df2", "054c:05c4", "054c:09cc"};
    EXPECT_EQ(permitted("ATTR"), usb);
    EXPECT_EQ(permitted("ATTRS"), hidraw);
}

TEST(UdevRules, NoModemProgramTalksToAStimulator) {
    RecordProperty("hazard", "H1");
    const std::set<std::string> serial{"0483:5740", "2341:003e", "1eaf:0004", "1209:0001"};
    EXPECT_EQ(permitted("ATTR", ", ENV\\{ID_MM_DEVICE_IGNORE\\}=\"1\""), serial);
}

TEST(UdevRules, AreCopiedByInstallRules) {
    const ScratchDir scratch;
    const auto target = scratch.path() / "rules.d";
    const auto command = (sourceDir() / "dev").string() + " install-rules " + target.string() + " 2>" +
                         (scratch.path() / "said").string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(textOf(target / "70-tactoscope.rules"), textOf(rules()));
    EXPECT_NE(textOf(scratch.path() / "said").find("Copied resources/udev/70-tactoscope.rules to " + target.string()),
              std::string::npos);
}

class InstallRules : public testing::Test {
protected:
    /// Runs install-rules and returns its exit code; said() returns its messages.
    int run(const std::string& options) const {
        const auto command = fmt::format("{} install-rules {} 2>{}", (sourceDir() / "dev").string(), options,
                                         (scratch.path() / "said").string());
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string said() const { return textOf(scratch.path() / "said"); }
    std::string own() const { return textOf(target / "71-tactoscope-devices.rules"); }
    static std::string rulesFor(const std::string& vendor, const std::string& product, const std::string& grant) {
        return fmt::format(
            "SUBSYSTEM==\"usb\", ENV{{DEVTYPE}}==\"usb_device\", ATTR{{idVendor}}==\"{0}\", "
            "ATTR{{idProduct}}==\"{1}\", {2}\n"
            "SUBSYSTEM==\"hidraw\", ATTRS{{idVendor}}==\"{0}\", ATTRS{{idProduct}}==\"{1}\", {2}\n",
            vendor, product, grant);
    }

    const ScratchDir scratch;
    const std::filesystem::path target = scratch.path() / "rules.d";
};

TEST_F(InstallRules, ADeviceThatTheyDoNotNameIsAddedAndThoseBeforeItAreKept) {
    ASSERT_EQ(run("--device 1234:ABCD " + target.string()), 0) << said();
    EXPECT_NE(own().find(rulesFor("1234", "abcd", "TAG+=\"uaccess\"")), std::string::npos) << own();
    EXPECT_EQ(textOf(target / "70-tactoscope.rules"), textOf(rules()));
    ASSERT_EQ(run("--device 5678:0001 --device 5678:0002 " + target.string()), 0) << said();
    for (const auto* product : {"0001", "0002"}) {
        EXPECT_NE(own().find(rulesFor("5678", product, "TAG+=\"uaccess\"")), std::string::npos) << own();
    }
    EXPECT_NE(own().find(rulesFor("1234", "abcd", "TAG+=\"uaccess\"")), std::string::npos) << own();
}

TEST_F(InstallRules, AGroupMayOpenEveryDeviceWhereThereIsNoSeat) {
    ASSERT_EQ(run("--device 1234:5678 --group plugdev " + target.string()), 0) << said();
    const std::string grant = "TAG+=\"uaccess\", GROUP=\"plugdev\", MODE=\"0660\"";
    EXPECT_NE(own().find(rulesFor("1234", "5678", grant)), std::string::npos) << own();
    const auto all = textOf(target / "70-tactoscope.rules");
    std::istringstream lines(all);
    int granted = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("TAG+=\"uaccess\"") == std::string::npos) continue;
        ++granted;
        EXPECT_NE(line.find(grant), std::string::npos) << line;
    }
    EXPECT_EQ(granted, 9);
}

TEST_F(InstallRules, WhatIsNoDeviceOrGroupIsRefusedAndNothingIsCopied) {
    for (const auto* wrong : {"--device 1234", "--device 12345:6789", "--device '1234:5678\",RUN+=\"x'", "--device",
                              "--group 'a b'", "--group", "--seat 1"}) {
        EXPECT_EQ(run(std::string(wrong) + " " + target.string()), 2) << wrong << ": " << said();
        EXPECT_FALSE(std::filesystem::exists(target)) << wrong;
    }
}

TEST(Permission, OverSshTheSentenceSaysThatTheSeatsRuleDoesNotHelp) {
    EXPECT_EQ(permissionAdvice({}, Login::Seat), "run \"./dev install-rules\" once, then plug the device in again.");
    EXPECT_EQ(permissionAdvice("1234:5678", Login::Seat),
              "run \"./dev install-rules --device 1234:5678\" once, then plug the device in again.");
    EXPECT_EQ(permissionAdvice("1234:5678", Login::Seat, "tactoscope-install-rules"),
              "run \"tactoscope-install-rules --device 1234:5678\" once, then plug the device in again.");
    const auto ssh = permissionAdvice("1234:5678", Login::Ssh);
    for (const auto* part : {"over ssh", "no seat", "\"./dev install-rules --device 1234:5678 --group plugdev\"",
                             "usermod -aG plugdev", "log in again"}) {
        EXPECT_NE(ssh.find(part), std::string::npos) << part << ": " << ssh;
    }
}

}  // namespace
}  // namespace tacto::test
