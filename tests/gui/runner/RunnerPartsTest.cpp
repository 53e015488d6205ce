// Parts of the runner by themselves: time left, devices as text, values as cells, reports by a child process.
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <gmock/gmock.h>

#include "app/gui/runner/ReportMaker.h"
#include "app/gui/runner/ResultTables.h"
#include "app/gui/runner/RunPanel.h"
#include "app/gui/runner/WiringPanel.h"
#include "app/gui/runner/WorstCase.h"
#include "tests/gui/runner/Lab.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

ScriptProgress at(std::size_t done, std::size_t total = 10) { return {"Steps", done, total}; }

TEST(TimeLeft, IsNotKnownBeforeAStepIsThrough) {
    gui::TimeLeft left;
    left.note(at(0), false, 5);
    EXPECT_FALSE(left.seconds());
    left.note(at(0), false, 7);
    EXPECT_FALSE(left.seconds());
}

TEST(TimeLeft, CountsNeitherWhatCameBeforeTheFirstStepNorPauses) {
    gui::TimeLeft left;
    left.note(at(0), false, 100);
    left.note(at(1), false, 102);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 18);
    left.note(at(1), true, 160);
    left.note(at(2), false, 162);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 16);
    left.note(at(2), false, 163);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 15) << "the step under way has had a second";
}

TEST(TimeLeft, BeginsAnewWithAnotherList) {
    gui::TimeLeft left;
    left.note(at(0), false, 0);
    left.note(at(5), false, 5);
    left.note({"Others", 0, 4}, false, 6);
    EXPECT_FALSE(left.seconds());
}

TEST(DevicesOf, AllowsBlanksInAFolder) {
    const auto uris = gui::devicesOf(" recording:/data/my finger sim:stimulator?gain=1.1  sim: ").value();
    ASSERT_EQ(uris.size(), 3U);
    EXPECT_EQ(uris[0].text(), "recording:/data/my finger");
    EXPECT_EQ(uris[1].text(), "sim:stimulator?gain=1.1");
    EXPECT_FALSE(gui::devicesOf("nonsense"));
}

TEST(ShownValue, KnowsStatisticsSharesAndUnits) {
    EXPECT_EQ(gui::shownValue(nlohmann::json(), "x"), "–");
    EXPECT_EQ(gui::shownValue(true, "x"), "yes");
    EXPECT_THAT(gui::shownValue({{"value", 0.99}, {"low", 0.946}, {"high", 0.998}}, "accuracy").toStdString(),
                HasSubstr("94.6"));
    EXPECT_THAT(gui::shownValue({{"mean", 40.12}, {"sd", 0.46}, {"n", 25}}, "amplitude_v").toStdString(),
                HasSubstr("40.12 ± 0.46"));
}

TEST(WorstCase, NamesTheLimitThatIsBrokenAndIsQuickEnoughForTheWindow) {
    const auto profile = shippedProfile().value();
    const auto limits = shippedLimits().value();
    QElapsedTimer timer;
    timer.start();
    const auto kept = gui::worstCase(profile, limits.sets, "1000 ohm").value();
    EXPECT_LT(timer.elapsed(), 100) << "it is worked out on the window's thread";
    EXPECT_TRUE(kept.refused.isEmpty()) << kept.refused.toStdString();
    EXPECT_GT(kept.rows.size(), 5U);
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "10 ohm").value().refused.isEmpty());
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "nonsense"));
    RecordProperty("microseconds", int(timer.nsecsElapsed() / 3000));
}

TEST(ReportMaker, TellsWhyThereIsNoReport) {
    gui::ReportMaker maker;
    QString why;
    QObject::connect(&maker, &gui::ReportMaker::failed, [&](const QString& said) { why = said; });
    maker.make("/nowhere/at/all.tacto", "/tmp/never.pdf");
    EXPECT_TRUE(maker.busy());
    ASSERT_TRUE(comesTrue([&] { return !why.isEmpty(); }, 30'000));
    EXPECT_THAT(why.toStdString(), HasSubstr("/nowhere/at/all.tacto"));
    EXPECT_FALSE(maker.busy());
}

TEST(ReportMaker, CancelEndsItAndSaysSo) {
    gui::ReportMaker maker;
    QStringList said;
    QObject::connect(&maker, &gui::ReportMaker::failed, [&](const QString& why) { said << why; });
    const QTemporaryDir folder;
    const auto half = folder.filePath("never.pdf.AbCdEf");
    std::ofstream(half.toStdString()) << "half a report";
    maker.make("/nowhere/at/all.tacto", folder.filePath("never.pdf"));
    maker.make("/nowhere/at/all.tacto", folder.filePath("never.html"));
    maker.cancel();
    EXPECT_FALSE(QFileInfo::exists(half));
    EXPECT_FALSE(maker.busy());
    ASSERT_EQ(said.size(), 1);
    EXPECT_THAT(said.first().toStdString(), HasSubstr("cancelled"));
}

}  // namespace
}  // namespace tacto::test
