// A kept calibration and the later runs that use it: applied, checked, stated in the report, superseded.
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
    /// Returns the JSON of a run. Its stimulator delivers less than programmed, longer phases and shorter gaps; the
    /// computer's clock is slow by 0.3 % compared with the oscilloscope.
    [[nodiscard]] Json run(Words words) {
        const Words device{"--device",         "sim:stimulator?gain=0.97&widtherror=5.2us&gaperror=-7.5us",
                           "--device",         "sim:oscilloscope?timebase=1.003",
                           "--device",         "sim:",
                           "--json",           "--out",
                           desk.at("sessions")};
        words.insert(words.begin(), "run");
        words.insert(words.end(), device.begin(), device.end());
        const auto ran = desk.run(words);
        EXPECT_TRUE(Json::accept(ran.out)) << ran.err;
        return Json::accept(ran.out) ? Json::parse(ran.out) : Json::object();
    }
    /// Returns the oscilloscope's reading of rough-high: 40 V and 0.5 s, 200 us and 100 us.
    [[nodiscard]] Json delivered() {
        std::ofstream(desk.path() / "probe.js") << R"(
protocol({ title: "Probe", purpose: "What comes out", needs: ["stimulator", "oscilloscope"] });
function run() {
  bench.arm({ load: 1000 });
  bench.drive("manual", { roughness: 1, pressure: 1 });
  const reading = measure.pulse(bench.capture({ trains: 4, rate_hz: 2e6, voltage_range_v: 52 }));
  bench.disarm();
  return verdict({ verdict: null, reading });
})";
        return run({desk.at("probe.js")})["results"]["reading"];
    }
    [[nodiscard]] Json calibrate() { return run({"stimulator-calibration", "--set", "store=yes"}); }
    /// Returns the calibration as stated in the report of a session.
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
    const Json before = delivered();
    EXPECT_NEAR(before["amplitude"].get<double>(), 40 * 0.97, 0.15);
    EXPECT_NEAR(before["interval_s"].get<double>(), 0.5 * 1.003, 2e-5);
    EXPECT_NEAR(before["width_s"].get<double>(), 205.2e-6 * 1.003, 0.3e-6);
    EXPECT_NEAR(before["gap_s"].get<double>(), 92.5e-6 * 1.003, 0.3e-6);
    const Json kept = calibrate();
    EXPECT_NEAR(kept["results"]["amplitude"]["gain"].get<double>(), 0.97, 0.004);
    EXPECT_NEAR(kept["results"]["interval"]["gain"].get<double>(), 1.003, 1e-4);
    EXPECT_NEAR(kept["results"]["width"]["offset"].get<double>(), 5.2e-6 * 1.003, 0.4e-6);
    EXPECT_NEAR(kept["results"]["gap"]["offset"].get<double>(), -7.5e-6 * 1.003, 0.4e-6);
    EXPECT_THAT(calibrationIn(kept["session"]), HasSubstr("not calibrated: stimulator SIM-1"));
    const Json after = delivered();
    EXPECT_NEAR(after["amplitude"].get<double>(), 40, 0.15);
    EXPECT_NEAR(after["interval_s"].get<double>(), 0.5, 2e-5);
    // As close as the device's step of 1 us allows, on the lower side.
    EXPECT_NEAR(after["width_s"].get<double>(), 200e-6, 0.4e-6);
    EXPECT_NEAR(after["gap_s"].get<double>(), 100e-6, 0.4e-6);

    // A newer calibration measures the stimulator without the older calibration's correction.
    const Json newer = calibrate();
    EXPECT_NEAR(newer["results"]["amplitude"]["gain"].get<double>(), 0.97, 0.004);
    EXPECT_TRUE(newer["results"]["stored"]["supersedes"].is_string());
    const auto& first = newer["results"]["amplitude"]["levels"].front();
    EXPECT_NEAR(first["commanded"].get<double>(), 10, 1e-9) << "programmed as it is";
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
