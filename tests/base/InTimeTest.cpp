// A missed deadline is told apart from every other failure: only it may be tried again.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "tests/support/InTime.h"

namespace tacto::test {

TEST(InTime, AMissedDeadlineBeginsItsMessageByThatAndNoOtherFailureDoes) {
    testing::TestPartResultArray failures;
    {
        const testing::ScopedFakeTestPartResultReporter catching(&failures);
        EXPECT_IN_TIME(1 > 2) << "after two seconds";
        EXPECT_TRUE(1 > 2);
        EXPECT_IN_TIME(2 > 1);
    }
    ASSERT_EQ(failures.size(), 2);
    EXPECT_EQ(std::string_view(failures.GetTestPartResult(0).message()).find(kNotInTime), 0U);
    EXPECT_NE(std::string_view(failures.GetTestPartResult(0).message()).find("after two seconds"), std::string::npos);
    EXPECT_NE(std::string_view(failures.GetTestPartResult(1).message()).find(kNotInTime), 0U);
}

}  // namespace tacto::test
