// Instruments that fail in the middle of a record: each failure gives an error, never a hang or a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/sigrok/ScopeOnLan.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using sigrok_driver::ScopeFault;
using SteadyTime = std::chrono::steady_clock;

ScopeSettings faultSettings() {
    ScopeSettings s;
    s.sampleRate = Hertz(1e6);
    s.samples = 2000;
    s.triggerLevel = 5;
    return s;
}

double seconds(SteadyTime::time_point since) { return Seconds(SteadyTime::now() - since).count(); }

struct Failing {
    const char* name;
    ScopeFault fault;
    ErrorCode code;
    double within_s;
};

class ScopeFails : public testing::TestWithParam<Failing> {};

TEST_P(ScopeFails, IsAnErrorOfPollAndClosesInTime) {
    RecordProperty("hazard", "H4");
    ScopeOnLan lan;
    lan.arm(faultSettings());
    lan.instrument().setFault(GetParam().fault);
    lan.bench().deliver(voltagePulse(10), Seconds(0.06));
    auto since = SteadyTime::now();
    const auto capture = lan.poll(Seconds(20));
    ASSERT_FALSE(capture.has_value());
    EXPECT_CODE_IN_TIME(capture.error().code, GetParam().code) << capture.error().message;
    EXPECT_IN_TIME(seconds(since) < GetParam().within_s) << capture.error().message;
    EXPECT_FALSE(lan.scope().poll().has_value()) << "the error stays";
    EXPECT_FALSE(lan.scope().arm().has_value());
    since = SteadyTime::now();
    lan.close();
    EXPECT_IN_TIME(seconds(since) < 2.0);
}

INSTANTIATE_TEST_SUITE_P(Ways, ScopeFails,
                         testing::Values(Failing{"HangsUp", ScopeFault::HangUp, ErrorCode::Device, 3},
                                         Failing{"FallsSilent", ScopeFault::Silence, ErrorCode::Timeout, 8},
                                         Failing{"Garbage", ScopeFault::Garbage, ErrorCode::Device, 5},
                                         Failing{"PromisesMore", ScopeFault::LongBlock, ErrorCode::Device, 8},
                                         Failing{"GivesTooMuch", ScopeFault::Endless, ErrorCode::Device, 8},
                                         Failing{"GivesTooMuchInPieces", ScopeFault::Trickle, ErrorCode::Device, 3}),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(ScopeFaults, SilenceWhileWaitingIsATimeout) {
    ScopeOnLan lan;
    lan.arm(faultSettings());
    lan.instrument().fallSilent();
    const auto since = SteadyTime::now();
    EXPECT_THAT(lan.poll(Seconds(20)), refused(ErrorCode::Timeout));
    EXPECT_IN_TIME(seconds(since) < 8);
}

TEST(ScopeFaults, ClosesInTimeWhileTheInstrumentIsSilentWithinARecord) {
    ScopeOnLan lan;
    lan.arm(faultSettings());
    lan.instrument().setFault(ScopeFault::Silence);
    lan.bench().deliver(voltagePulse(10), Seconds(0.06));
    (void)lan.instrument().waits(Seconds(0));
    const auto since = SteadyTime::now();
    lan.close();
    EXPECT_IN_TIME(seconds(since) < 2.0);
}

TEST(ScopeFaults, ClosesInTimeWhileItWaitsForATrigger) {
    ScopeOnLan lan;
    lan.arm(faultSettings());
    const auto since = SteadyTime::now();
    lan.close();
    EXPECT_IN_TIME(seconds(since) < 2.0);
    const auto again = lan.open();
    EXPECT_IN_TIME(again);
}

TEST(ScopeFaults, DisarmingReturnsAtOnceAndItCanBeArmedAgain) {
    ScopeOnLan lan;
    lan.arm(faultSettings());
    const auto since = SteadyTime::now();
    lan.scope().disarm();
    EXPECT_IN_TIME(seconds(since) < 0.1);
    lan.arm(faultSettings());
    lan.bench().deliver(voltagePulse(10), Seconds(0.06));
    const auto capture = lan.poll();
    ASSERT_IN_TIME(capture);
    EXPECT_IN_TIME(capture->has_value());
}

TEST(ScopeFaults, AnInstrumentThatIsOffIsNotFoundAndOneThatIsMuteTimesOut) {
    ScopeOnLan lan;
    lan.close();
    lan.instrument().fallSilent();
    auto since = SteadyTime::now();
    const auto mute = lan.open();
    ASSERT_FALSE(mute.has_value());
    EXPECT_IN_TIME(seconds(since) < 12);
    lan.instrument().unplug();
    std::string off;
    since = SteadyTime::now();
    do {  // the listening socket closes on the server's own thread
        const auto opened = lan.open();
        ASSERT_FALSE(opened.has_value());
        off = opened.error().message;
    } while (off.find("no instrument at") == std::string::npos && seconds(since) < 30);
    EXPECT_THAT(off, testing::HasSubstr("no instrument at 127.0.0.1"));
}

}  // namespace
}  // namespace tacto::test
