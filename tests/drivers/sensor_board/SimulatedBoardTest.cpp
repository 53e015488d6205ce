// sim:board: the C99 code of the firmware on the simulated finger, behind the bytes of the protocol.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/devices/Device.h"
#include "core/dsp/RoughnessChain.h"
#include "drivers/sensor_board/EncoderProfile.h"
#include "drivers/sensor_board/SimulatedBoard.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/drivers/conformance/SensorConformance.h"
#include "tests/drivers/sensor_board/BoardConformance.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

Result<DeviceSet> opened(const std::string& uri, const Clock& clock) {
    const auto driver =
        makeSimulatedDriver(SimulatedBoards{sensorboard::SimulatedBoard::isOwn, sensorboard::SimulatedBoard::open});
    DeviceSet devices;
    const auto done = driver->open(DeviceUri::parse(uri).value(), {}, OpenContext{clock, 3, "1 kohm"}, devices);
    if (!done) return failure(done);
    return devices;
}

class SimulatedBoardRig final : public SensorRig {
public:
    explicit SimulatedBoardRig(const std::string& uri) : devices_(opened(uri, clock_).value()) {}
    TactileSensor& device() override { return *devices_.sensor; }
    const Clock& clock() const override { return clock_; }
    void wait(Seconds duration) override { clock_.advanceTo(clock_.now() + toInstant(duration)); }
    bool unplug() override {
        clock_.advanceTo(std::chrono::seconds(5));
        return true;
    }

private:
    VirtualClock clock_;
    DeviceSet devices_;
};

SensorKind kind(const char* name, const std::string& uri) {
    return {name, [uri] { return std::make_unique<SimulatedBoardRig>(uri); }};
}

INSTANTIATE_TEST_SUITE_P(SimulatedBoard, SensorConformance,
                         testing::Values(kind("OnABoard", "sim:board?fault=unplug@5s"),
                                         kind("OnADriftingBoard", "sim:board?drift=120&fault=unplug@5s")),
                         [](const testing::TestParamInfo<SensorKind>& of) { return of.param.name; });

/// The profile of an ideal voltage source on 1 kohm.
te_profile profileFor(const TactileSensor& sensor, double amplitudeMax = 40) {
    EncoderOutput output;
    output.source.accuracy = StatedAccuracy::exact();
    output.source.amplitudeMax = 60;
    output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    EncodingProfile encoding;
    encoding.amplitudeMax = Volts(amplitudeMax);
    return encoderProfile(sensor.streams(), {}, encoding, output, sensor.identity().serial).value();
}

class FirmwareRig final : public BoardRig {
public:
    FirmwareRig() {
        auto finger = opened("sim:finger?material=P120&force=2N", clock_).value().sensor;
        const auto profile = profileFor(*finger);
        const auto board = sensorboard::FirmwareBoard::make(std::move(finger), "EMU-1", "1", clock_, 0).value();
        board->restart(&profile, true);
        line_ = board->line();
    }
    Transport& line() override { return *line_; }
    const Clock& clock() const override { return clock_; }
    void wait(Seconds duration) override { clock_.advanceTo(clock_.now() + toInstant(duration)); }

private:
    VirtualClock clock_;
    std::unique_ptr<Transport> line_;
};

const auto kFirmware = testing::Values(BoardKind{"FirmwareHere", [] { return std::make_unique<FirmwareRig>(); }});
std::string boardName(const testing::TestParamInfo<BoardKind>& of) { return of.param.name; }
INSTANTIATE_TEST_SUITE_P(SimulatedBoard, BoardConformance, kFirmware, boardName);
INSTANTIATE_TEST_SUITE_P(SimulatedBoard, EncodingBoardConformance, kFirmware, boardName);

/// A board on a finger of the virtual clock, read every 2 ms.
class SimBoard : public testing::Test {
protected:
    void open(const std::string& uri) {
        auto set = opened(uri, clock_);
        ASSERT_TRUE(set) << set.error().message;
        devices_ = std::move(*set);
        encoding_ = dynamic_cast<EncodingSensor*>(devices_.sensor.get());
        ASSERT_NE(encoding_, nullptr);
        blocks_.resize(devices_.sensor->streams().size());
    }
    [[nodiscard]] Result<void> load(const te_profile& profile, bool rested = true) {
        auto& loader = dynamic_cast<EncoderLoader&>(*devices_.sensor);
        if (!loader.wantsProfile()) return {};
        return loader.load(profileBytes(profile), rested);
    }
    [[nodiscard]] Result<void> run(double seconds) {
        for (const Instant end = clock_.now() + toInstant(seconds); clock_.now() < end;) {
            clock_.advanceTo(clock_.now() + std::chrono::milliseconds(2));
            if (auto read = devices_.sensor->read(blocks_); !read) return read;
            const auto& came = encoding_->encoded();
            board_.frames.insert(board_.frames.end(), came.frames.begin(), came.frames.end());
            board_.trains.insert(board_.trains.end(), came.trains.begin(), came.trains.end());
            board_.silences.insert(board_.silences.end(), came.silences.begin(), came.silences.end());
        }
        return {};
    }

    VirtualClock clock_;
    DeviceSet devices_;
    EncodingSensor* encoding_ = nullptr;
    std::vector<SampleBlock> blocks_;
    Encoded board_;
};

}  // namespace

TEST_F(SimBoard, GivesTheFingersSamplesToADigit) {
    VirtualClock clock;
    auto finger = opened("sim:finger?material=P120", clock).value();
    open("sim:board?material=P120");
    std::vector<SampleBlock> felt(blocks_.size());
    clock.advanceTo(std::chrono::seconds(2));
    ASSERT_TRUE(finger.sensor->read(felt));
    ASSERT_TRUE(run(2.1));
    EXPECT_TRUE(devices_.sensor->identity().simulated);
    for (std::size_t s = 0; s < felt.size(); ++s) {
        const auto& info = devices_.sensor->streams()[s];
        ASSERT_GE(blocks_[s].samples(), felt[s].samples() - static_cast<std::size_t>(0.1 * info.rate_hz));
        // The board fetches from its power-up on: its first sample may be a later one of the finger's.
        std::size_t skipped = 0;
        while (felt[s].t_s[skipped] < blocks_[s].t_s[0] - 2e-3) ++skipped;
        const double step = sensorboard::FirmwareBoard::kSteps[info.kind == StreamKind::Acceleration ? 0
                                                               : info.kind == StreamKind::Force      ? 1
                                                                                                     : 2];
        for (std::size_t i = skipped * info.channels; i < felt[s].values.size(); ++i)
            ASSERT_NEAR(blocks_[s].values.at(i - skipped * info.channels), felt[s].values[i], 0.51 * step) << s;
    }
}

TEST_F(SimBoard, EncodesAsTheBenchsChainDoesOnTheSamplesThatItSends) {
    RecordProperty("hazard", "H1");
    open("sim:board?material=P120&force=2N");
    EXPECT_FALSE(encoding_->encoder()) << "it has no profile yet";
    const auto profile = profileFor(*devices_.sensor);
    ASSERT_TRUE(load(profile));
    ASSERT_TRUE(encoding_->encoder());
    EXPECT_EQ(encoding_->encoder()->hash, profile.hash);
    EXPECT_TRUE(encoding_->encoder()->drives);
    ASSERT_TRUE(run(12));
    const auto chain = RoughnessChain::create(devices_.sensor->streams(), {}).value();
    std::vector<RoughnessFrame> frames;
    chain->feed(blocks_, frames);
    ASSERT_GT(board_.frames.size(), 700U);
    EXPECT_GT(board_.trains.size(), 5U);
    std::size_t rough = 0, k = 0;
    for (const auto& theirs : board_.frames) {
        while (k < frames.size() && frames[k].t_s < theirs.t_s - 8e-3) ++k;
        ASSERT_LT(k, frames.size());
        ASSERT_NEAR(frames[k].t_s, theirs.t_s, 1e-3);
        ASSERT_EQ(std::isnan(frames[k].R), std::isnan(theirs.R)) << theirs.t_s;
        if (std::isnan(theirs.R)) continue;
        ++rough;
        ASSERT_NEAR(frames[k].R, theirs.R, 0.01);
        ASSERT_NEAR(frames[k].P, theirs.P, 0.002);
    }
    EXPECT_GT(rough, 300U);
}

TEST_F(SimBoard, IsSilentAndSaysWhyWhileItsSensorsFail) {
    RecordProperty("hazard", "H7");
    open("sim:board?material=P120&force=2N&fault=stale@5s..7s&fault=nan@8s..9s");
    ASSERT_TRUE(load(profileFor(*devices_.sensor)));
    ASSERT_TRUE(run(12));
    const auto within = [&](double from, double to) {
        return std::ranges::count_if(board_.trains, [&](const auto& t) { return t.onset_s > from && t.onset_s < to; });
    };
    EXPECT_GT(within(0, 5), 0);
    EXPECT_EQ(within(5.15, 7), 0);
    EXPECT_EQ(within(8.15, 9), 0);
    const auto says = [&](double from, double to) {
        return std::ranges::any_of(board_.silences, [&](const auto& one) {
            return one.t_s > from && one.t_s < to && one.why.view().find("older") != std::string_view::npos;
        });
    };
    EXPECT_TRUE(says(5, 5.3));
    EXPECT_TRUE(says(8, 8.3));
}

TEST_F(SimBoard, ComesBackAfterItWasUnplugged) {
    RecordProperty("hazard", "H7");
    open("sim:board?fault=unplug@2s..3s");
    ASSERT_TRUE(load(profileFor(*devices_.sensor)));
    const auto ran = run(5);
    ASSERT_FALSE(ran);
    EXPECT_THAT(ran.error().message, HasSubstr("unplugged"));
    auto& lost = dynamic_cast<Reconnecting&>(*devices_.sensor);
    EXPECT_FALSE(lost.reconnect());
    clock_.advanceTo(std::chrono::seconds(4));
    ASSERT_TRUE(lost.reconnect());
    board_.clear();
    ASSERT_TRUE(run(1));
    EXPECT_GT(board_.frames.size(), 40U);
}

TEST_F(SimBoard, TakesAnotherProfileWhileItIsOpen) {
    RecordProperty("hazard", "H4");
    open("sim:board?material=P120&force=2N");
    const auto first = profileFor(*devices_.sensor), second = profileFor(*devices_.sensor, 20);
    ASSERT_TRUE(load(first));
    ASSERT_TRUE(run(6));
    ASSERT_GT(board_.trains.size(), 2U);
    auto& loader = dynamic_cast<EncoderLoader&>(*devices_.sensor);
    EXPECT_FALSE(loader.load("no profile", true));
    EXPECT_EQ(encoding_->encoder()->hash, first.hash) << "it keeps what it has";
    ASSERT_TRUE(load(second, false));
    EXPECT_EQ(encoding_->encoder()->hash, second.hash);
    EXPECT_TRUE(encoding_->encoder()->drives);
    board_.clear();
    ASSERT_TRUE(run(7.9));
    EXPECT_GT(board_.frames.size(), 400U);
    EXPECT_TRUE(board_.trains.empty()) << "what came out before is not known to it";
    ASSERT_TRUE(run(6));
    EXPECT_FALSE(board_.trains.empty());
    for (const auto& train : board_.trains) EXPECT_LE(train.amplitude, 20);
    ASSERT_TRUE(load(first));
    board_.clear();
    ASSERT_TRUE(run(4));
    EXPECT_FALSE(board_.trains.empty()) << "it was told that nothing came out";
    for (const auto& block : blocks_) {
        for (std::size_t i = 1; i < block.samples(); ++i) {
            ASSERT_GT(block.t_s[i], block.t_s[i - 1]);
            ASSERT_LT(block.t_s[i], block.t_s[i - 1] + 0.05) << "while it is off";
        }
    }
}

TEST_F(SimBoard, KnowsHowFastItsClockRuns) {
    open("sim:board?drift=150&encodes=no");
    ASSERT_TRUE(load(profileFor(*devices_.sensor)));
    EXPECT_FALSE(encoding_->encoder()) << "it was told not to encode";
    ASSERT_TRUE(run(60));
    const auto report = dynamic_cast<ReportingDevice&>(*devices_.sensor).deviceReport();
    double drift = 0;
    for (const auto& row : report.rows())
        if (std::string_view(row.key) == "drift_ppm") drift = row.value;
    EXPECT_NEAR(drift, 150, 40);
    EXPECT_EQ(report.losses, 0U);
}

TEST_F(SimBoard, KeepsTheProfileThatItsAddressNames) {
    open("sim:board");
    const auto ours = profileFor(*devices_.sensor), theirs = profileFor(*devices_.sensor, 20);
    const ScratchDir scratch;
    scratch.write("board.bin", profileBytes(theirs));
    open("sim:board?encodes=shown&profile=" + (scratch.path() / "board.bin").string());
    ASSERT_TRUE(load(ours));
    EXPECT_EQ(encoding_->encoder()->hash, theirs.hash);
    EXPECT_FALSE(encoding_->encoder()->drives);
    scratch.write("short.bin", profileBytes(theirs).substr(0, 40));
    for (const auto& [uri, words] :
         {std::pair{"sim:board?profile=" + (scratch.path() / "short.bin").string(), "another layout"},
          std::pair{std::string("sim:board?encodes=perhaps"), "encodes=perhaps"},
          std::pair{std::string("sim:board?colour=red"), "colour"},
          std::pair{std::string("sim:board?on=motor"), "sim:finger"}}) {
        const auto refused = opened(uri, clock_);
        ASSERT_FALSE(refused) << uri;
        EXPECT_THAT(refused.error().message, HasSubstr(words));
    }
}

}  // namespace tacto::test
