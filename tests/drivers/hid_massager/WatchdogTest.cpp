// H2 end to end: another process drives an emulated massager and dies in the middle of a burst. The device lives in
// this process, as hardware would, and must get its stop, which the dead process cannot send.
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>

#include "drivers/hid_massager/HidDriver.h"
#include "drivers/hid_massager/TrancePort.h"
#include "drivers/hid_massager/WatchdogProcess.h"
#include "tests/drivers/hid_massager/FakeHid.h"
#include "tests/support/InTime.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Refused.h"
#include "tests/support/usb_emulation/EmulatedHidDevice.h"

namespace tacto::test {
namespace {

using hid::StopWay;
using std::chrono::milliseconds;
using testing::HasSubstr;
using Steady = std::chrono::steady_clock;

constexpr milliseconds kStopWithin{500};
constexpr std::size_t kReportLength = 48;

struct Death {
    const char* name;
    const char* word;  ///< the command for the host; empty: the test sends `signal`
    int signal;        ///< the signal that ends the host; 0: it exits
};
constexpr std::array<Death, 5> kDeaths{{{"Kill9", "", SIGKILL},
                                        {"Abort", "abort", SIGABRT},
                                        {"Segfault", "segv", SIGSEGV},
                                        {"Interrupt", "", SIGINT},
                                        {"ExitWithoutClosing", "exit", 0}}};

class WatchdogDeath : public testing::TestWithParam<Death> {
protected:
    void SetUp() override { RecordProperty("hazard", "H2"); }
    static void die(HostProcess& host) {
        const auto& how = GetParam();
        if (*how.word != '\0')
            ASSERT_TRUE(host.tell(how.word));
        else
            host.signal(how.signal);
        const int status = host.ended();
        if (how.signal == 0) {
            EXPECT_TRUE(WIFEXITED(status));
        } else {
            ASSERT_TRUE(WIFSIGNALED(status)) << status;
            EXPECT_EQ(WTERMSIG(status), how.signal);
        }
    }

    UsbTestbed bed;
};

UsbBytes padReport(std::uint8_t intensity) {
    UsbBytes report{2, 3, 0, intensity, intensity};
    report.resize(kReportLength);
    return report;
}

TEST_P(WatchdogDeath, AHidrawMassagerGetsItsStop) {
    const EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kReportLength), {});
    HostProcess host({TACTO_HOST_PROGRAM, "hid:054c:0ce6"});
    ASSERT_IN_TIME(host.speaks()) << "the host ended without driving the massager";
    ASSERT_EQ(pad.waitForReports(2).back(), padReport(255));
    die(host);
    const auto dead = Steady::now();
    const auto all = pad.waitForReports(3);
    EXPECT_IN_TIME(Steady::now() - dead <= kStopWithin);
    EXPECT_THAT(all, testing::ElementsAre(padReport(0), padReport(255), padReport(0)));
}

TEST_P(WatchdogDeath, ATranceVibratorGetsItsStop) {
    EmulatedUsbDevice device(bed, vendorDevice(hid::kTranceVendor, hid::kTranceProduct, "T1"), {});
    HostProcess host({TACTO_HOST_PROGRAM, "hid:0b49:064f"});
    ASSERT_IN_TIME(host.speaks());
    const auto speeds = [&](std::size_t count) {
        std::vector<int> all;
        for (const auto& setup : device.waitForRequests(count)) all.push_back(setup.value);
        return all;
    };
    ASSERT_EQ(speeds(2).back(), 255);
    die(host);
    const auto dead = Steady::now();
    const auto all = speeds(3);
    EXPECT_IN_TIME(Steady::now() - dead <= kStopWithin);
    EXPECT_THAT(all, testing::ElementsAre(0, 255, 0));
}

INSTANTIATE_TEST_SUITE_P(Deaths, WatchdogDeath, testing::ValuesIn(kDeaths),
                         [](const testing::TestParamInfo<Death>& death) { return std::string(death.param.name); });

TEST(WatchdogStandstill, AProgramThatStandsStillInABurstIsStoppedForAndStaysOff) {
    RecordProperty("hazard", "H2");
    UsbTestbed bed;
    const EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kReportLength), {});
    HostProcess host({TACTO_HOST_PROGRAM, "hid:054c:0ce6"});
    ASSERT_IN_TIME(host.speaks());
    ASSERT_EQ(pad.waitForReports(2).back(), padReport(255));
    host.signal(SIGSTOP);
    const auto stopped = Steady::now();
    EXPECT_EQ(pad.waitForReports(3).back(), padReport(0));
    EXPECT_IN_TIME(Steady::now() - stopped <= kStopWithin);
    host.signal(SIGCONT);
    ASSERT_TRUE(host.tell("over"));  // the host then ends normally
    EXPECT_EQ(host.ended(), 0);
    for (std::size_t i = 2; i < pad.waitForReports(3).size(); ++i) EXPECT_EQ(pad.waitForReports(3)[i], padReport(0));
}

class WatchdogProcessTest : public testing::Test {
protected:
    void SetUp() override { RecordProperty("hazard", "H2"); }
    static StopWay hidraw() {
        StopWay way;
        way.node = "/dev/hidraw0";
        way.bytes = padReport(0);
        return way;
    }
    UsbTestbed bed;
};

TEST_F(WatchdogProcessTest, TriesUntilTheDeviceTakesTheStop) {
    EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kReportLength), {});
    auto watchdog = hid::WatchdogProcess::start(hidraw());
    ASSERT_IN_TIME(watchdog);
    pad.refuseWrites(EIO);
    ASSERT_IN_TIME((*watchdog)->beat() == hid::WatchdogState::Watching);
    watchdog->reset();  // like a death: without a word that the output is off
    EXPECT_TRUE(pad.waitForReports(0).empty());
    pad.refuseWrites(0);
    EXPECT_EQ(pad.waitForReports(1).back(), padReport(0));
}

/// Returns the processes that this process's threads have started.
std::vector<pid_t> children() {
    std::vector<pid_t> all;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
        std::ifstream in(thread.path() / "children");
        for (pid_t one = 0; in >> one;) all.push_back(one);
    }
    return all;
}

TEST_F(WatchdogProcessTest, OneThatStandsStillOrHasEndedIsNoWatchdog) {
    RecordProperty("hazard", "H2");
    const EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kReportLength), {});
    const auto before = children();
    auto watchdog = hid::WatchdogProcess::start(hidraw());
    ASSERT_IN_TIME(watchdog);
    auto started = children();
    std::erase_if(started, [&](pid_t one) { return std::find(before.begin(), before.end(), one) != before.end(); });
    ASSERT_EQ(started.size(), 1U);
    auto state = hid::WatchdogState::Watching;
    // Measures for how long beats are accepted, at most 1.5 s.
    const auto beats = [&] {
        const auto begun = Steady::now();
        while (Steady::now() - begun < milliseconds(1500)) {
            state = (*watchdog)->beat();
            if (state != hid::WatchdogState::Watching) break;
            std::this_thread::sleep_for(hid::Watchdog::kBeat);
        }
        return Steady::now() - begun;
    };
    EXPECT_IN_TIME(beats() >= milliseconds(1500)) << "one that runs answers";
    (*watchdog)->rest();  // so no earlier beat is left unanswered
    kill(started.front(), SIGSTOP);
    const auto deaf = beats();
    EXPECT_GE(deaf, hid::Watchdog::kUnansweredLimit);
    EXPECT_IN_TIME(deaf <= milliseconds(800));
    EXPECT_EQ(state, hid::WatchdogState::Silent);
    kill(started.front(), SIGCONT);
    (*watchdog)->rest();
    std::this_thread::sleep_for(milliseconds(100));
    EXPECT_IN_TIME((*watchdog)->beat() == hid::WatchdogState::Watching) << "it answers again";
    (*watchdog)->rest();
    kill(started.front(), SIGKILL);
    static_cast<void>(beats());
    EXPECT_EQ(state, hid::WatchdogState::Ended);
}

TEST_F(WatchdogProcessTest, EndedInOrderSendsNothing) {
    EmulatedHidDevice pad(bed, 0x054C, 0x0CE6, "SN7", outputDescriptor(2, kReportLength), {});
    auto watchdog = hid::WatchdogProcess::start(hidraw());
    ASSERT_IN_TIME(watchdog);
    ASSERT_IN_TIME((*watchdog)->beat() == hid::WatchdogState::Watching);
    (*watchdog)->rest();
    watchdog->reset();  // returns once its process has ended
    EXPECT_TRUE(pad.waitForReports(0).empty());
}

TEST_F(WatchdogProcessTest, ThatDoesNotStartOrOpenTheDeviceMeansThatTheMassagerIsNotDriven) {
    EXPECT_THAT(hid::WatchdogProcess::start(hidraw(), "/nowhere/tactoscope-watchdog"),
                refused(ErrorCode::NotFound, testing::AllOf(HasSubstr("not driven"), HasSubstr("/nowhere/"))));
    EXPECT_THAT(hid::WatchdogProcess::start(hidraw(), "/bin/true"),
                refusedSaying(testing::AllOf(HasSubstr("not driven"), HasSubstr("did not answer"))));
    auto way = hidraw();
    way.node = "/dev/hidraw9";
    EXPECT_THAT(hid::WatchdogProcess::start(way),
                refusedSaying(testing::AllOf(HasSubstr("not driven"), HasSubstr("/dev/hidraw9"))));
}

TEST(StopWay, GoesThroughAProgramsArgumentsUnchanged) {
    StopWay hidraw;
    hidraw.node = "/dev/hidraw3";
    hidraw.bytes = {2, 0, 255};
    const StopWay control{StopWay::Kind::Usb, "/dev/bus/usb/001/004", {0x43, 1, 0, 0, 0, 0, 0, 0}};
    for (const auto& way : {hidraw, control}) {
        auto words = way.arguments();
        std::vector<char*> pointers;
        for (auto& word : words) pointers.push_back(word.data());
        EXPECT_EQ(StopWay::read(static_cast<int>(pointers.size()), pointers.data()), way);
        pointers.pop_back();
        EXPECT_EQ(StopWay::read(static_cast<int>(pointers.size()), pointers.data()), std::nullopt);
    }
}

}  // namespace
}  // namespace tacto::test
