// Which messages of a board are accepted, and which are refused in one sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/sensor_board/EncoderProfile.h"
#include "drivers/sensor_board/Fields.h"
#include "drivers/sensor_board/Messages.h"
#include "tests/drivers/sensor_board/Golden.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using namespace sensorboard;
using sensorboard::Command;
using Bytes = std::vector<std::uint8_t>;
using testing::HasSubstr;

/// Returns the payload of a golden frame.
Bytes payloadOf(std::string_view text) {
    FrameDecoder decoder;
    std::span<const std::uint8_t> bytes(golden(text));
    const auto frame = decoder.take(bytes);
    if (!frame) return {};
    return {frame->payload.begin(), frame->payload.end()};
}

Frame frameOf(Reply reply, const Bytes& payload) {
    return {versionOf(reply), static_cast<std::uint8_t>(reply), payload};
}

/// Changes one byte of the golden configuration payload and returns the error.
std::string refusalOf(std::size_t at, std::uint8_t value) {
    auto payload = payloadOf("CONFIGURATION");
    payload[at] = value;
    const auto read = readConfiguration(frameOf(Reply::Configuration, payload));
    return read ? "" : read.error().message;
}

constexpr std::size_t kStreamAt = 1, kFlagsAt = 2, kKindAt = 3, kUnitAt = 4, kFormatAt = 5, kColumnsAt = 6, kRateAt = 7,
                      kScaleAt = 11;

TEST(SensorBoardMessages, ReadsTheGoldenDescriptions) {
    const auto identity = accepted(readIdentity(frameOf(Reply::Identity, payloadOf("IDENTITY"))));
    EXPECT_EQ(identity.name, "Golden board");
    EXPECT_EQ(identity.serial, "G-0001");
    EXPECT_EQ(identity.firmware, "1.2.3");
    EXPECT_EQ(identity.streams, 3U);
    EXPECT_EQ(identity.lowestVersion, 1);
    EXPECT_EQ(identity.highestVersion, 1);

    const auto configuration = accepted(readConfiguration(frameOf(Reply::Configuration, payloadOf("CONFIGURATION"))));
    EXPECT_TRUE(configuration.enabled);
    EXPECT_EQ(configuration.kind, StreamKind::Acceleration);
    EXPECT_EQ(configuration.unit, StreamUnit::MetrePerSecondSquared);
    EXPECT_EQ(configuration.format, SampleFormat::Int16);
    EXPECT_EQ(configuration.rate_hz(), 4000);
    ASSERT_EQ(configuration.columns.size(), 3U);
    EXPECT_EQ(configuration.columns[2].scale, 0.0048828125);

    const auto calibration = accepted(readCalibration(frameOf(Reply::Calibration, payloadOf("CALIBRATION"))));
    EXPECT_TRUE(calibration.calibrated);
    EXPECT_EQ(calibration.date, "2026-11-20");
    EXPECT_EQ(calibration.reference, "CERT 17");
    ASSERT_EQ(calibration.uncertainty.size(), 3U);
    EXPECT_NEAR(calibration.uncertainty[1], 0.005, 1e-9);
}

TEST(SensorBoardMessages, ReadsTheGoldenStates) {
    const auto done = accepted(readDone(frameOf(Reply::Done, payloadOf("DONE")), Command::Start));
    EXPECT_EQ(done, 1'000'000U);
    EXPECT_FALSE(readDone(frameOf(Reply::Done, payloadOf("DONE")), Command::Stop).has_value());
    const auto status = accepted(readStatus(frameOf(Reply::Status, payloadOf("STATUS"))));
    EXPECT_TRUE(status.running);
    EXPECT_EQ(status.time_us, std::uint64_t{1} << 32U);
    EXPECT_EQ(status.samplesLost, 3U);
    EXPECT_EQ(status.blocksDropped, 2U);
    EXPECT_EQ(status.framesRefused, 1U);
    const auto refusal = accepted(readRefusal(frameOf(Reply::Refused, payloadOf("REFUSED"))));
    EXPECT_EQ(refusal.command, 3);
    EXPECT_EQ(refusal.text(), "it does this only while stopped");
}

TEST(SensorBoardMessages, ReadsTheGoldenBlocks) {
    const auto narrow = payloadOf("DATA: stream 0");
    const auto block = accepted(readBlock(frameOf(Reply::Data, narrow)));
    EXPECT_EQ(block.count, 2);
    EXPECT_EQ(block.sequence, 258U);
    EXPECT_EQ(block.index, 8256U);
    EXPECT_EQ(block.time_us, 5'000'000U);
    EXPECT_EQ(block.interval_ns, 250'000U);
    EXPECT_EQ(block.samples.size(), 12U);
    const auto wide = payloadOf("DATA: stream 2");
    ASSERT_TRUE(readBlock(frameOf(Reply::Data, wide)).has_value());
    EXPECT_EQ(readBlock(frameOf(Reply::Data, wide))->index, 0xFFFFFFFFU);
}

TEST(SensorBoardMessages, ReadsWhatTheGoldenEncoderSays) {
    const auto state = accepted(readEncoder(frameOf(Reply::Encoder, payloadOf("ENCODER"))));
    EXPECT_TRUE(state.encodes);
    EXPECT_EQ(state.refusal, 0);
    EXPECT_EQ(state.layout, 1U);
    EXPECT_EQ(state.hash, 0x89ABCDEFU);

    const auto reading = accepted(readReading(frameOf(Reply::Reading, payloadOf("READING"))));
    EXPECT_EQ(reading.sequence, 70'000U);
    EXPECT_EQ(reading.time_us, 1ULL << 33U);
    EXPECT_TRUE(reading.contact && reading.slidingAssumed);
    EXPECT_FALSE(reading.sliding);
    EXPECT_EQ(reading.faults, 0U);
    EXPECT_EQ(reading.R, 0.625);
    EXPECT_EQ(reading.P, 0.25);
    EXPECT_EQ(reading.pressure_pa, 10'000);
    EXPECT_EQ(reading.h, 0.03125);
    EXPECT_TRUE(std::isnan(reading.v));

    const auto train = accepted(readTrain(frameOf(Reply::Train, payloadOf("TRAIN"))));
    EXPECT_EQ(train.sequence, 258U);
    EXPECT_EQ(train.onset_us, 5'000'000U);
    EXPECT_EQ(train.interval_s, 0.5);
    EXPECT_EQ(train.command_v, 13.5);
    EXPECT_EQ(train.amplitude, 6.75);
    EXPECT_EQ(train.shape, 1);
    EXPECT_TRUE(train.negative);
    EXPECT_EQ(train.width_us, 200);
    EXPECT_EQ(train.gap_us, 50);
    EXPECT_EQ(train.rechargeRatio, 10);
    EXPECT_EQ(train.pulses, 10U);
    EXPECT_EQ(train.rate_hz, 100);

    const auto faulty = accepted(readSilence(frameOf(Reply::Silent, payloadOf("SILENT: sequence 3"))));
    EXPECT_EQ(faulty.sequence, 3U);
    EXPECT_EQ(faulty.time_us, 6'000'000U);
    EXPECT_EQ(silenceWords(faulty.faults, faulty.refusal),
              "data that are older than 100 ms, a sensor that repeats itself");
    const auto refused = accepted(readSilence(frameOf(Reply::Silent, payloadOf("SILENT: sequence 4"))));
    EXPECT_EQ(silenceWords(refused.faults, refused.refusal),
              "a train that it refuses: more RMS current over 5 s than allowed");
    EXPECT_EQ(silenceWords(0, 0), "");
    EXPECT_EQ(silenceWords(1U << 20U, 200),
              "faults 0x100000, which are not known here, a train that it refuses for reason 200");
}

TEST(SensorBoardMessages, RefusesATrainThatIsNone) {
    RecordProperty("hazard", "H1");
    const auto whole = payloadOf("TRAIN");
    constexpr std::size_t kInterval = 12, kCommand = 16, kAmplitude = 20, kShape = 24, kNegative = 25, kWidth = 26,
                          kGap = 30, kRatio = 34, kPulses = 38, kRate = 42;
    const auto with = [&](std::size_t at, const Bytes& bytes) {
        auto payload = whole;
        std::ranges::copy(bytes, payload.begin() + static_cast<std::ptrdiff_t>(at));
        return readTrain(frameOf(Reply::Train, payload)).has_value();
    };
    const auto number = [](float value) {
        Bytes bytes;
        putF32(bytes, value);
        return bytes;
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    for (const auto at : {kInterval, kCommand, kAmplitude, kWidth, kGap, kRatio, kRate}) {
        EXPECT_TRUE(with(at, number(1))) << at;
        for (const float value : {kNan, kInf, -kInf, -1.0F})
            EXPECT_FALSE(with(at, number(value))) << at << " " << value;
        EXPECT_EQ(with(at, number(0)), at == kGap || at == kRatio) << at;
    }
    EXPECT_FALSE(with(kShape, {3}));
    EXPECT_FALSE(with(kNegative, {2}));
    EXPECT_FALSE(with(kPulses, {0, 0, 0, 0}));
}

TEST(SensorBoardMessages, RefusesAReadingOutOfItsRange) {
    RecordProperty("hazard", "H7");
    const auto whole = payloadOf("READING");
    constexpr std::size_t kFlags = 12, kR = 18, kP = 22, kPressure = 26, kH = 30, kV = 34;
    const auto with = [&](std::size_t at, float value) {
        auto payload = whole;
        Bytes bytes;
        putF32(bytes, value);
        std::ranges::copy(bytes, payload.begin() + static_cast<std::ptrdiff_t>(at));
        return readReading(frameOf(Reply::Reading, payload)).has_value();
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
    for (const auto at : {kR, kP, kPressure, kH, kV}) {
        EXPECT_TRUE(with(at, kNan)) << at;
        EXPECT_TRUE(with(at, 1)) << at;
        EXPECT_FALSE(with(at, kInf)) << at;
        EXPECT_EQ(with(at, 1.5F), at != kR && at != kP) << at;
    }
    auto payload = whole;
    payload[kFlags] = 8;
    EXPECT_FALSE(readReading(frameOf(Reply::Reading, payload)).has_value());
}

TEST(SensorBoardMessages, RefusesEveryLengthButTheRightOne) {
    RecordProperty("hazard", "H10");
    const auto refuses = [](std::string_view text, auto&& read) {
        const auto whole = payloadOf(text);
        EXPECT_TRUE(read(whole)) << text;
        auto longer = whole;
        longer.push_back(0);
        EXPECT_FALSE(read(longer)) << text;
        for (std::size_t size = 0; size < whole.size(); ++size) {
            EXPECT_FALSE(read(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))))
                << text << ", " << size << " bytes";
        }
    };
    refuses("IDENTITY", [](const Bytes& p) { return readIdentity(frameOf(Reply::Identity, p)).has_value(); });
    refuses("CONFIGURATION",
            [](const Bytes& p) { return readConfiguration(frameOf(Reply::Configuration, p)).has_value(); });
    refuses("CALIBRATION", [](const Bytes& p) { return readCalibration(frameOf(Reply::Calibration, p)).has_value(); });
    refuses("DONE", [](const Bytes& p) { return readDone(frameOf(Reply::Done, p), Command::Start).has_value(); });
    refuses("STATUS", [](const Bytes& p) { return readStatus(frameOf(Reply::Status, p)).has_value(); });
    refuses("ENCODER", [](const Bytes& p) { return readEncoder(frameOf(Reply::Encoder, p)).has_value(); });
    refuses("READING", [](const Bytes& p) { return readReading(frameOf(Reply::Reading, p)).has_value(); });
    refuses("TRAIN", [](const Bytes& p) { return readTrain(frameOf(Reply::Train, p)).has_value(); });
    refuses("SILENT", [](const Bytes& p) { return readSilence(frameOf(Reply::Silent, p)).has_value(); });
    refuses("REFUSED", [](const Bytes& p) { return readRefusal(frameOf(Reply::Refused, p)).has_value(); });
}

TEST(SensorBoardMessages, RefusesAConfigurationThatMakesNoSense) {
    RecordProperty("hazard", "H4");
    EXPECT_EQ(refusalOf(kStreamAt, 0), "");
    EXPECT_THAT(refusalOf(kFlagsAt, 2), HasSubstr("flags 0x2; 0 or 1 was expected"));
    EXPECT_THAT(refusalOf(kKindAt, 3), HasSubstr("of kind 3; 0, 1 or 2 was expected"));
    EXPECT_THAT(refusalOf(kUnitAt, 3), HasSubstr("its acceleration stream is in Pa; m/s2 or count was expected"));
    EXPECT_THAT(refusalOf(kUnitAt, 9), HasSubstr("in unit 9; m/s2 or count was expected"));
    EXPECT_THAT(refusalOf(kFormatAt, 3), HasSubstr("format 3; 1 (int16) or 2 (int32) was expected"));
    EXPECT_THAT(refusalOf(kKindAt, 1), HasSubstr("its force stream is in m/s2; N or count was expected"));
    EXPECT_THAT(refusalOf(kColumnsAt, 200), HasSubstr("200 columns; 1 to 16 were expected"));
    auto payload = payloadOf("CONFIGURATION");
    std::fill_n(payload.begin() + kRateAt, 4, std::uint8_t{0});
    EXPECT_THAT(readConfiguration(frameOf(Reply::Configuration, payload)).error().message,
                HasSubstr("a rate of 0 Hz; 1 Hz to 1 MHz was expected"));
    std::fill_n(payload.begin() + kRateAt, 4, std::uint8_t{0xFF});
    EXPECT_FALSE(readConfiguration(frameOf(Reply::Configuration, payload)).has_value());
}

TEST(SensorBoardMessages, RefusesAScaleThatIsNoScale) {
    RecordProperty("hazard", "H7");
    for (const float scale : {0.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        auto payload = payloadOf("CONFIGURATION");
        Bytes bytes;
        putF32(bytes, scale);
        std::ranges::copy(bytes, payload.begin() + kScaleAt);
        EXPECT_THAT(readConfiguration(frameOf(Reply::Configuration, payload)),
                    refusedSaying("a finite scale other than 0 was expected"))
            << scale;
    }
    EXPECT_THAT(refusalOf(kUnitAt, 0), HasSubstr("counts with the scale 0.0048828125")) << "a scale and no unit";
}

TEST(SensorBoardMessages, UncalibratedStreamsAreCounts) {
    StreamConfiguration made{1, true, StreamKind::Taxels, StreamUnit::Count, SampleFormat::Int16, 200'000, {}};
    made.columns.resize(8);
    auto payload = configurationPayload(made);
    payload.insert(payload.begin(), 1);  // token
    const auto read = accepted(readConfiguration(frameOf(Reply::Configuration, payload)));
    EXPECT_EQ(read.unit, StreamUnit::Count);
    EXPECT_EQ(read.kind, StreamKind::Taxels);
    EXPECT_EQ(read.columns.size(), 8U);
}

TEST(SensorBoardMessages, TextsOfADeviceAreMadePrintable) {
    RecordProperty("hazard", "H10");
    auto payload = payloadOf("IDENTITY");
    payload[4] = 0x1B;
    payload[5] = 0xFF;
    EXPECT_EQ(readIdentity(frameOf(Reply::Identity, payload))->name, "??lden board");
}

}  // namespace
}  // namespace tacto::test
