// Tests how the window shows texts of the core.
#include <gtest/gtest.h>

#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"

namespace tacto::gui {
namespace {

TEST(MinutesText, HasSixtySecondsToAMinute) {
    EXPECT_EQ(minutesText(0), "0:00.0");
    EXPECT_EQ(minutesText(62.3), "1:02.3");
    EXPECT_EQ(minutesText(59.94), "0:59.9");
    EXPECT_EQ(minutesText(59.97), "1:00.0") << "and not 0:60.0";
}

TEST(WithoutScriptPlace, SaysNothingOfFilesAndLines) {
    const std::pair<const char*, const char*> errors[] = {
        {"pilot-thresholds.js:12: stopped by operator (Esc), at this line or after it", "stopped by operator (Esc)"},
        {"load 3: load-safety.js:66: the load is open", "load 3: the load is open"},
        {"nothing is connected", "nothing is connected"},
    };
    for (const auto& [error, shown] : errors) EXPECT_EQ(withoutScriptPlace(error).toStdString(), shown);
}

}  // namespace
}  // namespace tacto::gui
