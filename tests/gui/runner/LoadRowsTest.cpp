// Tests the rows of a load-safety check while it runs: what each trial is labelled as.
#include <gtest/gtest.h>

#include "app/gui/runner/LoadRows.h"
#include "app/gui/theme/VerdictBlock.h"

namespace tacto {
namespace {

const QString kLoad = "500 ohm";

TEST(LoadRows, CountsCommandsAndTurnsToTheVerdictOfItsLoad) {
    gui::LoadRows rows;
    const auto before = rows.rowCount();
    rows.add({{"type", "reference"}, {"command_v", 10}});
    rows.add({{"load", "500 ohm"}, {"verdict", "pass"}});
    EXPECT_EQ(rows.verdictOf(kLoad), "○ to do") << "neither says that it is of a load";
    rows.add({{"type", "command"}, {"load", "500 ohm"}, {"command_v", 10}, {"impedance_ohm", 501}});
    rows.add({{"type", "command"}, {"load", "500 ohm"}, {"command_v", 20}, {"impedance_ohm", 502}});
    EXPECT_EQ(rows.verdictOf(kLoad), "◔ being measured");
    rows.add({{"type", "load"}, {"load", "500 ohm"}, {"verdict", "fail"}, {"measured_ohm", 502}});
    EXPECT_EQ(rows.verdictOf(kLoad), gui::verdictText("fail"));
    rows.end({{"loads", {{{"name", "500 ohm"}, {"verdict", "indeterminate"}}}}});
    EXPECT_EQ(rows.verdictOf(kLoad), gui::verdictText("indeterminate")) << "the results have the last word";
    EXPECT_EQ(rows.rowCount(), before);
    rows.end(nullptr);
    EXPECT_EQ(rows.verdictOf("1 kohm"), gui::verdictText("not evaluated"));
}

}  // namespace
}  // namespace tacto
