// A board that encodes, from the command line: sensor compare, and whole runs in which the bench plays its trains.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/Shape.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

TEST(SensorCompare, FindsTheSameInARecordingAsTheBoardWould) {
    RecordProperty("hazard", "H1");
    const Desk desk;
    const auto recording = (sourceDir() / "resources" / "examples" / "four-touches").string();
    const auto ran = desk.run({"sensor", "compare", recording, "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    expectKeys(value,
               {"frames", "trains", "max_dR", "max_dP", "max_dA_pct", "max_onset_s", "refused_alike", "unlike",
                "simulated", "verdict"},
               "compare");
    EXPECT_GT(value["frames"], 500);
    EXPECT_GT(value["trains"], 3);
    EXPECT_LE(value["max_dR"], 0.01);
    EXPECT_LE(value["max_dP"], 0.002);
    EXPECT_LE(value["max_dA_pct"], 0.5);
    EXPECT_LE(value["max_onset_s"], 0.00025);
    EXPECT_EQ(value["refused_alike"], true);
    EXPECT_EQ(value["verdict"], "pass");
    const auto said = desk.run({"sensor", "compare", recording});
    EXPECT_EQ(said.code, 0);
    for (const auto* part : {"SIMULATED", "roughness R", "0.25 ms", "pass"}) EXPECT_THAT(said.out, HasSubstr(part));
}

TEST(SensorCompare, SaysWhatItCannotCompare) {
    const Desk desk;
    const auto still = desk.run({"sensor", "compare", "sim:finger?force=0N", "--seconds", "3", "--json"});
    EXPECT_EQ(still.code, 5) << still.err;
    EXPECT_EQ(jsonOf(still)["verdict"], "indeterminate");
    expectRefused(desk.run({"sensor", "compare", "sim:finger?rate=8000"}), 3, {"4007 Hz"});
    expectRefused(desk.run({"sensor", "compare", "sim:stimulator"}), 3, {"sensor"});
}

TEST(SensorCompare, ComparesWhatABoardSends) {
    RecordProperty("hazard", "H1");
    const Desk desk;
    const auto ran = desk.run({"sensor", "compare", "sim:board?material=P120&drift=50", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto value = jsonOf(ran);
    EXPECT_GT(value["frames"], 1000);
    EXPECT_GT(value["trains"], 5);
    EXPECT_LE(value["max_dR"], 0.02);
    EXPECT_LE(value["max_dP"], 0.005);
    const auto bytes = desk.at("board.bin");
    const auto shipped = (sourceDir() / "resources" / "encodings" / "default.json").string();
    ASSERT_EQ(desk.run({"firmware-profile", shipped, "--load", "500", "--out", bytes}).code, 0);
    expectRefused(desk.run({"sensor", "compare", "sim:board?profile=" + bytes}), 3, {"hash", "was expected"});
}

TEST(RunOnABoard, ItsTrainsAreDeliveredAsOurOwnWouldBe) {
    RecordProperty("hazard", "H1");
    const Desk desk;
    const auto live = [&](const std::string& finger) {
        const auto ran =
            desk.run({"run", "live", "--device", finger, "--device", "sim:", "--out", desk.at("out"), "--json"});
        EXPECT_EQ(ran.code, 0) << ran.err;
        const auto value = jsonOf(ran);
        EXPECT_EQ(desk.run({"verify", value["session"]}).code, 0);
        return value["results"];
    };
    const auto ours = live("sim:finger?material=P120"), boards = live("sim:board?material=P120");
    const auto delivered = ours["trains_delivered"].get<int>();
    EXPECT_GT(delivered, 5);
    EXPECT_NEAR(boards["trains_delivered"].get<int>(), delivered, 1) << boards << ours;
    EXPECT_EQ(boards["trains_refused"], 0) << boards;
}

TEST(RunOnABoard, ABoardWithAnotherProfileIsNamedBeforeArming) {
    RecordProperty("hazard", "H12");
    const Desk desk;
    const auto bytes = desk.at("board.bin");
    const auto shipped = (sourceDir() / "resources" / "encodings" / "default.json").string();
    ASSERT_EQ(desk.run({"firmware-profile", shipped, "--load", "300", "--out", bytes}).code, 0);
    const auto ran = desk.run({"run", "live", "--device", "sim:board?profile=" + bytes, "--device", "sim:", "--out",
                               desk.at("out"), "--json"});
    EXPECT_NE(ran.code, 0);
    EXPECT_THAT(ran.err, testing::AllOf(HasSubstr("not armed"), HasSubstr("hash")));
}

}  // namespace
}  // namespace tacto::test
