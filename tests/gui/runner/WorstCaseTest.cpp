// Tests the worst case that is shown with a run's limits before the run begins.
#include <QCoreApplication>
#include <QElapsedTimer>
#include <QProcess>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/gui/runner/WorstPage.h"
#include "tests/gui/runner/Lab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

/// The command line's result for the strongest command of the shipped profile.
nlohmann::json encoded(const std::string& ohms) {
    QProcess cli;
    cli.start(
        QCoreApplication::applicationDirPath() + "/tactoscope-cli",
        {"encode", "--roughness", "1", "--pressure-pa", "60000", "--load", QString::fromStdString(ohms), "--json"});
    if (!cli.waitForFinished(60'000)) return nullptr;
    return nlohmann::json::parse(cli.readAllStandardOutput().toStdString(), nullptr, false);
}

TEST(WorstCase, NamesTheLimitThatIsBrokenAndIsQuickEnoughForTheWindow) {
    const auto profile = shippedProfile().value();
    const auto limits = shippedLimits().value();
    QElapsedTimer timer;
    timer.start();
    const auto kept = gui::worstCase(profile, limits.sets, "1000 ohm").value();
    EXPECT_IN_TIME(timer.elapsed() < 100) << "it is worked out on the window's thread";
    EXPECT_TRUE(kept.refused.isEmpty()) << kept.refused.toStdString();
    EXPECT_GT(kept.rows.size(), 5U);
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "10 ohm").value().refused.isEmpty());
    EXPECT_FALSE(gui::worstCase(profile, limits.sets, "nonsense"));
    RecordProperty("microseconds", int(timer.nsecsElapsed() / 3000));
}

TEST(WorstCase, IsWhatTheCommandLineSays) {
    RecordProperty("hazard", "H1");
    const auto profile = shippedProfile().value();
    const auto limits = shippedLimits().value();
    int refused = 0;
    for (const std::string ohms : {"50", "100", "150", "200", "500", "1000", "10000"}) {
        const auto said = encoded(ohms);
        ASSERT_TRUE(said.is_object()) << ohms;
        const auto shown = gui::worstCase(profile, limits.sets, ohms + " ohm").value().refused.toStdString();
        EXPECT_EQ(said["approved"].get<bool>(), shown.empty()) << ohms << ": " << shown;
        if (shown.empty()) continue;
        ++refused;
        // Both texts begin with the quantity that exceeds its limit.
        const auto refusal = said["refusal"].get<std::string>();
        EXPECT_EQ(shown.substr(0, shown.find(" would be")), refusal.substr(0, refusal.find(" would be"))) << ohms;
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, 7);
}

}  // namespace
}  // namespace tacto::test
