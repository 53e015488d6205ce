// The board's encoder gives the bench's R, P and trains, on every recording here and on the simulated finger.
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iostream>

#include "app/run/EncoderComparison.h"
#include "core/acquisition/Recording.h"
#include "drivers/replay/ReplayDrivers.h"
#include "drivers/sensor_board/SimulatedBoard.h"
#include "drivers/simulated/Material.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/support/Limits.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

namespace fs = std::filesystem;

struct Trains {
    std::size_t trains = 0, refused = 0, frames = 0;
};

struct Opened {
    VirtualClock clock;
    DeviceSet devices;
};

std::unique_ptr<Opened> opened(Driver& driver, const DeviceUri& uri, std::uint64_t seed = 3) {
    auto one = std::make_unique<Opened>();
    const auto done = driver.open(uri, {}, OpenContext{one->clock, seed, "1 kohm"}, one->devices);
    EXPECT_TRUE(done) << done.error().message;
    return done ? std::move(one) : nullptr;
}

/// Compares on `sensor` until it has finished, or for `seconds`.
std::unique_ptr<EncoderComparison> compared(TactileSensor& sensor, VirtualClock& clock, const Profile& profile,
                                            const EncoderOutput& output, double seconds) {
    auto comparison = EncoderComparison::create(sensor, profile, output, limitSets(), clock);
    EXPECT_TRUE(comparison) << comparison.error().message;
    if (!comparison) return nullptr;
    for (bool last = false; !last && toSeconds(clock.now()) < seconds;) {
        last = sensor.finished();
        const auto turned = (*comparison)->turn();
        EXPECT_TRUE(turned) << turned.error().message;
        clock.advanceTo(clock.now() + EncoderComparison::kTurn);
    }
    return std::move(*comparison);
}

/// What issue 51 asks for.
Trains expectAgreement(Driver& driver, const DeviceUri& uri, const Profile& profile, const std::string& what,
                       double seconds = 1e9, const EncoderOutput& output = idealOutput(), std::uint64_t seed = 3) {
    const auto one = opened(driver, uri, seed);
    if (!one) return {};
    const auto comparison = compared(*one->devices.sensor, one->clock, profile, output, seconds);
    if (!comparison) return {};
    const auto found = comparison->agreement();
    EXPECT_TRUE(found.refusedAlike) << what << ": " << found.unlike;
    EXPECT_EQ(found.unlike, "");
    EXPECT_EQ(found.acceptedR, 0.01);
    EXPECT_EQ(found.acceptedP, 0.002);
    EXPECT_EQ(found.acceptedAmplitude, 0.005);
    EXPECT_LE(found.acceptedOnset_s, 0.0102);
    EXPECT_EQ(found.lost, 0U);
    EXPECT_LE(found.maxR, found.acceptedR) << what;
    EXPECT_LE(found.maxP, found.acceptedP) << what;
    EXPECT_LE(found.maxOnset_s, found.acceptedOnset_s) << what;
    if (output.source.amplitudeStep == 0)
        EXPECT_LE(found.maxAmplitude, found.acceptedAmplitude) << what;
    else
        EXPECT_LE(found.maxAmplitudeSteps, 1.0001) << what;
    EXPECT_TRUE(found.holds()) << what;
    std::cout << what << ": " << found.frames << " frames, " << found.trains << " trains; differences: R " << found.maxR
              << ", P " << found.maxP << ", onset " << found.maxOnset_s << " s, amplitude " << 100 * found.maxAmplitude
              << " %, refused " << comparison->board().refused_s.size() << "\n";
    return {found.trains, comparison->board().refused_s.size(), found.frames};
}

std::size_t expectAgreementOnEach(const fs::path& folder) {
    const auto driver = makeRecordingDriver();
    std::size_t found = 0, trains = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        if (!Recording::open(entry.path())) continue;  // others' refusals have their own tests
        ++found;
        const auto what = fs::relative(entry.path(), folder.parent_path()).string();
        for (const auto taxel : {TaxelFeature::Static, TaxelFeature::Dynamic}) {
            Profile profile;
            profile.roughness.taxel = taxel;
            if (taxel == TaxelFeature::Dynamic) profile.roughness.spectral = SpectralFeature::Absolute;
            trains += expectAgreement(*driver, {"recording", entry.path().string(), {}}, profile, what).trains;
        }
    }
    EXPECT_GT(found, 0U) << folder;
    return trains;
}

std::unique_ptr<Driver> simulated() {
    return makeSimulatedDriver(SimulatedBoards{sensorboard::SimulatedBoard::isOwn, sensorboard::SimulatedBoard::open});
}

Trains expectAgreementOn(const std::string& uri, const EncodingProfile& encoding,
                         const EncoderOutput& output = idealOutput(), std::uint64_t seed = 3) {
    Profile profile;
    profile.encoding = encoding;
    return expectAgreement(*simulated(), DeviceUri::parse(uri).value(), profile, uri, 12, output, seed);
}

/// A board that is wrong on purpose: its profile is changed under the hash of the right one, or what it says is.
class WrongBoard final : public TactileSensor, public EncodingSensor, public EncoderLoader {
public:
    using Profiled = std::function<void(te_profile&)>;
    using Says = std::function<void(Encoded&)>;
    WrongBoard(TactileSensor& board, Profiled profiled, Says says)
        : board_(board),
          encoding_(dynamic_cast<EncodingSensor&>(board)),
          profiled_(std::move(profiled)),
          says_(std::move(says)) {}
    const DeviceIdentity& identity() const noexcept override { return board_.identity(); }
    std::span<const StreamInfo> streams() const noexcept override { return board_.streams(); }
    Result<void> read(std::span<SampleBlock> blocks) override {
        auto read = board_.read(blocks);
        said_ = encoding_.encoded();
        if (says_) says_(said_);
        return read;
    }
    std::optional<BoardEncoder> encoder() const noexcept override { return BoardEncoder{true, hash_}; }
    const Encoded& encoded() const noexcept override { return said_; }
    void keepBoardTime() noexcept override { encoding_.keepBoardTime(); }
    std::uint64_t lostOnTheWay() const noexcept override { return encoding_.lostOnTheWay(); }
    bool wantsProfile() const noexcept override { return true; }
    Result<void> load(std::string_view bytes, bool rested) override {
        te_profile profile{};
        EXPECT_EQ(te_read_profile(&profile, reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                  static_cast<std::uint32_t>(bytes.size())),
                  TE_ACCEPTED);
        hash_ = profile.hash;
        if (profiled_) profiled_(profile);
        profile.hash = te_hash(&profile);
        return dynamic_cast<EncoderLoader&>(board_).load(profileBytes(profile), rested);
    }

private:
    TactileSensor& board_;
    EncodingSensor& encoding_;
    const Profiled profiled_;
    const Says says_;
    std::uint32_t hash_ = 0;
    Encoded said_;
};

EncoderAgreement foundOn(const WrongBoard::Profiled& profiled, const WrongBoard::Says& says,
                         const EncoderOutput& output = idealOutput(),
                         const std::string& uri = "sim:board?material=P120&force=2N") {
    const auto driver = simulated();
    const auto one = opened(*driver, DeviceUri::parse(uri).value());
    WrongBoard board(*one->devices.sensor, profiled, says);
    const auto comparison = compared(board, one->clock, {}, output, 12);
    return comparison ? comparison->agreement() : EncoderAgreement{};
}

/// Has `change` made to the fifth of what a board says one by one.
template <class Row>
WrongBoard::Says fifth(std::vector<Row> Encoded::*rows, std::function<void(Encoded&, std::vector<Row>&)> change) {
    return [rows, change, count = 0](Encoded& said) mutable {
        if (!(said.*rows).empty() && ++count == 5) change(said, said.*rows);
    };
}

}  // namespace

TEST(EncoderOnBoard, AgreesWithTheBenchOnShippedRecordings) {
    RecordProperty("hazard", "H1");
    EXPECT_GT(expectAgreementOnEach(sourceDir() / "resources" / "examples"), 40U);
}

TEST(EncoderOnBoard, AgreesWithTheBenchOnRealRecordings) {
    std::size_t trains = 0;
    for (const char* folder : {"biotac", "fabric_slide", "hapmat", "cases"}) {
        const auto path = sharedData(folder);
        if (!path) GTEST_SKIP() << kNoSharedData;
        trains += expectAgreementOnEach(*path);
    }
    EXPECT_GT(trains, 200U);
}

TEST(EncoderOnBoard, AgreesWithTheBenchOnTheSimulatedFinger) {
    EncodingProfile shipped;
    shipped.amplitudeRatioPerTrain = 1.2;
    shipped.intervalRatioPerTrain = 1.34;
    EncodingProfile curved = shipped;
    curved.amplitudeCurve.kind = CurveKind::Logarithmic;
    curved.intervalCurve.kind = CurveKind::Power;
    curved.assignment = Assignment::Swapped;
    curved.amplitudeSlew_V_per_s = 8;
    std::size_t trains = 0;
    for (const char* material : {"P60", "P120", "plastic", "denim"}) {
        for (const char* force : {"0.4N", "3N"}) {
            const auto uri = fmt::format("sim:finger?material={}&force={}", material, force);
            trains += expectAgreementOn(uri, shipped).trains;
            trains += expectAgreementOn(uri, curved).trains;
        }
    }
    for (const char* more : {"rate=2000", "dropouts=0.02", "speed=5mm/s", "fault=stale@3s..3.5s", "fault=nan@3s..3.2s",
                             "fault=stuck@3s..4s"})
        trains += expectAgreementOn(fmt::format("sim:finger?material=P120&{}", more), shipped).trains;
    EXPECT_GT(trains, 150U);
}

TEST(EncoderOnBoard, RefusesTheTrainsThatTheBenchRefuses) {
    RecordProperty("hazard", "H1");
    EncodingProfile encoding;
    encoding.train.pulses = 12;
    encoding.intervalMin = Seconds(0.3);
    auto stepped = idealOutput();
    stepped.source.drive = Drive::Current;
    stepped.source.amplitudeStep = 0.25;
    EXPECT_GT(expectAgreementOn("sim:finger?material=P60&force=3N", encoding, stepped).trains, 3U);
    stepped.source.amplitudeStep = 8;  // too coarse for the weaker trains
    const auto made = expectAgreementOn("sim:finger?material=plastic&force=1N", encoding, stepped);
    EXPECT_GT(made.refused, 3U);
}

TEST(EncoderOnBoard, AgreesWithTheBenchThroughItsLine) {
    RecordProperty("hazard", "H1");
    std::size_t trains = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const char* more : {"material=P60&force=0.4N", "material=P120&force=3N",
                                 "material=denim&force=1N&drift=50", "material=plastic&rate=2000&drift=-50",
                                 "material=P120&dropouts=0.02", "material=P120&fault=stale@3s..3.5s",
                                 "material=P120&fault=nan@3s..3.2s", "material=P120&fault=stuck@3s..4s"})
            trains += expectAgreementOn(fmt::format("sim:board?{}", more), {}, idealOutput(), seed).trains;
    }
    for (const auto& material : sim::materials())
        trains += expectAgreementOn(fmt::format("sim:board?material={}&force=1.5N", material.name), {}).trains;
    EXPECT_GT(trains, 150U);
}

TEST(EncoderOnBoard, AgreesWithTheBenchThroughItsLineHoweverItsClockRuns) {
    RecordProperty("hazard", "H7");
    for (const int drift : {-50'000, -24'000, -10'000, 3000, 10'000, 24'000, 50'000}) {
        const auto made = expectAgreementOn(fmt::format("sim:board?material=P120&drift={}", drift), {});
        // Stamps a fortieth or more off the nominal rate are a gap at each sample: no window is whole, on either side.
        const bool encodes = std::abs(drift) < 25'000;
        EXPECT_EQ(made.frames > 600, encodes) << drift;
        EXPECT_EQ(made.trains > 4, encodes) << drift;
    }
}

TEST(EncoderOnBoard, RefusesThroughItsLineWhatTheBenchRefuses) {
    RecordProperty("hazard", "H1");
    EncodingProfile encoding;
    encoding.train.pulses = 12;
    encoding.intervalMin = Seconds(0.3);
    auto stepped = idealOutput();
    stepped.source.drive = Drive::Current;
    stepped.source.amplitudeStep = 8;  // too coarse for the weaker trains
    const auto made = expectAgreementOn("sim:board?material=plastic&force=1N", encoding, stepped);
    EXPECT_GT(made.refused, 3U);
}

TEST(EncoderOnBoard, IsFoundWhereItIsWrong) {
    RecordProperty("hazard", "H4");
    EXPECT_TRUE(foundOn({}, {}).holds());
    const auto largest = foundOn([](te_profile& p) { p.amplitude_max_v *= 0.98F; }, {});
    EXPECT_GT(largest.maxAmplitude, largest.acceptedAmplitude);
    const auto rough = foundOn([](te_profile& p) { p.spectral_rough *= 1.1F; }, {});
    EXPECT_GT(rough.maxR, rough.acceptedR);
    const auto pressing = foundOn([](te_profile& p) { p.pressure_max_pa *= 1.02F; }, {});
    EXPECT_GT(pressing.maxP, pressing.acceptedP);
    const auto shifted = foundOn({}, fifth<EncodedFrame>(&Encoded::frames, [](auto&, auto& frames) {
                                     frames[0].P = std::isnan(frames[0].P) ? frames[0].P : frames[0].P + 0.0021;
                                 }));
    EXPECT_GT(shifted.maxP, shifted.acceptedP);
    const auto shiftedR = foundOn({}, [](Encoded& said) {
        for (auto& frame : said.frames) frame.R += 0.011;
    });
    EXPECT_GT(shiftedR.maxR, shiftedR.acceptedR);
    const auto late = foundOn(
        {}, fifth<EncodedTrain>(&Encoded::trains, [](auto&, auto& trains) { trains[0].onset_s += 2 / 4000.0; }));
    EXPECT_EQ(late.acceptedOnset_s, 1 / 4000.0);
    EXPECT_NEAR(late.maxOnset_s, 2 / 4000.0, 1e-5);
    for (const auto& found : {largest, rough, pressing, shifted, shiftedR, late}) EXPECT_FALSE(found.holds());
}

TEST(EncoderOnBoard, IsFoundWhereItAloneIsSilentOrPlays) {
    RecordProperty("hazard", "H4");
    const auto missing =
        foundOn({}, fifth<EncodedTrain>(&Encoded::trains, [](auto&, auto& trains) { trains.clear(); }));
    EXPECT_THAT(missing.unlike, testing::HasSubstr("the bench alone has a train"));
    const auto refused = foundOn({}, fifth<EncodedTrain>(&Encoded::trains, [](Encoded& said, auto& trains) {
                                     said.silences.push_back({trains[0].made_s, "a train over its own limit", true});
                                     trains.clear();
                                 }));
    EXPECT_THAT(refused.unlike, testing::AllOf(testing::HasSubstr("the bench alone has a train"),
                                               testing::HasSubstr("is silent: a train over its own limit")));
    const auto more = foundOn({}, fifth<EncodedTrain>(&Encoded::trains, [](auto&, auto& trains) {
                                  trains.push_back(trains[0]);
                                  trains[1].onset_s += 0.1;
                              }));
    EXPECT_THAT(more.unlike, testing::HasSubstr("the board alone has a train"));
    const auto frame = foundOn({}, fifth<EncodedFrame>(&Encoded::frames, [](auto&, auto& frames) { frames.clear(); }));
    EXPECT_THAT(frame.unlike, testing::HasSubstr("the bench alone has a frame"));
    const auto ends = foundOn({}, [count = 0](Encoded& said) mutable {
        for ([[maybe_unused]] const auto& one : said.frames) ++count;
        if (count > 300) said.clear();
    });
    EXPECT_THAT(ends.unlike, testing::HasSubstr("the bench alone has a frame")) << "it says nothing more";
    auto coarse = idealOutput();
    coarse.source.drive = Drive::Current;
    coarse.source.amplitudeStep = 8;
    const auto plays = foundOn([](te_profile& p) { p.output_step = 0; }, {}, coarse, "sim:board?material=plastic");
    EXPECT_THAT(plays.unlike, testing::HasSubstr("the board alone has a train")) << "which the gate refuses";
    for (const auto& found : {missing, refused, more, frame, ends, plays}) {
        EXPECT_FALSE(found.refusedAlike);
        EXPECT_FALSE(found.holds());
    }
}

TEST(EncoderAgreement, FindsWhatOneSideAloneHas) {
    EncoderSide bench;
    for (int k = 0; k < 10; ++k) {
        bench.frames.push_back({.t_s = 0.016 * k, .contact = true, .sliding = true, .h = 1, .v = 1, .R = 0.5});
        bench.trains.push_back({2.0 * k, 20});
    }
    bench.refused_s = {30};
    const auto unlike = [&](auto change) {
        EncoderSide board = bench;
        change(board);
        return agreementOf(bench, board, 0).unlike;
    };
    EXPECT_EQ(unlike([](auto&) {}), "");
    EXPECT_EQ(unlike([](auto& board) { board.frames.erase(board.frames.begin() + 2); }),
              "the bench alone has a frame at 0.032 s");
    EXPECT_EQ(unlike([](auto& board) { board.frames[3].R = kNaN; }), "one side alone has R at 0.048 s");
    EXPECT_EQ(unlike([](auto& board) { board.frames[3].contact = false; }), "one side alone has contact at 0.048 s");
    EXPECT_EQ(unlike([](auto& board) { board.trains[4].onset_s += 0.026; }), "the bench alone has a train at 8.000 s");
    EXPECT_EQ(unlike([](auto& board) { board.trains.push_back({40, 20}); }), "the board alone has a train at 40.000 s");
    EXPECT_EQ(unlike([](auto& board) { board.refused_s.clear(); }), "the bench alone refuses a train at 30.000 s");
    EncoderSide board = bench;
    board.frames[1].R = 0.48;
    board.trains[1] = {2.001, 20.3};
    const auto found = agreementOf(bench, board, 0.25);
    EXPECT_NEAR(found.maxR, 0.02, 1e-9);
    EXPECT_NEAR(found.maxOnset_s, 0.001, 1e-9);
    EXPECT_NEAR(found.maxAmplitude, 0.015, 1e-9);
    EXPECT_NEAR(found.maxAmplitudeSteps, 1.2, 1e-9);
    EXPECT_TRUE(found.refusedAlike);
    EXPECT_FALSE(found.holds());
}

}  // namespace tacto::test
