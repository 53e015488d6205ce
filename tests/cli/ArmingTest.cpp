// run on hardware: the built program with a stimulator behind a pseudo-terminal that does not say it is emulated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/ExitsInTime.h"
#include "tests/cli/TerminalCli.h"
#include "tests/support/InTime.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class RunOnHardware : public testing::Test {
protected:
    RunOnHardware() { RecordProperty("hazard", "H12"); }
    [[nodiscard]] sciencemode::EmulatedSettings unit() const {
        sciencemode::EmulatedSettings settings;
        settings.id = serial_.text();
        return settings;
    }
    [[nodiscard]] Words words(const Words& more = {}) const {
        Words all{"run", script_, "--device", "sciencemode:?tty=" + pty_->path(), "--out", "out"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] std::size_t putOut() const {
        return pty_->inspect([](auto& device, Instant now) { return device.pulses(now).size(); });
    }
    /// Returns the value that --set needs, as stated in the refusal.
    static std::string wanted(const std::string& said) {
        constexpr std::string_view kBefore = "confirm-arming=\"";
        const auto at = said.rfind(kBefore);
        if (at == std::string::npos) return {};
        const auto begin = at + kBefore.size();
        return said.substr(begin, said.find('"', begin) - begin);
    }

    const OwnSerial serial_;
    const SteadyClock clock_;
    const Desk desk_;
    const std::unique_ptr<sciencemode::EmulatedPty> pty_ = *sciencemode::EmulatedPty::open(unit(), clock_);
    const std::string script_ = desk_.protocol("arms.js", R"js(protocol({ title: "Arms", needs: ["stimulator"],
  parameters: { load: { label: "Load", unit: "ohm", min: 1, max: 1e6, value: 1e3 } } });
function run(p) { bench.arm({ load: p.load }); bench.disarm(); return verdict({ verdict: "pass" }); })js");
};

TEST_F(RunOnHardware, DeliversNothingUnconfirmedAndSaysWhatToAnswer) {
    const auto refused = desk_.run(words());
    EXPECT_EQ(putOut(), 0U);
    ASSERT_EQ(refused.code, 3) << refused.err;
    const auto text = wanted(refused.err);
    ASSERT_IN_TIME(!text.empty()) << refused.err;
    EXPECT_THAT(text, HasSubstr(serial_.text() + " into 1 kohm, up to 40 V and 50 mA")) << refused.err;

    const auto yes = desk_.run(words({"--set", "confirm-arming=yes"}));
    EXPECT_NE(yes.code, 0) << yes.err;
    EXPECT_EQ(putOut(), 0U);
    ASSERT_EXIT_IN_TIME(yes.code, 4) << yes.err;
    const auto other = desk_.run(words({"--set", "load=2000", "--set", "confirm-arming=" + text}));
    EXPECT_NE(other.code, 0) << other.err;
    EXPECT_EQ(putOut(), 0U);
    ASSERT_EXIT_IN_TIME(other.code, 4) << other.err;
    EXPECT_THAT(wanted(other.err), HasSubstr("into 2 kohm"));

    const auto confirmed = desk_.run(words({"--set", "confirm-arming=" + text}));
    ASSERT_EXIT_IN_TIME(confirmed.code, 0) << confirmed.err;
    EXPECT_EQ(putOut(), 1U) << "the impedance check";
}

TEST_F(RunOnHardware, ATerminalIsAskedForATypedWord) {
    for (const auto& [typed, code] : {std::pair("yes\n", 4), std::pair("\n", 4), std::pair("bench load\n", 0)}) {
        TerminalCli cli(desk_, words(), 200);
        ASSERT_IN_TIME(cli.waitFor("anything else delivers nothing: ")) << cli.screen();
        EXPECT_THAT(cli.screen(), HasSubstr(serial_.text() + " into 1 kohm, up to 40 V and 50 mA"));
        EXPECT_EQ(putOut(), 0U) << "before it was confirmed";
        cli.type(typed);
        const int ended = cli.wait();
        EXPECT_EQ(putOut(), ended == 0 ? 1U : 0U) << cli.screen();
        EXPECT_TRUE(code == 0 || ended != 0) << cli.screen();
        ASSERT_EXIT_IN_TIME(ended, code) << cli.screen();
    }
    EXPECT_EQ(putOut(), 1U);
}

/// The device says it is an emulator, but its address could belong to any device.
TEST_F(RunOnHardware, WhatADeviceSaysOfItselfSparesNoConfirmationAndNoRecord) {
    RecordProperty("hazard", "H4");
    auto settings = unit();
    const OwnSerial emulators("EMU");
    settings.id = emulators.text();
    const auto liar = *sciencemode::EmulatedPty::open(settings, clock_);
    const auto lied = [&](const Words& more) {
        Words all{"run", script_, "--device", "sciencemode:?tty=" + liar->path(), "--out", "out"};
        all.insert(all.end(), more.begin(), more.end());
        return desk_.run(all);
    };
    const auto refused = lied({});
    EXPECT_EQ(liar->inspect([](auto& device, Instant now) { return device.pulses(now).size(); }), 0U);
    ASSERT_EXIT_IN_TIME(refused.code, 3) << refused.err;
    ASSERT_IN_TIME(!wanted(refused.err).empty()) << refused.err;
    const auto ran = lied({"--set", "confirm-arming=" + wanted(refused.err)});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, testing::Not(HasSubstr("SIMULATED")));
    EXPECT_EQ(liar->inspect([](auto& device, Instant now) { return device.pulses(now).size(); }), 1U);
}

TEST_F(RunOnHardware, IsNotCalledSimulatedForASimulatedFinger) {
    RecordProperty("hazard", "H9");
    const auto script = desk_.protocol("feels.js", R"js(protocol({ title: "Feels", needs: ["sensor", "stimulator"] });
function run(p) { bench.arm({ load: 1000 }); bench.drive("manual", { roughness: 0.5, pressure: 1 }); bench.wait(1.2);
  bench.disarm(); return verdict({ verdict: "pass" }); })js");
    const Words first{"run",      script, "--device", "sciencemode:?tty=" + pty_->path(),
                      "--device", "sim:", "--out",    "out"};
    auto second = first;
    second.insert(second.end(), {"--set", "confirm-arming=" + wanted(desk_.run(first).err)});
    const auto ran = desk_.run(second);
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("SIMULATED: the fingertip sensor."));
    EXPECT_THAT(ran.out, HasSubstr("Real: stimulator ScienceMode stimulator " + serial_.text() + ", which delivered "));
    EXPECT_THAT(ran.out, testing::Not(HasSubstr("no number here was measured")));
    second.emplace_back("--json");
    const auto again = desk_.run(second);
    ASSERT_EXIT_IN_TIME(again.code, 0) << again.err;
    const auto json = nlohmann::json::parse(again.out);
    for (const auto& device : json["devices"]) {
        EXPECT_EQ(device["simulated"], device["role"] == "sensor") << device;
        EXPECT_EQ(device["serial"] == serial_.text(), device["role"] == "stimulator") << device;
    }
    EXPECT_EQ(json["devices"].size(), 2U);
    EXPECT_GE(json["marks"].size(), 2U);
}

TEST_F(RunOnHardware, OneAnswerIsNotSilentlyReplacedByAnother) {
    const auto ran = desk_.run(words({"--set", "load=1000", "--set", "load=2000"}));
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("load is given twice"));
}

}  // namespace
}  // namespace tacto::test
