// InTime.h - assertions about how late something may come, kept apart from assertions about what may never happen.
//
// A machine that stands still makes a program late; it cannot make it deliver a train after a stop. A test that failed
// by EXPECT_IN_TIME or ASSERT_IN_TIME alone is tried again where the machine stood still (support/Standstill.cpp); any
// other failure is one.
//
// Thread-safety: as gtest's assertions.
#pragma once

#include <gtest/gtest.h>

namespace tacto::test {

/// What the message of a missed deadline begins with.
inline constexpr const char* kNotInTime = "not in time: ";

[[nodiscard]] inline testing::AssertionResult inTime(const char* what, bool happened) {
    if (happened) return testing::AssertionSuccess();
    return testing::AssertionFailure() << kNotInTime << what;
}

}  // namespace tacto::test

#define EXPECT_IN_TIME(what) EXPECT_PRED_FORMAT1(tacto::test::inTime, static_cast<bool>(what))
#define ASSERT_IN_TIME(what) ASSERT_PRED_FORMAT1(tacto::test::inTime, static_cast<bool>(what))
