// A board that encodes, from the command line: sensor compare, and whole runs in which the bench plays its trains.
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/Random.h"
#include "core/bench/Profile.h"
#include "core/encoding/Encoder.h"
#include "core/session/SessionReader.h"
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
               {"frames", "trains", "max_dR", "max_dP", "max_dA_pct", "max_onset_s", "refused_alike", "lost", "unlike",
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
    EXPECT_LE(value["max_dR"], 0.01);
    EXPECT_LE(value["max_dP"], 0.002);
    EXPECT_LE(value["max_dA_pct"], 0.5);
    EXPECT_LE(value["max_onset_s"], 0.00025);
    const auto bytes = desk.at("board.bin");
    const auto shipped = (sourceDir() / "resources" / "encodings" / "default.json").string();
    ASSERT_EQ(desk.run({"firmware-profile", shipped, "--load", "500", "--out", bytes}).code, 0);
    expectRefused(desk.run({"sensor", "compare", "sim:board?profile=" + bytes}), 3,
                  {"hash", "voltage source of up to 60 V into 1000 ohm, was expected"});
}

TEST(SensorCompare, JudgesABoardForItsOwnLoadAndStimulator) {
    RecordProperty("hazard", "H1");
    const Desk desk;
    const auto shipped = (sourceDir() / "resources" / "encodings" / "default.json").string();
    for (const std::vector<std::string>& bench :
         {std::vector<std::string>{"--load", "500", "--device", "sim:stimulator?mode=current&step=0.1mA"},
          {"--load", "700", "--source", "current", "--largest", "80", "--step", "0.25"},
          {"--load", "700"}}) {
        const auto bytes = desk.at("board.bin");
        std::vector<std::string> writes{"firmware-profile", shipped, "--out", bytes};
        writes.insert(writes.end(), bench.begin(), bench.end());
        ASSERT_EQ(desk.run(writes).code, 0);
        std::vector<std::string> compares{"sensor", "compare", "sim:board?material=P120&profile=" + bytes, "--json"};
        compares.insert(compares.end(), bench.begin(), bench.end());
        const auto ran = desk.run(compares);
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(jsonOf(ran)["verdict"], "pass");
        compares.at(compares.size() - bench.size() + 1) = "400";
        expectRefused(desk.run(compares), 3, {"hash", "into 400 ohm, was expected"});
    }
    expectRefused(desk.run({"sensor", "compare", "sim:board", "--device", "sim:stimulator"}), 2, {"--load is missing"});
    expectRefused(desk.run({"sensor", "compare", "sim:board", "--load", "500", "--device", "sim:finger"}), 2,
                  {"--device", "stimulator"});
    expectRefused(desk.run({"sensor", "status", "--load", "500"}), 2, {"--load", "compare"});
}

TEST(Devices, ListTheSimulatedBoard) {
    const Desk desk;
    const auto devices = jsonOf(desk.run({"devices", "--json"}));
    const auto board = std::ranges::find_if(devices, [](const auto& one) { return one["uri"] == "sim:board"; });
    ASSERT_NE(board, devices.end());
    EXPECT_EQ((*board)["kind"], "sensor");
    EXPECT_EQ((*board)["simulated"], true);
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

/// A run, and what its session tells of it.
struct Whole {
    Json said;
    SessionReader session;
    std::vector<SessionRow> trains, byFinger;  ///< all that were sent, and those of a finger that drove
    std::size_t written = 0;                   ///< how often the board's encoder began with another profile
};

Whole runOf(const Desk& desk, const std::string& protocol, const std::string& finger, std::uint64_t seed,
            const Words& settings) {
    Words words{"run", protocol, "--device", finger, "--device", "sim:", "--json"};
    words.insert(words.end(),
                 {"--seed", std::to_string(seed), "--out", desk.at(finger.substr(4) + std::to_string(seed))});
    for (const auto& setting : settings) words.insert(words.end(), {"--set", setting});
    const auto ran = desk.run(words);
    EXPECT_EQ(ran.code, 0) << protocol << finger << ran.err << ran.out.substr(0, 2000);
    const auto result = jsonOf(ran);
    Whole whole{result, SessionReader::open(result["session"].get<std::string>()).value(), {}, {}, 0};
    auto rows = whole.session.commands().value();
    const auto events = whole.session.events().value();
    rows.insert(rows.end(), events.begin(), events.end());
    std::ranges::sort(rows, {}, &SessionRow::seq);
    bool armed = false, driven = false;
    for (const auto& row : rows) {
        const auto said = row.body.find("text");
        const std::string text = said != row.body.end() && said->is_string() ? *said : "";
        if (row.name == "interlock") armed = !text.starts_with("disarmed");
        if (row.name == "drive") driven = text == "sensor";
        if (row.name == "board encodes") {
            ++whole.written;
            EXPECT_FALSE(armed) << "its profile was written at " << toSeconds(row.at);
        }
        if (row.name != "train") continue;
        whole.trains.push_back(row);
        if (driven) whole.byFinger.push_back(row);
    }
    return whole;
}

/// The rows of the stream of that kind: "frames" are the bench's own, "board_frames" the board's.
SampleBlock framesOf(const Whole& whole, const std::string& kind) {
    const auto streams = whole.session.streams().value();
    for (const auto& stream : streams)
        if (stream.stream.kind == kind) return whole.session.samples(stream.id).value();
    return {};
}

/// Expects each train to be what the bench's encoder makes of the frame that it was made of, one of the newest: within
/// 0.5 % or a step of the stimulator.
void expectEncoded(const Whole& whole, const SampleBlock& frames, const EncodingProfile& profile) {
    constexpr double kStep_v = 0.05, kNewest_s = 0.15;
    constexpr std::size_t kColumns = 7, kR = 4, kP = 6;
    const Encoder encoder(profile);
    ASSERT_FALSE(whole.byFinger.empty());
    for (const auto& train : whole.byFinger) {
        const double volts = train.body["amplitude"].get<double>(), t = toSeconds(train.at);
        double off = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < frames.samples(); ++k) {
            const double R = frames.values[k * kColumns + kR], P = frames.values[k * kColumns + kP];
            if (frames.t_s[k] > t || frames.t_s[k] < t - kNewest_s || !(R >= 0 && P >= 0)) continue;
            off = std::min(off, std::abs(volts - encoder.encode(R, P).value().amplitude.value()));
        }
        EXPECT_LE(off, std::max(kStep_v, 0.005 * volts)) << volts << " V at " << t << " s";
    }
}

TEST(RunOnABoard, WholeRunsComeToTheVerdictsOfTheBenchsOwnEncoder) {
    RecordProperty("hazard", "H4");
    const Desk desk;
    Random random(51, "seeds");
    for (int turn = 0; turn < 3; ++turn) {
        const auto seed = random.below(1'000'000);
        SCOPED_TRACE(seed);
        const auto both = [&](const std::string& protocol, const Words& settings) {
            std::pair all{runOf(desk, protocol, "sim:finger", seed, settings),
                          runOf(desk, protocol, "sim:board", seed, settings)};
            if (protocol != "live")
                EXPECT_EQ(all.second.said["verdict"], "pass") << protocol << all.second.said["reasons"];
            EXPECT_EQ(all.second.said["verdict"], all.first.said["verdict"]) << all.first.said["reasons"];
            return all;
        };
        {
            const auto [ours, boards] = both("separability", {"repeats=19"});
            auto profile = parseProfile(boards.session.about().profileJson, "the session").value().encoding;
            profile.amplitudeRatioPerTrain = profile.intervalRatioPerTrain = 0;  // as the protocol has it
            expectEncoded(ours, framesOf(ours, "frames"), profile);
            expectEncoded(boards, framesOf(boards, "board_frames"), profile);
            EXPECT_EQ(boards.written, 2U) << "as it opened, and for the references that were felt";
            const auto a = ours.session.trials().value(), b = boards.session.trials().value();
            ASSERT_EQ(a.size(), 76U);
            ASSERT_EQ(b.size(), a.size());
            for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].condition, b[i].condition);
            for (std::size_t c = 0; c < 4; ++c) {
                const auto &x = ours.said["results"]["conditions"][c], &y = boards.said["results"]["conditions"][c];
                EXPECT_EQ(x["name"], y["name"]);
                for (const auto* what : {"amplitude_v", "interval_s"})
                    EXPECT_NEAR(y[what]["mean"].get<double>() / x[what]["mean"].get<double>(), 1, 0.005) << x << y;
            }
        }
        {
            const auto [ours, boards] = both("transitions", {"repeats=1", "jumps=false", "lines=2", "finger=true"});
            EXPECT_GT(boards.byFinger.size(), 30U);
            const auto hand = ours.trains.size() - ours.byFinger.size();
            ASSERT_EQ(boards.trains.size() - boards.byFinger.size(), hand);
            for (std::size_t i = 0; i < hand; ++i) EXPECT_EQ(ours.trains[i].body, boards.trains[i].body);
        }
        {
            const auto [ours, boards] = both("load-safety", {"area=1", "steps=2"});
            EXPECT_TRUE(boards.byFinger.empty()) << "the bench commands";
            ASSERT_EQ(boards.trains.size(), ours.trains.size());
            for (std::size_t i = 0; i < ours.trains.size(); ++i) EXPECT_EQ(ours.trains[i].body, boards.trains[i].body);
        }
        const auto [ours, boards] = both("live", {"load=2000"});
        EXPECT_NEAR(static_cast<double>(boards.byFinger.size()), static_cast<double>(ours.byFinger.size()), 1);
    }
}

}  // namespace
}  // namespace tacto::test
