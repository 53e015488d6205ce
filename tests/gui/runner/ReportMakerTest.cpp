// Tests reports that a child process draws.
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <set>

#include "app/gui/runner/ReportMaker.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

/// The processes that this thread has started and that still run: the reader of declarations keeps one.
std::set<int> children() {
    std::ifstream all("/proc/thread-self/children");
    return {std::istream_iterator<int>(all), {}};
}

TEST(ReportMaker, TellsWhyThereIsNoReport) {
    gui::ReportMaker maker;
    QString why;
    QObject::connect(&maker, &gui::ReportMaker::failed, [&](const QString& said) { why = said; });
    maker.make("/nowhere/at/all.tacto", "/tmp/never.pdf");
    EXPECT_TRUE(maker.busy());
    ASSERT_IN_TIME(comesTrue([&] { return !why.isEmpty(); }, 30'000));
    EXPECT_THAT(why.toStdString(), HasSubstr("/nowhere/at/all.tacto"));
    EXPECT_FALSE(maker.busy());
}

TEST(ReportMaker, CancelEndsItAndSaysSo) {
    gui::ReportMaker maker;
    QStringList said;
    QObject::connect(&maker, &gui::ReportMaker::failed, [&](const QString& why) { said << why; });
    const QTemporaryDir folder;
    const auto before = children();
    maker.make("/nowhere/at/all.tacto", folder.filePath("never.pdf"));
    auto made = children();
    for (const int other : before) made.erase(other);
    ASSERT_EQ(made.size(), 1U);
    const auto half = folder.filePath(QString(".tactoscope-%1-1").arg(*made.begin()));
    std::ofstream(half.toStdString()) << "half a report";
    maker.make("/nowhere/at/all.tacto", folder.filePath("never.html"));
    maker.cancel();
    EXPECT_FALSE(QFileInfo::exists(half));
    EXPECT_FALSE(maker.busy());
    ASSERT_EQ(said.size(), 1);
    EXPECT_THAT(said.first().toStdString(), HasSubstr("cancelled"));
}

}  // namespace
}  // namespace tacto::test
