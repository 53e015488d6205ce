// The mask: captures inside and outside of it are counted from its making or its reset on.
#include <gtest/gtest.h>

#include "app/gui/scope/panels/MaskPanel.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

TEST(MaskPanel, AResetCountsNoCaptureFromBefore) {
    gui::MaskPanel panel;
    panel.make(prepared(twoPulses()));
    const auto judged = [&] {
        auto shown = std::const_pointer_cast<gui::ShownCapture>(prepared(twoPulses(99.999, 30)));
        shown->judgedBy = panel.mask();
        shown->mask = panel.mask()->check(*shown->capture);
        return shown;
    };
    const auto underWay = judged();
    panel.take(judged());
    ASSERT_EQ(panel.counts().outside, 1U);
    panel.resetCounts();
    panel.take(underWay);
    EXPECT_EQ(panel.counts().judged(), 0U);
    EXPECT_EQ(panel.alarm(), "");
    EXPECT_EQ(panel.firstOutside(), nullptr);
    panel.take(judged());
    EXPECT_EQ(panel.counts().outside, 1U) << "the test goes on with the same band";
}

}  // namespace
}  // namespace tacto::test
