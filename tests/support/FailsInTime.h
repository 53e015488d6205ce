// FailsInTime.h - assertions about why something fails, for tests on the computer's real clock.
//
// If the computer stalls, an expected error turns into one of three others: the answer came too late (Timeout), the
// output was already off (NotArmed), or the work was ended (Stopped). Only these count as a missed deadline in the
// sense of InTime.h; any other error is wrong, however late it comes.
//
// Thread-safety: as gtest's assertions.
#pragma once

#include <gtest/gtest.h>

#include "core/base/Result.h"
#include "tests/support/InTime.h"

namespace tacto::test {

[[nodiscard]] inline testing::AssertionResult failsInTime(const char* what, const char* expected, ErrorCode code,
                                                          ErrorCode wanted) {
    if (code == wanted) return testing::AssertionSuccess();
    const bool late = code == ErrorCode::Timeout || code == ErrorCode::NotArmed || code == ErrorCode::Stopped;
    return testing::AssertionFailure() << (late ? kNotInTime : "") << what << " is " << static_cast<int>(code)
                                       << ", not " << expected;
}

}  // namespace tacto::test

#define EXPECT_CODE_IN_TIME(code, wanted) EXPECT_PRED_FORMAT2(tacto::test::failsInTime, code, wanted)
#define ASSERT_CODE_IN_TIME(code, wanted) ASSERT_PRED_FORMAT2(tacto::test::failsInTime, code, wanted)
