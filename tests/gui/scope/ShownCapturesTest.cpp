// The captures on the screen and behind it, and the moments that were marked between them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/scope/model/ScopeMarks.h"
#include "app/gui/scope/model/ShownCaptures.h"
#include "tests/gui/scope/Captures.h"

namespace tacto::test {
namespace {

using gui::ScopeMarks;
using gui::ShownCaptures;
using testing::IsEmpty;
using testing::SizeIs;

gui::ShownPtr benchs(double start_s) { return prepared(twoPulses(start_s)); }

gui::ShownPtr filed(double start_s) {
    auto file = std::make_shared<gui::ShownCapture>(*benchs(start_s));
    file->source = "old.csv";
    return file;
}

TEST(ShownCaptures, TheBenchsStandBehindOneAnotherAndAFileBeginsAnew) {
    ShownCaptures captures;
    const auto first = benchs(1), second = benchs(2);
    captures.show(first);
    EXPECT_THAT(captures.behind(), IsEmpty());
    EXPECT_TRUE(captures.isFollowedBy(*second));
    captures.show(second);
    EXPECT_EQ(captures.newest(), second);
    ASSERT_THAT(captures.behind(), SizeIs(1));
    EXPECT_EQ(captures.behind().front(), first);
    const auto file = filed(3);
    EXPECT_FALSE(captures.isFollowedBy(*file));
    captures.show(file);
    EXPECT_THAT(captures.behind(), IsEmpty());
    captures.show(benchs(4));
    EXPECT_THAT(captures.behind(), IsEmpty());
}

TEST(ShownCaptures, MoreStayInRollModeThanBehindAScreen) {
    ShownCaptures captures;
    captures.setRoll(true);
    for (int i = 0; i < ShownCaptures::kMaxBehind + 5; ++i) captures.show(benchs(i));
    EXPECT_THAT(captures.behind(), SizeIs(ShownCaptures::kMaxBehind + 4));
    captures.setRoll(false);
    EXPECT_THAT(captures.behind(), SizeIs(ShownCaptures::kMaxBehind));
    captures.setPersistence(1000);
    EXPECT_EQ(captures.persistence(), ShownCaptures::kMaxBehind);
}

TEST(ScopeMarks, AreOnTheAxisWhereItReachesThem) {
    ScopeMarks marks;
    marks.add({10, "early"});
    marks.add({20, "late"});
    const auto seen = marks.between(-1, 5, 16);
    ASSERT_THAT(seen, SizeIs(1));
    EXPECT_EQ(seen.front().word, "late");
    EXPECT_DOUBLE_EQ(seen.front().at_s, 4);
}

TEST(ScopeMarks, TheNewestIsANoteWhereNoCaptureHoldsIt) {
    const auto before = benchs(1), shown = benchs(2);
    const auto noteOf = [&](double at_s) {
        ScopeMarks marks;
        marks.add({at_s, "knock"});
        return marks.beside(*shown, before.get());
    };
    EXPECT_EQ(noteOf(1.5), "before it: “knock”");
    EXPECT_EQ(noteOf(3), "after it: “knock”");
    EXPECT_EQ(noteOf(2.005), "");
    EXPECT_EQ(noteOf(0.5), "");
}

TEST(ScopeMarks, TheOldestGo) {
    ScopeMarks marks;
    for (std::size_t i = 0; i <= ScopeMarks::kMaxKept; ++i) marks.add({static_cast<double>(i), "m"});
    EXPECT_THAT(marks.between(0, 1e9, 0), SizeIs(ScopeMarks::kMaxKept));
    EXPECT_THAT(marks.between(0, 0.5, 0), IsEmpty());
}

}  // namespace
}  // namespace tacto::test
