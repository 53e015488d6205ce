// Checks the emulated device against physics and the protocol's rules, without the driver.
#include <gtest/gtest.h>

#include "tests/support/emulated/sciencemode/EmulatedStimulator.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using sciencemode::Command;
using std::chrono::microseconds;
using std::chrono::milliseconds;

Points biphasicPoints(double mA = 5) {
    Points points;
    EXPECT_TRUE(points.add({Micros(200), Milliamps(mA)}));
    EXPECT_TRUE(points.add({Micros(100), Milliamps(0)}));
    EXPECT_TRUE(points.add({Micros(200), Milliamps(-mA)}));
    return points;
}

class EmulatedScienceMode : public testing::Test {
protected:
    /// Sends a command and returns the payload of its answer.
    std::vector<std::uint8_t> ask(Command command, const Payload& payload = {}) {
        FrameBytes frame;
        EXPECT_TRUE(encodeFrame({static_cast<std::uint16_t>(command), number_, payload.view()}, frame));
        device_.receive(frame.view(), now_);
        number_ = static_cast<std::uint8_t>((number_ + 1) & kMaxNumber);
        std::array<std::uint8_t, 2048> bytes{};
        now_ = device_.nextTransmit().value_or(now_);
        std::span<const std::uint8_t> got(bytes.data(), device_.transmit(bytes, now_));
        const auto packet = decoder_.take(got);
        if (!packet) return {};
        return {packet->payload.begin(), packet->payload.end()};
    }
    ResultCode plain(Command command, const Payload& payload = {}) {
        const auto answer = ask(command, payload);
        EXPECT_EQ(answer.size(), 1U);
        return answer.empty() ? ResultCode::Protocol : static_cast<ResultCode>(answer[0]);
    }
    void initialise(Measurement measurement = Measurement::Voltage) {
        EXPECT_EQ(plain(Command::LowLevelInit, payloadOf(LowLevelInit{HighVoltage::Default, measurement})),
                  ResultCode::Ok);
    }
    ChannelConfigAck pulse(double mA = 5) {
        ChannelConfigAck ack;
        const auto read = readChannelConfigAck(
            ask(Command::ChannelConfig, *payloadOf(ChannelConfig{1, 1, true, biphasicPoints(mA)})), ack);
        EXPECT_TRUE(read.has_value());
        return ack;
    }
    std::size_t pulses() { return device_.pulses(now_).size(); }
    void setLoad(const char* text) { device_.fit(*parseLoad(text), now_); }

    Instant now_{0};
    EmulatedStimulator device_;

private:
    std::uint8_t number_ = 0;
    FrameDecoder decoder_;
};

TEST_F(EmulatedScienceMode, PulsesNeedAnInitialisedLevelAndEndByThemselves) {
    EXPECT_EQ(pulse().result, ResultCode::NotInitialised);
    EXPECT_EQ(pulses(), 0U);
    initialise();
    const auto ack = pulse();
    EXPECT_EQ(ack.result, ResultCode::Ok);
    EXPECT_EQ(ack.channel, 1);
    EXPECT_EQ(ack.connector, 1);
    now_ += std::chrono::seconds(10);
    ASSERT_EQ(pulses(), 1U);
    const auto& only = device_.pulses(now_).front();
    EXPECT_EQ(only.end - only.onset, microseconds(500));
    EXPECT_EQ(only.channel, 5);
    EXPECT_EQ(plain(Command::LowLevelStop), ResultCode::Ok);
    EXPECT_EQ(pulse().result, ResultCode::NotInitialised);
}

TEST_F(EmulatedScienceMode, SamplesAreTheLoadsVoltageAndCurrent) {
    initialise(Measurement::Voltage);
    setLoad("2 kohm");
    auto ack = pulse(5);
    ASSERT_EQ(ack.sampleTime_us, 4) << "128 samples cover 500 µs";
    EXPECT_EQ(ack.samples[0], 1000) << "5 mA · 2 kohm = 10 V";
    EXPECT_EQ(ack.samples[49], 1000);
    EXPECT_EQ(ack.samples[50], 0) << "the gap begins at 200 µs";
    EXPECT_EQ(ack.samples[75], 1000) << "the second phase, its sign lost";
    EXPECT_EQ(ack.samples[125], 0);
    initialise(Measurement::Current);
    ack = pulse(5);
    EXPECT_EQ(ack.samples[10], 500);
    EXPECT_EQ(ack.samples[60], 0);
}

TEST_F(EmulatedScienceMode, SamplesOfTheRcLoadRiseAsItsClosedFormSays) {
    initialise(Measurement::Voltage);
    setLoad("200 ohm + 10 kohm || 50 nF");
    const auto ack = pulse(5);
    for (std::size_t i = 0; i < 50; ++i) {
        const double t = static_cast<double>(i) * 4e-6;
        const double volts = 5e-3 * (200 + 10e3 * (1 - std::exp(-t / 500e-6)));
        EXPECT_NEAR(ack.samples[i] * 0.01, volts, 0.006) << i;
    }
}

TEST_F(EmulatedScienceMode, ResultsAreWhatTheLoadMakesThem) {
    RecordProperty("hazard", "H3");
    initialise();
    setLoad("open");
    EXPECT_EQ(pulse().result, ResultCode::Electrode);
    setLoad("100 kohm");
    EXPECT_EQ(pulse(5).result, ResultCode::LowCurrent) << "500 V would be needed";
    setLoad("short");
    const auto ack = pulse(5);
    EXPECT_EQ(ack.result, ResultCode::Ok);
    EXPECT_EQ(ack.samples[10], 0);
}

TEST_F(EmulatedScienceMode, ABusyOutputRefusesAndALowLevelStopCutsIt) {
    initialise();
    FrameBytes frame;
    const auto payload = payloadOf(ChannelConfig{0, 0, true, biphasicPoints()});
    ASSERT_TRUE(encodeFrame({2, 40, payload->view()}, frame));
    device_.receive(frame.view(), now_);
    now_ += microseconds(100);
    ASSERT_TRUE(encodeFrame({2, 41, payload->view()}, frame));
    device_.receive(frame.view(), now_);
    EXPECT_EQ(pulses(), 1U);
    device_.receive(
        [&] {
            EXPECT_TRUE(encodeFrame({4, 42, {}}, frame));
            return frame.view();
        }(),
        now_);
    const auto& cut = device_.pulses(now_).front();
    EXPECT_TRUE(cut.cut);
    EXPECT_EQ(cut.end - cut.onset, microseconds(100));
}

TEST_F(EmulatedScienceMode, ARepetitionGoesOnUntilItIsStopped) {
    device_.startRepeating(biphasicPoints(), Seconds(0.5), now_);
    now_ += std::chrono::seconds(10);
    EXPECT_TRUE(device_.repeating(now_));
    EXPECT_EQ(device_.state(now_), Stimulation::MidLevelRunning);
    EXPECT_EQ(pulses(), 21U);
    EXPECT_EQ(plain(Command::MidLevelStop), ResultCode::Ok);
    now_ += std::chrono::seconds(1);
    EXPECT_EQ(pulses(), 21U);
    EXPECT_EQ(device_.state(now_), Stimulation::None);
}

TEST_F(EmulatedScienceMode, ResidualVoltageCarriesFromPulseToPulse) {
    initialise(Measurement::Voltage);
    setLoad("200 ohm + 10 kohm || 50 nF");
    Points lead;
    ASSERT_TRUE(lead.add({Micros(200), Milliamps(5)}));
    const auto payload = payloadOf(ChannelConfig{0, 0, true, lead});
    const auto first = ask(Command::ChannelConfig, *payload);
    const auto second = ask(Command::ChannelConfig, *payload);
    ChannelConfigAck one, two;
    ASSERT_TRUE(readChannelConfigAck(first, one));
    ASSERT_TRUE(readChannelConfigAck(second, two));
    EXPECT_NEAR(one.samples[0] * 0.01, 1.0, 0.01);
    // 16.5 V on the capacitor decay with a time constant of 500 µs during the 500 µs before the next pulse.
    const double left = 5e-3 * 10e3 * (1 - std::exp(-0.4)) * std::exp(-1.0);
    EXPECT_NEAR(two.samples[0] * 0.01, 1.0 + left, 0.05);
}

}  // namespace
}  // namespace tacto::test
