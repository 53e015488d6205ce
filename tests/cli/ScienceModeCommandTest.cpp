// sciencemode identify, status and pulse: the built program with an emulated stimulator behind a pseudo-terminal.
#include <algorithm>
#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/devices/DeviceUri.h"
#include "core/safety/UnitRecord.h"
#include "tests/cli/ExitsInTime.h"
#include "tests/cli/Shape.h"
#include "tests/support/Figures.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using testing::Each;
using testing::HasSubstr;

class ScienceModeCommand : public testing::Test {
protected:
    static sciencemode::EmulatedSettings on(const char* load) {
        sciencemode::EmulatedSettings settings;
        settings.load = *parseLoad(load);
        settings.firmware = {1, 2, 3};
        settings.protocol = {4, 0, 1};
        return settings;
    }
    void fit(const char* load) {
        pty_.reset();
        pty_ = *sciencemode::EmulatedPty::open(on(load), clock_);
    }
    [[nodiscard]] std::string uri() const {
        return fmt::format("sciencemode:?emulated={}&tty={}", emulated_ ? "yes" : "no", pty_->path());
    }
    [[nodiscard]] Ran run(Words words) const {
        words.insert(words.begin(), "sciencemode");
        words.insert(words.end(), {"--device", uri()});
        auto ran = desk_.run(words);
        if (answers_) expectInTime(ran);
        return ran;
    }
    static void expectInTime(const Ran& ran) {
        ASSERT_IN_TIME(ran.err.find("did not answer") == std::string::npos) << ran.err;
        ASSERT_IN_TIME(!ran.err.starts_with("tactoscope-cli: this program stood still")) << ran.err;
    }
    [[nodiscard]] Ran pulse(const char* current, const char* load, const Words& more = {}) const {
        Words words{"pulse", "--current", current,  "--width", "200",
                    "--gap", "100",       "--load", load,      "--yes-bench-load"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    /// Returns the current in mA of every pulse that the device delivered.
    [[nodiscard]] std::vector<double> putOut() const {
        return pty_->inspect([](auto& device, Instant now) {
            std::vector<double> currents;
            for (const auto& one : device.pulses(now)) currents.push_back(one.points.items[0].current.value());
            return currents;
        });
    }
    [[nodiscard]] std::uint64_t asked(sciencemode::Command command) const {
        return pty_->inspect([&](auto& device, Instant) { return device.requests(command); });
    }

    bool emulated_ = true;  ///< as stated in the address
    bool answers_ = true;   ///< whether the emulated device answers, as far as the machine allows
    const SteadyClock clock_;
    const Desk desk_;
    std::unique_ptr<sciencemode::EmulatedPty> pty_ = *sciencemode::EmulatedPty::open(on("1 kohm"), clock_);
};

TEST_F(ScienceModeCommand, IdentifySaysWhoItIsAndWhere) {
    const auto ran = run({"identify", "--json"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    const Json expected{{"id", "EMU0000001"},
                        {"firmware", "1.2.3"},
                        {"protocol", "4.0.1"},
                        {"place", pty_->path()},
                        {"simulated", true}};
    EXPECT_EQ(jsonOf(ran), expected);
    const auto text = run({"identify"}).out;
    for (const auto& part : {std::string("EMU0000001"), std::string("1.2.3"), std::string("ScienceMode 4.0.1"),
                             pty_->path(), std::string("simulated")})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST_F(ScienceModeCommand, StatusIsInWordsAndLookingChangesNothing) {
    auto value = jsonOf(run({"status", "--json"}));
    expectKeys(value, {"id", "place", "simulated", "stimulation", "running", "high_voltage_level", "high_voltage_v"},
               "status");
    EXPECT_EQ(value["stimulation"], "none");
    EXPECT_EQ(value["high_voltage"], "off");
    EXPECT_TRUE(value["high_voltage_v"].is_null());
    EXPECT_EQ(asked(sciencemode::Command::LowLevelInit) + asked(sciencemode::Command::LowLevelStop) +
                  asked(sciencemode::Command::MidLevelStop),
              0U)
        << "a look initialised or stopped something";

    pty_->inspect([](auto& device, Instant now) {
        sciencemode::FrameBytes frame;
        const auto payload = sciencemode::payloadOf(sciencemode::LowLevelInit{});
        ASSERT_TRUE(sciencemode::encodeFrame({0, 0, payload.view()}, frame));
        device.receive(frame.view(), now);
    });
    value = jsonOf(run({"status", "--json"}));
    EXPECT_EQ(value["stimulation"], "low level");
    EXPECT_EQ(value["running"], false);
    EXPECT_EQ(value["high_voltage_v"], 150);
    const auto text = run({"status"}).out;
    EXPECT_THAT(text, HasSubstr("single pulses"));
    EXPECT_THAT(text, HasSubstr("150 V"));
}

TEST_F(ScienceModeCommand, APulseIntoTheDeclaredLoadPasses) {
    const auto ran = pulse("5", "1000", {"--json"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    expectKeys(value,
               {"verdict", "reasons", "simulated", "id", "current_ma", "width_us", "gap_us", "load", "declared_ohm",
                "accepted_ohm", "delivered", "check", "pulse", "file"},
               "pulse");
    EXPECT_EQ(value["verdict"], "pass");
    EXPECT_EQ(value["simulated"], true);
    EXPECT_EQ(value["delivered"], true);
    EXPECT_NEAR(value["declared_ohm"].get<double>(), 1000, 1e-6);
    EXPECT_NEAR(value["accepted_ohm"]["low"].get<double>(), 800, 1e-6);
    EXPECT_NEAR(value["accepted_ohm"]["high"].get<double>(), 1200, 1e-6);
    EXPECT_NEAR(value["pulse"]["impedance_ohm"].get<double>(), 1000, 3);
    EXPECT_EQ(value["check"]["current_ma"], 0.5);
    const auto& samples = value["pulse"]["read_back"];
    EXPECT_EQ(samples["quantity"], "voltage magnitude");
    ASSERT_EQ(samples["samples"].size(), 128U);
    EXPECT_NEAR(samples["samples"][10].get<double>(), 5, 0.01);
    EXPECT_EQ(putOut(), (std::vector<double>{0.5, 5})) << "the check pulse, then the pulse, and nothing else";
}

TEST_F(ScienceModeCommand, ThePulseIsTheOneThatWasAskedFor) {
    RecordProperty("hazard", "H4");
    ASSERT_IN_TIME(
        run({"pulse", "--current", "7.5", "--width", "350", "--gap", "40", "--load", "1k", "--yes-bench-load"}).code ==
        0);
    pty_->inspect([](auto& device, Instant now) {
        const auto& points = device.pulses(now).back().points;
        ASSERT_EQ(points.count, 3U);
        EXPECT_EQ(points.items[0], (sciencemode::Point{Micros(350), Milliamps(7.5)}));
        EXPECT_EQ(points.items[1], (sciencemode::Point{Micros(40), Milliamps(0)}));
        EXPECT_EQ(points.items[2], (sciencemode::Point{Micros(350), Milliamps(-7.5)}));
    });
}

TEST_F(ScienceModeCommand, TheReadBackIsDrawnWithinEightyColumns) {
    const auto ran = pulse("5", "1000");
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("voltage magnitude (V): the device sends no sign"));
    EXPECT_THAT(ran.out, HasSubstr("time (us)"));
    EXPECT_THAT(ran.out, HasSubstr("^ |Z| 1.000 kΩ"));
    EXPECT_THAT(ran.out, HasSubstr("SIMULATED"));
    EXPECT_THAT(ran.out, HasSubstr("verdict  pass"));
    EXPECT_GT(std::count(ran.out.begin(), ran.out.end(), '*'), 60);
    std::size_t begin = 0;
    for (std::size_t end; (end = ran.out.find('\n', begin)) != std::string::npos; begin = end + 1) {
        const auto line = ran.out.substr(begin, end - begin);
        const auto columns = std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; });  // UTF-8
        EXPECT_LE(columns, 80) << line;
    }
}

TEST_F(ScienceModeCommand, TheSavedReadBackIsACaptureThatMeasureReads) {
    const auto file = desk_.at("pulse.csv");
    const auto ran = pulse("5", "1000", {"--out", file, "--json"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
    EXPECT_EQ(jsonOf(ran)["file"], file);
    EXPECT_TRUE(contentOf(file).starts_with("time_s,voltage_magnitude_v\n")) << contentOf(file).substr(0, 40);
    const auto measured = desk_.run({"measure", file, "--json"});
    ASSERT_EQ(measured.code, 0) << measured.err;
    const auto value = jsonOf(measured);
    ASSERT_EQ(value["channels"].size(), 1U);
    EXPECT_EQ(value["channels"][0]["name"], "voltage_magnitude");
    EXPECT_EQ(value["channels"][0]["samples"], 128);
    EXPECT_NEAR(value["channels"][0]["rate_hz"].get<double>(), 250'000, 1);
    ASSERT_GE(value["channels"][0]["pulses"].get<int>(), 1) << measured.out;
    EXPECT_NEAR(value["channels"][0]["amplitude"]["mean"].get<double>(), 5, 0.05);
}

TEST_F(ScienceModeCommand, AnOpenOrShortedLoadGetsTheCheckPulseOnly) {
    RecordProperty("hazard", "H3");
    for (const auto* load : {"open", "short"}) {
        fit(load);
        const auto ran = pulse("5", "1000", {"--json"});
        EXPECT_NE(ran.code, 0) << ran.out;
        EXPECT_THAT(putOut(), Each(0.5)) << load;
        ASSERT_EXIT_IN_TIME(ran.code, 1) << ran.err;
        const auto value = jsonOf(ran);
        EXPECT_EQ(value["verdict"], "fail");
        EXPECT_EQ(value["delivered"], false);
        EXPECT_TRUE(value["pulse"].is_null());
        EXPECT_EQ(value["check"]["electrode"], load);
        ASSERT_EQ(value["reasons"].size(), 1U);
        EXPECT_TRUE(value["reasons"][0].get<std::string>().starts_with(load));
        for (const double current : putOut()) EXPECT_EQ(current, 0.5) << load;
        EXPECT_THAT(pulse("5", "1000").out, HasSubstr("verdict  fail"));
    }
}

TEST_F(ScienceModeCommand, AnotherLoadThanTheDeclaredOneGetsTheCheckPulseOnly) {
    RecordProperty("hazard", "H3");
    for (const auto* declared : {"500", "800", "1300", "10000"}) {
        const auto ran = pulse("1", declared, {"--json"});
        EXPECT_NE(ran.code, 0) << ran.out;
        EXPECT_THAT(putOut(), Each(0.5)) << declared;
        ASSERT_EXIT_IN_TIME(ran.code, 1) << declared << ": " << ran.err;
        const auto value = jsonOf(ran);
        EXPECT_EQ(value["delivered"], false);
        EXPECT_TRUE(value["reasons"][0].get<std::string>().starts_with("mismatch")) << value.dump();
        EXPECT_NEAR(value["check"]["impedance_ohm"].get<double>(), 1000, 1e-6);
    }
    EXPECT_THAT(putOut(), Each(0.5));
    for (const auto* declared : {"900", "1200"}) EXPECT_IN_TIME(pulse("1", declared).code == 0) << declared;
}

TEST_F(ScienceModeCommand, ARealSkinModelIsComparedAtTheEndOfTheLeadingPhase) {
    fit("200 ohm + 10 kohm || 50 nF");
    const auto ran = pulse("2", "200 ohm + 10 kohm || 50 nF", {"--json"});
    ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err << ran.out;
    const auto printed = jsonOf(ran);
    const auto& samples = printed["pulse"]["read_back"]["samples"];
    EXPECT_EQ(samples.size(), 128U);
    for (const auto& sample : samples)
        EXPECT_LE(sample.dump().size(), 5U) << sample << ": hundredths are written as such";
    const double scipy = figuresOf("loads").at("bench_load_impedance_ohm").at("current");
    EXPECT_NEAR(printed["declared_ohm"].get<double>(), scipy, 1);
    EXPECT_NEAR(printed["pulse"]["impedance_ohm"].get<double>(), scipy, 20);
}

TEST_F(ScienceModeCommand, WhatTheGateRefusesIsNotDelivered) {
    RecordProperty("hazard", "H1");
    ASSERT_IN_TIME(pulse("40", "1000").code == 0) << "40 V are allowed";
    const auto before = putOut().size();
    expectRefused(pulse("40.5", "1000"), 4,
                  {"40.5 V", "at most 40 V is allowed (Project's design paper, reference not on record"});
    expectRefused(pulse("50", "1000", {"--json"}), 4, {"paper"});
    expectRefused(pulse("0.3", "1000"), 4, {"0.3 mA", "step"});
    expectRefused(pulse("0.5", "100k"), 4, {"50 V"});
    EXPECT_EQ(putOut().size(), before);

    fit("100 ohm");
    expectRefused(pulse("400", "100"), 4, {"400 mA", "130 mA"});
    expectRefused(
        run({"pulse", "--current", "5", "--width", "5000", "--gap", "0", "--load", "100", "--yes-bench-load"}), 4,
        {"5000 us", "4095 us"});
    EXPECT_TRUE(putOut().empty());
}

TEST_F(ScienceModeCommand, ASignalDuringTheCheckCutsItAndNothingFollows) {
    RecordProperty("hazard", "H2");
    for (const int signal : {SIGINT, SIGTERM}) {
        fit("1 kohm");
        // 65 ms per pulse, so that there is time to stop it.
        auto run = desk_.start({"sciencemode", "pulse", "--current", "5", "--width", "4095", "--gap", "57000", "--load",
                                "1000", "--yes-bench-load", "--json", "--device", uri()});
        ASSERT_IN_TIME(run.waitUntil([&] {
            return pty_->inspect([&](auto& device, Instant now) {
                const bool begun = !device.pulses(now).empty();
                if (begun) run.signal(signal);
                return begun;
            });
        }));
        const auto ran = run.wait(std::chrono::seconds(20));
        ASSERT_EXIT_IN_TIME(ran.code, 4) << ran.err;
        expectRefused(ran, 4, {"stopped"});
        EXPECT_EQ(putOut(), std::vector<double>{0.5});
        EXPECT_TRUE(pty_->inspect([](auto& device, Instant now) { return device.pulses(now).back().cut; }));
    }
}

TEST_F(ScienceModeCommand, AFaultStaysWithTheUnit) {
    RecordProperty("hazard", "H3");
    const OwnSerial serial("EMU");  // the device's own claim does not spare it a check
    emulated_ = false;
    auto settings = on("1 kohm");
    settings.id = serial.text();
    pty_.reset();
    pty_ = *sciencemode::EmulatedPty::open(settings, clock_);
    auto run = desk_.start({"sciencemode", "pulse", "--current", "5", "--width", "4095", "--gap", "57000", "--load",
                            "1000", "--yes-bench-load", "--device", uri()});
    ASSERT_IN_TIME(run.waitUntil(
        [&] { return pty_->inspect([&](auto& device, Instant now) { return !device.pulses(now).empty(); }); }));
    run.signal(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    run.signal(SIGCONT);
    const auto stood = run.wait(std::chrono::seconds(20));
    ASSERT_IN_TIME(stood.err.find("did not answer") == std::string::npos) << stood.err;
    expectRefused(stood, 3, {"stood still"});
    const auto before = putOut().size();
    expectRefused(pulse("5", "1000"), 4, {"left by an earlier run", "stood still", "--reset-fault"});
    EXPECT_EQ(putOut().size(), before);

    // The reset ends the fault for good: the next pulse needs no reset.
    for (const Words& how : {Words{"--reset-fault"}, Words{}}) {
        const auto ran = pulse("5", "1000", how);
        ASSERT_EXIT_IN_TIME(ran.code, 0) << ran.err;
        EXPECT_THAT(ran.out, testing::Not(HasSubstr("SIMULATED")));
    }
    EXPECT_EQ(putOut().size(), before + 4);
    expectRefused(ScienceModeCommand::run({"status", "--reset-fault"}), 2, {"--reset-fault", "pulse"});
}

TEST_F(ScienceModeCommand, AGraveFaultIsResetByASafetyCheckAlone) {
    RecordProperty("hazard", "H1");
    const OwnSerial serial("EMU");
    emulated_ = false;
    auto settings = on("1 kohm");
    settings.id = serial.text();
    pty_.reset();
    pty_ = *sciencemode::EmulatedPty::open(settings, clock_);
    auto folders = unitFolders();
    for (const auto& entry : desk_.environment())
        if (entry.starts_with("XDG_DATA_HOME="))
            folders.records = entry.substr(entry.find('=') + 1) + "/tactoscope/units";
    const auto left = [&](const std::vector<FaultCause>& causes) {
        auto record = accepted(UnitRecord::open(folders, unitOf(serial.text(), uri()), clock_));
        for (const auto cause : causes) record->keepFault(cause, "44 V were measured");
        return record->fault().has_value();
    };
    ASSERT_TRUE(left({FaultCause::OpenElectrode, FaultCause::LimitBroken}));
    const auto reset = [&](const char* protocol) {
        return desk_.run(
            {"run", protocol, "--device", uri(), "--device", "sim:", "--reset-fault", "--out", desk_.at(protocol)});
    };
    const auto refused = reset("separability");
    ASSERT_EXIT_IN_TIME(refused.code, 4) << refused.err;
    expectRefused(refused, 4, {"a fault of limit broken", "44 V were measured", "load-safety with --reset-fault"});
    EXPECT_TRUE(left({}));
    const auto before = putOut().size();
    expectRefused(pulse("5", "1000", {"--reset-fault"}), 4,
                  {"a fault of limit broken", "load-safety with --reset-fault"});
    EXPECT_EQ(putOut().size(), before);
    const auto check = reset("load-safety");  // it ends at the question for the load, which nobody answers
    EXPECT_THAT(check.err, testing::Not(HasSubstr("44 V were measured")));
    const auto record = accepted(UnitRecord::open(folders, unitOf(serial.text(), uri()), clock_));
    const auto fault = record->fault();
    ASSERT_TRUE(fault) << "a check that did not pass resets nothing for good: " << check.err;
    EXPECT_EQ(graveCause(fault->causes), FaultCause::LimitBroken);
    EXPECT_EQ(fault->reason.view(), "44 V were measured");
}

TEST_F(ScienceModeCommand, WithoutATerminalThereIsNoQuestionAndNothingIsDelivered) {
    RecordProperty("hazard", "H12");
    expectRefused(run({"pulse", "--current", "5", "--width", "200", "--gap", "100", "--load", "1000"}), 2,
                  {"--yes-bench-load"});
    EXPECT_TRUE(putOut().empty());
    EXPECT_EQ(asked(sciencemode::Command::DeviceId), 0U) << "not even opened";
}

TEST_F(ScienceModeCommand, AWrongCommandLineNamesWhatIsWrong) {
    expectRefused(run({}), 2, {"identify", "status", "pulse"});
    expectRefused(run({"calibrate"}), 2, {"calibrate", "identify"});
    expectRefused(run({"identify", "status"}), 2, {"second", "status"});
    expectRefused(run({"status", "--current", "5"}), 2, {"--current", "pulse"});
    expectRefused(pulse("0", "1000"), 2, {"--current", "0"});
    expectRefused(pulse("much", "1000"), 2, {"--current", "much"});
    expectRefused(pulse("5", "open"), 2, {"--load", "open"});
    expectRefused(pulse("5", "1 furlong"), 2, {"1 furlong"});
    expectRefused(run({"pulse", "--current", "5", "--yes-bench-load"}), 2, {"--width"});
    expectRefused(run({"pulse", "--current", "5", "--width", "200", "--gap", "5", "--load", "1k", "--yes-bench-load"}),
                  2, {"gap", "5"});
    expectRefused(desk_.run({"sciencemode", "identify", "--device", "sim:"}), 2, {"sim:", "sciencemode:"});
    expectRefused(desk_.run({"sciencemode", "identify", "--device", uri() + "&volume=11"}), 2, {"volume"});
    expectRefused(desk_.run({"sciencemode", "pulse", "--current", "5", "--width", "200", "--gap", "100", "--load", "1k",
                             "--yes-bench-load", "--device", uri() + "&measure=current"}),
                  2, {"measure=current"});
    EXPECT_TRUE(putOut().empty());
}

TEST_F(ScienceModeCommand, DeviceTroubleExitsThree) {
    expectRefused(desk_.run({"sciencemode", "identify", "--device", "sciencemode:?tty=/dev/pts/none"}), 3,
                  {"/dev/pts/none"});
    expectRefused(desk_.run({"sciencemode", "identify", "--device", "sciencemode:P24?tty=" + pty_->path()}), 3,
                  {"EMU0000001", "P24"});
    expectRefused(pulse("5", "1000", {"--out", desk_.at("nowhere/pulse.csv")}), 3, {"nowhere"});
    EXPECT_TRUE(putOut().empty());
    pty_->inspect([](auto& device, Instant) { device.talkGarbage(2000); });
    expectRefused(run({"status"}), 3, {"garbage"});
    expectRefused(pulse("5", "1000"), 3, {"garbage"});
    fit("1 kohm");
    pty_->inspect([](auto& device, Instant) { device.misbehave(sciencemode::AckFault::Drop, 100); });
    answers_ = false;
    expectRefused(pulse("5", "1000"), 3, {"did not answer"});
}

}  // namespace
}  // namespace tacto::test
