// ExitsInTime.h - assertions about the exit code of a program that uses the real clock.
//
// On a machine that stands still, an expected exit code turns into another outcome: the stop came too late (0), the
// verdict differs (1), a device did not answer (3), the output was switched off (4), or the program was killed after
// the test's time limit (-9). Only these are missed deadlines as defined in InTime.h; a refused command line (2) or the
// end by another signal is not.
//
// Thread-safety: as gtest's assertions.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/InTime.h"

namespace tacto::test {

[[nodiscard]] inline testing::AssertionResult exitsInTime(const char* what, const char* /*expected*/, int code,
                                                          int wanted) {
    if (code == wanted) return testing::AssertionSuccess();
    const bool late = code == 0 || code == 1 || code == 3 || code == 4 || code == -9;
    return testing::AssertionFailure() << (late ? kNotInTime : "") << what << " is " << code << ", not " << wanted;
}

}  // namespace tacto::test

#define ASSERT_EXIT_IN_TIME(code, wanted) ASSERT_PRED_FORMAT2(tacto::test::exitsInTime, code, wanted)
