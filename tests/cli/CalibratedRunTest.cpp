// From a calibration that is kept to the runs that it then serves: applied, checked, said in the report, superseded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/RunCli.h"

namespace tacto::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class CalibratedRun : public ::testing::Test {
protected:
    /// On a stimulator that delivers 3 % less than it is told. Its JSON.
    [[nodiscard]] Json run(Words words) {
        const Words device{"--device", "sim:stimulator?gain=0.97", "--device", "sim:", "--json",
                           "--out",    desk.at("sessions")};
        words.insert(words.begin(), "run");
        words.insert(words.end(), device.begin(), device.end());
        const auto ran = desk.run(words);
        EXPECT_TRUE(Json::accept(ran.out)) << ran.err;
        return Json::accept(ran.out) ? Json::parse(ran.out) : Json::object();
    }
    [[nodiscard]] double roughAmplitude() {
        const Json separability = run({"separability", "--set", "source=direct", "--set", "repeats=25"});
        for (const auto& condition : separability["results"]["conditions"]) {
            if (condition["name"] == "rough-low") return condition["amplitude_v"]["mean"].get<double>();
        }
        return 0;
    }
    [[nodiscard]] Json calibrate() {
        return run({"stimulator-calibration", "--set", "quantities=amplitude", "--set", "store=yes"});
    }
    /// As the report of a session says it.
    [[nodiscard]] std::string calibrationIn(const Json& session) {
        const auto ran = desk.run({"report", session.get<std::string>(), "--out", desk.at("r.html")});
        EXPECT_EQ(ran.code, 0) << ran.err;
        const auto page = contentOf(desk.path() / "r.html");
        const auto from = page.find("<dt>Stimulator calibration</dt>");
        return from == std::string::npos ? "" : page.substr(from, 300);
    }
    Desk desk;
};

TEST_F(CalibratedRun, ACalibrationThatIsKeptIsAppliedFromThenOn) {
    RecordProperty("hazard", "H1");
    EXPECT_NEAR(roughAmplitude(), 40 * 0.97, 0.15);
    const Json kept = calibrate();
    EXPECT_NEAR(kept["results"]["amplitude"]["gain"].get<double>(), 0.97, 0.004);
    EXPECT_THAT(calibrationIn(kept["session"]), HasSubstr("not calibrated: stimulator SIM-1"));
    EXPECT_NEAR(roughAmplitude(), 40, 0.15);

    // A newer one sees the stimulator as it is, not what the older one makes of it.
    const Json newer = calibrate();
    EXPECT_NEAR(newer["results"]["amplitude"]["gain"].get<double>(), 0.97, 0.004);
    EXPECT_TRUE(newer["results"]["stored"]["supersedes"].is_string());
    const auto& first = newer["results"]["amplitude"]["levels"].front();
    EXPECT_NEAR(first["commanded"].get<double>(), 10, 1e-9) << "told as it is";
    EXPECT_THAT(calibrationIn(newer["session"]), HasSubstr("left aside"));
}

TEST_F(CalibratedRun, EveryReportSaysWhichCalibrationHolds) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(calibrate()["results"]["stored"].is_object());
    const Json live = run({"live", "--set", "duration=2"});
    ASSERT_TRUE(live.contains("session"));
    EXPECT_THAT(calibrationIn(live["session"]), HasSubstr("; applied"));
}

}  // namespace
}  // namespace tacto::test
