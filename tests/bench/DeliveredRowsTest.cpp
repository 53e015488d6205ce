// A session records each train, and the values by which the train was judged.
#include <gtest/gtest.h>

#include "core/session/Origin.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionWriter.h"
#include "tests/bench/BenchFixture.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

class DeliveredRows : public BenchFixture {
protected:
    DeliveredRows() { RecordProperty("hazard", "H8"); }
    /// Records from here on, with a separate clock; the bench's clock stands still meanwhile.
    void record() {
        writer_ = SessionWriter::create(folder_.path() / "run.tacto", {}, sessionClock_).value();
        session_ = writer_.get();
    }
    [[nodiscard]] SessionReader read() {
        bench_.reset();
        EXPECT_TRUE(writer_->close());
        return SessionReader::open(folder_.path() / "run.tacto").value();
    }
    static std::vector<SessionRow> named(const std::vector<SessionRow>& rows, const std::string& name) {
        std::vector<SessionRow> found;
        for (const auto& row : rows)
            if (row.name == name) found.push_back(row);
        return found;
    }
    const ScratchDir folder_;
    VirtualClock sessionClock_;
    std::unique_ptr<SessionWriter> writer_;
};

TEST_F(DeliveredRows, HoldTheWholeTrain) {
    record();
    open({"sim:stimulator?mode=current"});
    auto profile = bench_->profile();
    profile.encoding.train.pulses = 7;
    profile.encoding.train.rate = Hertz(80);
    profile.encoding.train.phaseWidth = Micros(250);
    profile.encoding.train.interPhaseGap = Micros(50);
    profile.encoding.train.polarity = Polarity::Negative;
    ASSERT_TRUE(bench_->setProfile(profile));
    accepted(arm());
    ASSERT_TRUE(bench_->drive(DriveSource::Manual, 1, 1));
    accepted(bench_->wait(Seconds(3)));
    const auto reader = read();
    const auto rows = reader.commands().value();
    const auto trains = named(rows, "delivered");
    ASSERT_GE(trains.size(), 4U);
    for (const auto& row : trains) {
        EXPECT_EQ(row.body["pulses"], 7);
        EXPECT_EQ(row.body["rate_hz"], 80);
        EXPECT_NEAR(row.body["width_s"].get<double>(), 250e-6, 1e-12);
        EXPECT_NEAR(row.body["gap_s"].get<double>(), 50e-6, 1e-12);
        EXPECT_EQ(row.body["text"], "symmetric biphasic, negative phase first");
        EXPECT_NEAR(row.body["amplitude_ma"].get<double>(), 40, 1);
        EXPECT_NEAR(row.body["interval_s"].get<double>(), 0.5, 0.01);
        EXPECT_GT(row.body["approved_until_s"].get<double>(), toSeconds(row.at)) << "by an approval that still held";
    }
    EXPECT_EQ(named(rows, "impedance check").at(0).body["pulses"], 1);
    const auto delivered = deliveredIn(reader).value();
    EXPECT_EQ(delivered.trains, trains.size());
    EXPECT_EQ(delivered.unit, "mA");
    EXPECT_NEAR(delivered.most, 40, 1);
}

TEST_F(DeliveredRows, EveryChangeOfEncodingAndAreaIsAnEvent) {
    record();
    open({"sim:stimulator?mode=current"}, {Role::Stimulator, Role::Oscilloscope}, false, "2 kohm");
    auto profile = bench_->profile();
    profile.electrodeArea = SquareCentimetres(3);
    ASSERT_TRUE(bench_->setProfile(profile));
    accepted(arm("2 kohm"));
    bench_->disarm();
    profile.encoding.amplitudeMax = Volts(30);
    profile.ceilings = {{Quantity::PeakCurrent, 20}};
    ASSERT_TRUE(bench_->setProfile(profile));
    ASSERT_TRUE(bench_->setProfile(profile)) << "which changes nothing";
    profile.electrode = {"TENS 40", "", "hydrogel"};
    ASSERT_TRUE(bench_->setProfile(profile));
    accepted(arm("2 kohm"));
    bench_->disarm();
    profile.electrode->material = "Ag/AgCl";
    ASSERT_TRUE(bench_->setProfile(profile));
    profile.electrode.reset();
    ASSERT_TRUE(bench_->setProfile(profile));
    const auto reader = read();
    const auto events = reader.events().value();
    const auto changes = named(events, "settings");
    ASSERT_EQ(changes.size(), 5U);
    EXPECT_EQ(changes[2].body["changed"], nlohmann::json{"electrode"});
    EXPECT_EQ(changes[2].body["profile"]["electrode"]["name"], "TENS 40");
    EXPECT_EQ(changes[3].body["changed"], nlohmann::json{"electrode.material"});
    EXPECT_EQ(changes[4].body["changed"], nlohmann::json{"electrode"});
    EXPECT_EQ(changes[0].body["changed"], nlohmann::json{"safety.electrode_area_cm2"});
    EXPECT_EQ(changes[0].body["profile"]["safety"]["electrode_area_cm2"], 3);
    EXPECT_EQ(changes[1].body["changed"], (nlohmann::json{"encoding.amplitude_max_v", "safety.ceilings"}));
    const auto arming = named(events, "arming");
    ASSERT_EQ(arming.size(), 2U);
    EXPECT_TRUE(arming[0].body["electrode"].is_null());
    EXPECT_EQ(arming[1].body["electrode"]["medium"], "hydrogel");
    EXPECT_EQ(arming[0].body["load"], "2 kohm");
    EXPECT_EQ(arming[0].body["load_least"], "1.6 kohm");
    EXPECT_EQ(arming[0].body["load_most"], "2.4 kohm");
    EXPECT_EQ(arming[0].body["electrode_area_cm2"], 3);
    EXPECT_EQ(arming[0].body["calibrated"], false);
    EXPECT_GE(arming[0].body["limits"].size(), 3U);
}

TEST_F(DeliveredRows, AResumedOutputIsAnEvent) {
    record();
    open({});
    ASSERT_TRUE(armAndDrive(1, 1));
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    bench_->pause();
    bench_->idle(Seconds(1));
    bench_->resume();
    ASSERT_TRUE(bench_->wait(Seconds(1)));
    std::vector<std::string> states;
    const auto reader = read();
    const auto events = reader.events().value();
    for (const auto& row : named(events, "interlock")) states.push_back(row.body["text"].get<std::string>());
    const auto paused = std::ranges::find(states, "paused");
    ASSERT_NE(paused, states.end());
    ASSERT_NE(paused + 1, states.end()) << "delivered trains would follow a pause";
    EXPECT_EQ(*(paused + 1), "delivering");
}

}  // namespace
}  // namespace tacto::test
