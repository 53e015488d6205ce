// Exit code 2: the command line is wrong, and nothing was begun. (For faulty files and devices: 3.)
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

TEST(Usage, WithoutACommandTheHelpGoesToStderr) {
    const Desk desk;
    const auto ran = desk.run({});
    EXPECT_EQ(ran.code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, testing::HasSubstr("run PROTOCOL"));
}

TEST(Usage, HelpNamesEveryCommandAndEveryExitCode) {
    const Desk desk;
    const auto ran = desk.run({"help"});
    EXPECT_EQ(ran.code, 0);
    for (const auto* command :
         {"devices", "protocols", "run", "roughness", "encode", "measure", "analyze", "report", "verify"}) {
        EXPECT_THAT(ran.out, testing::HasSubstr(std::string("tactoscope-cli ") + command));
    }
    EXPECT_THAT(ran.out, testing::HasSubstr("5 indeterminate"));
}

TEST(Usage, HelpHasALineForEachFormOfACommand) {
    const Desk desk;
    const std::string leave = "tactoscope-cli study leave STUDY CODE [--reason T] [--passphrase-file F] [--json]\n";
    EXPECT_THAT(desk.run({"help"}).out, testing::HasSubstr("\n  " + leave));
    const auto ran = desk.run({"study", "--help"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.out, testing::HasSubstr("\n" + leave));
    EXPECT_THAT(ran.out, testing::Not(testing::HasSubstr(" | ")));
    const auto wrong = desk.run({"study", "--colour"});
    expectRefused(wrong, 2, {"colour", "tactoscope-cli study --help"});
    EXPECT_THAT(wrong.err, testing::Not(testing::HasSubstr(" | ")));
}

TEST(Usage, AnUnknownCommandIsNamedWithThoseThatExist) {
    const Desk desk;
    expectRefused(desk.run({"calibrate"}), 2, {"calibrate", "run", "verify"});
}

TEST(Usage, AnUnknownOptionIsNamed) {
    const Desk desk;
    expectRefused(desk.run({"devices", "--colour"}), 2, {"colour", "--json"});
    expectRefused(desk.run({"run", "live", "--device", "sim:", "--speed", "3"}), 2, {"speed", "--realtime"});
}

TEST(Usage, AMissingOrSuperfluousWordIsNamed) {
    const Desk desk;
    expectRefused(desk.run({"run"}), 2, {"PROTOCOL"});
    expectRefused(desk.run({"roughness"}), 2, {"RECORDING"});
    expectRefused(desk.run({"measure"}), 2, {"CAPTURE"});
    expectRefused(desk.run({"report"}), 2, {"SESSION"});
    expectRefused(desk.run({"verify"}), 2, {"SESSION"});
    expectRefused(desk.run({"devices", "more"}), 2, {"more"});
    expectRefused(desk.run({"analyze"}), 2, {"separability"});
    expectRefused(desk.run({"analyze", "texture", "a.csv"}), 2, {"texture", "separability"});
}

TEST(Usage, AnUnknownProtocolIsNamedWithThoseThatExist) {
    const Desk desk;
    expectRefused(desk.run({"run", "dance", "--device", "sim:"}), 2, {"dance", "live", "separability"});
}

/// A wrong command line leaves no trace of a run.
class BadRun : public testing::Test {
protected:
    void expectNothingBegun(Words words, const Words& parts, int code = 2) const {
        words.insert(words.begin(), "run");
        words.insert(words.end(), {"--out", desk_.at("out"), "--json"});
        expectRefused(desk_.run(words), code, parts);
        EXPECT_FALSE(std::filesystem::exists(desk_.at("out")));
    }

private:
    const Desk desk_;
};

TEST_F(BadRun, AnUnknownParameterIsNamedWithThoseThatExist) {
    expectNothingBegun({"separability", "--device", "sim:", "--set", "speed=1"},
                       {"speed", "repeats", "source", "load"});
}

TEST_F(BadRun, ASettingOutOfItsRangeIsNamedWithTheRange) {
    expectNothingBegun({"separability", "--device", "sim:", "--set", "repeats=0"}, {"repeats", "0", "500"});
    expectNothingBegun({"separability", "--device", "sim:", "--set", "repeats=501"}, {"repeats", "501", "500"});
    expectNothingBegun({"separability", "--device", "sim:", "--set", "repeats=2.5"}, {"repeats", "2.5", "whole"});
    expectNothingBegun({"separability", "--device", "sim:", "--set", "load=nan"}, {"load", "NaN", "number from 1"});
    expectNothingBegun({"separability", "--device", "sim:", "--set", "source=moon"}, {"moon", "finger", "direct"});
    expectNothingBegun({"separability", "--device", "sim:", "--set", "repeats"}, {"repeats", "KEY=VALUE"});
}

TEST_F(BadRun, ASeedThatIsNoNumberIsNamed) {
    expectNothingBegun({"live", "--device", "sim:", "--seed", "lucky"}, {"seed", "lucky"});
    expectNothingBegun({"live", "--device", "sim:", "--seed", "-1"}, {"seed", "-1"});
}

TEST_F(BadRun, AWrongDeviceParameterIsNamedWithWhatIsAccepted) {
    expectNothingBegun({"live", "--device", "sim:stimulator?shape=round", "--device", "sim:"}, {"shape", "mode"});
    expectNothingBegun({"live", "--device", "sim:stimulator?gain=much", "--device", "sim:"}, {"gain", "much"});
    expectNothingBegun({"live", "--device", "sim:stimulator?gain=nan", "--device", "sim:"}, {"gain", "nan"});
}

TEST_F(BadRun, ADeviceThatCannotBeOpenedExitsThree) {
    expectNothingBegun({"live"}, {"sensor", "sim:"}, 3);
    expectNothingBegun({"live", "--device", "sciencemode:", "--device", "sim:"}, {"sciencemode:"}, 3);
    expectNothingBegun({"live", "--device", "sim:toaster"}, {"toaster", "sim:stimulator"}, 3);
    expectNothingBegun({"live", "--device", "recording:/no/such", "--device", "sim:"}, {"/no/such"}, 3);
    expectNothingBegun({"separability", "--device", "capture:/no/such", "--device", "sim:"}, {"/no/such"}, 3);
}

TEST(Usage, AnOutFolderThatIsAFileIsLeftAsItIs) {
    const Desk desk;
    const auto file = desk.write("taken", "mine");
    expectRefused(desk.run({"run", "live", "--device", "sim:", "--out", file}), 3, {file, "folder"});
    EXPECT_EQ(contentOf(file), "mine");
}

}  // namespace
}  // namespace tacto::test
