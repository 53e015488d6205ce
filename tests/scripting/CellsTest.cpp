#include <gtest/gtest.h>
#include <limits>

#include "app/scripting/host/report/Cells.h"

namespace tacto::test {
namespace {

using host::report::digitsOf;

TEST(DigitsOf, WritesOutWhatPeopleRead) {
    EXPECT_EQ(digitsOf(0, 3), "0.00");
    EXPECT_EQ(digitsOf(0.012345, 3), "0.0123");
    EXPECT_EQ(digitsOf(-9.999, 3), "-10.0");
    EXPECT_EQ(digitsOf(999.4, 3), "999");
    EXPECT_EQ(digitsOf(999.6, 3), "1000");
    EXPECT_EQ(digitsOf(1012.7, 3), "1010");
    EXPECT_EQ(digitsOf(123456, 3), "123000");
    EXPECT_EQ(digitsOf(1234567, 3), "1.23e+6");
    EXPECT_EQ(digitsOf(1.5e-9, 2), "1.5e-9");
    EXPECT_EQ(digitsOf(std::numeric_limits<double>::quiet_NaN(), 3), "–");
}

}  // namespace
}  // namespace tacto::test
