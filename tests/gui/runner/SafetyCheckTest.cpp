// The safety check in its workspace: loads as rows that turn to verdicts, from a click to a report.
#include <gmock/gmock.h>

#include "app/gui/look/Look.h"
#include "app/gui/runner/LoadRows.h"
#include "tests/gui/runner/Lab.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class SafetyCheck : public Lab {
protected:
    ~SafetyCheck() override { gui::applyTheme(gui::Theme::Light); }
    std::string verdictOf(const char* load) { return the<gui::LoadRows>("loadRows").verdictOf(load).toStdString(); }
};

TEST_F(SafetyCheck, LoadsAreRowsThatTurnToVerdicts) {
    open("load-safety");
    ASSERT_TRUE(ready());
    EXPECT_EQ(the<gui::LoadRows>("loadRows").rowCount(), 9);
    EXPECT_THAT(verdictOf("500 ohm"), HasSubstr("to do"));
    type("area", "3");
    type("steps", "2");
    shot(*workspace, "safety_before");
    click(the<QPushButton>("runButton"));
    ASSERT_TRUE(ends());
    EXPECT_THAT(says("verdict").toStdString(), HasSubstr("PASS"));
    for (const char* load : {"100 ohm", "500 ohm", "100 kohm", "open", "short", "200 ohm + 10 kohm || 50 nF"})
        EXPECT_THAT(verdictOf(load), HasSubstr("pass")) << load;
    shot(*workspace, "safety_result");
}

TEST_F(SafetyCheck, WithoutAnElectrodeAreaNoLoadReadsPassed) {
    RecordProperty("hazard", "H9");
    gui::applyTheme(gui::Theme::Dark);
    open("load-safety", {760, 500});
    ASSERT_TRUE(ready());
    type("steps", "2");
    QTest::keyClick(&the<QLineEdit>("steps"), Qt::Key_F5);
    ASSERT_TRUE(ends());
    EXPECT_THAT(says("verdict").toStdString(), HasSubstr("INDETERMINATE"));
    EXPECT_THAT(says("verdictWhy").toStdString(), HasSubstr("the electrode's area is not known"));
    EXPECT_EQ(verdictOf("500 ohm"), "○ not evaluated");
    EXPECT_THAT(verdictOf("open"), HasSubstr("pass"));
    shot(*workspace, "safety_small_dark");
}

TEST_F(SafetyCheck, AStoppedRunLeavesNoRowUndecided) {
    RecordProperty("hazard", "H9");
    gui::LoadRows rows;
    rows.add({{"load", "500 ohm"}, {"impedance_ohm", 499.5}, {"peak_ma", 80.0}});
    EXPECT_THAT(rows.verdictOf("500 ohm").toStdString(), HasSubstr("being measured"));
    rows.end(nullptr);
    for (int row = 0; row < rows.rowCount(); ++row)
        EXPECT_EQ(rows.verdictOf(rows.item(row, 0)->text()), "○ not evaluated");
}

}  // namespace
}  // namespace tacto::test
