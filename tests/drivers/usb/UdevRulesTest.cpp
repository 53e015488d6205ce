// The shipped udev rules, as text, and `./dev install-rules`.
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/Support.h"

namespace tacto::test {
namespace {

std::string textOf(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::filesystem::path rules() { return sourceDir() / "resources/udev/70-tactoscope.rules"; }

/// The devices of lines whose first key is `key`, as "0483:5740", lower case as sysfs has them.
std::set<std::string> permitted(const std::string& key, const std::string& also = "") {
    const std::regex line("^" + key + "\\{idVendor\\}==\"([0-9a-f]{4})\", " + key +
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
    const std::set<std::string> usb{"0483:5740", "2341:003e", "1eaf:0004", "1209:0001", "0b49:064f",
                                    "054c:0ce6", "054c:0df2", "054c:05c4", "054c:09cc"};
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

}  // namespace
}  // namespace tacto::test
