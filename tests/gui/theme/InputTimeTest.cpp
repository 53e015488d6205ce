#include <gtest/gtest.h>

#include "app/gui/theme/ConfirmButton.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;

TEST(InputTime, IsTheEventsWhereItIsOfTheSameClock) {
    const gui::SteadyTime arrival{5'000'000ms};
    EXPECT_EQ(gui::timeOf(4'999'988, arrival), arrival - 12ms);
    EXPECT_EQ(gui::timeOf(17, arrival), arrival) << "another clock";
    EXPECT_EQ(gui::timeOf(5'000'400, arrival), arrival) << "a time to come";
    const gui::SteadyTime late{(1LL << 32) * 1ms + 3ms};  // X's time has 32 bits
    EXPECT_EQ(gui::timeOf(0xFFFFFFFBULL, late), late - 8ms);
}

}  // namespace
}  // namespace tacto::test
