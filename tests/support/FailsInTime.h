// FailsInTime.h - assertions about why something fails on the machine's clock.
//
// A machine that stands still turns an expected error into one of three others: the answer came too late (Timeout), the
// output is off by then (NotArmed), or the work was ended (Stopped). Only these are a missed deadline as InTime.h has
// it; any other error is wrong however late it comes.
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
