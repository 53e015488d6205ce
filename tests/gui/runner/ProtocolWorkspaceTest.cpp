// The workspace of a protocol, used as a person does: from a click to a report.
#include <QSignalSpy>
#include <QTest>
#include <gmock/gmock.h>

#include "app/gui/look/Look.h"
#include "tests/gui/runner/Lab.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class Workspace : public Lab {};

TEST_F(Workspace, RunsSeparabilityFromClickToReport) {
    open("separability");
    ASSERT_TRUE(ready());
    shot(*workspace, "before");
    auto& repeats = the<QLineEdit>("repeats");
    repeats.selectAll();
    QTest::keyClicks(&repeats, "2");
    click(the<QPushButton>("runButton"));
    ASSERT_TRUE(comesTrue([this] { return ended != nullptr; }, 60'000));
    ASSERT_TRUE(comesTrue([this] { return says("verdict").contains("INDETERMINATE"); }));
    EXPECT_THAT(says("verdictWhy").toStdString(), HasSubstr("fewer than 73 trials"));
    ASSERT_TRUE(comesTrue([this] { return the<QPushButton>("Open the report").isEnabled(); }, 60'000));
    shot(*workspace, "result");
    click(the<QPushButton>("Open the report"));
    EXPECT_GT(std::filesystem::file_size(ended->pdf), 10'000U);
    shot(*workspace, "report");
}

}  // namespace
}  // namespace tacto::test
