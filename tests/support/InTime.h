// InTime.h - assertions about deadlines, kept apart from assertions about what must never happen.
//
// A computer that stalls makes a program late, but cannot make it deliver a train after a stop. On the real clock,
// everything that must happen has a deadline (for example, a status that comes 50 ms late rightly switches the bench
// off); what must not happen has none. If a test fails only by EXPECT_IN_TIME or ASSERT_IN_TIME and the computer
// stalled, it is tried again; any other failure is final. If support/Standstill.cpp, which does this, is linked, an
// ASSERT_IN_TIME also ends the test from within a function that the test calls.
//
// A Result counts as a missed deadline only if lateness can cause its error: no answer in time (Timeout), output
// already off (NotArmed), or the work ended (Stopped). A silent control loop, an expired approval and a watchdog that
// stopped the output are Timeout. Every other error, above all a device's, is wrong, however late it comes.
//
// Thread-safety: as gtest's assertions.
#pragma once

#include <gtest/gtest.h>
#include <type_traits>

namespace tacto::test {

/// How the message of a missed deadline begins.
inline constexpr const char* kNotInTime = "not in time: ";

/// `happened` is a bool or a Result; the error of a Result is shown.
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
