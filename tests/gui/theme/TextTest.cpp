// Tests how the window shows texts of the core.
#include <gtest/gtest.h>

#include "app/gui/theme/Text.h"

namespace tacto::gui {
namespace {

TEST(MinutesText, HasSixtySecondsToAMinute) {
    EXPECT_EQ(minutesText(0), "0:00.0");
    EXPECT_EQ(minutesText(62.3), "1:02.3");
    EXPECT_EQ(minutesText(59.94), "0:59.9");
    EXPECT_EQ(minutesText(59.97), "1:00.0") << "and not 0:60.0";
}

}  // namespace
}  // namespace tacto::gui
