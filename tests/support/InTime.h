// InTime.h - assertions about how late something may come, kept apart from assertions about what may never happen.
//
// A machine that stands still makes a program late; it cannot make it deliver a train after a stop. On the machine's
// clock whatever must happen is a deadline (a bench arms, delivers, waits: a status that comes 50 ms late switches it
// off, as it should), and whatever must not happen is none. A test that failed by EXPECT_IN_TIME or ASSERT_IN_TIME
// alone is tried again where the machine stood still (support/Standstill.cpp); any other failure is one. There an
// ASSERT_IN_TIME also ends the test from within a function that the test calls.
//
// A Result missed a deadline only if its error is one that lateness causes: no answer in time (Timeout), the output off
// by then (NotArmed), or the work ended (Stopped). A silent control loop, an approval that expired and a watchdog that
// had to stop the output are Timeout. Every other error, a device's above all, is wrong however late it comes.
//
// Thread-safety: as gtest's assertions.
#pragma once

#include <gtest/gtest.h>
#include <type_traits>

namespace tacto::test {

/// What the message of a missed deadline begins with.
inline constexpr const char* kNotInTime = "not in time: ";

/// `happened`: a truth, or a Result, whose error is shown.
template <class Happened>
[[nodiscard]] testing::AssertionResult inTime(const char* what, const Happened& happened) {
    if (happened) return testing::AssertionSuccess();
    if constexpr (requires { happened.error().message; }) {
        const auto& error = happened.error();
        using Code = std::remove_cvref_t<decltype(error.code)>;
        const bool late = error.code == Code::Timeout || error.code == Code::NotArmed || error.code == Code::Stopped;
        return testing::AssertionFailure() << (late ? kNotInTime : "") << what << ": " << error.message;
    } else {
        return testing::AssertionFailure() << kNotInTime << what;
    }
}

}  // namespace tacto::test

#define EXPECT_IN_TIME(what) EXPECT_PRED_FORMAT1(tacto::test::inTime, what)
#define ASSERT_IN_TIME(what) ASSERT_PRED_FORMAT1(tacto::test::inTime, what)
