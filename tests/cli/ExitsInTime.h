// ExitsInTime.h - assertions about the exit code of a program that runs by the machine's clock.
//
// A machine that stands still turns an expected exit code into another outcome of the run: the stop came too late (0),
// the verdict is another (1), a device did not answer (3), the output was switched off (4), or the program took longer
// than the test allows and was killed (-9). Only these are a missed deadline as InTime.h has it; a command line that is
// refused (2) and a program that another signal ended are not.
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
