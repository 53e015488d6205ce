// The scheme sciencemode: which device a URI opens, over USB ports and through a terminal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <thread>

#include "drivers/sciencemode/ScienceModeDriver.h"
#include "drivers/sciencemode/TtyTransport.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"
#include "tests/support/FailsInTime.h"
#include "tests/support/InTime.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/Refused.h"
#include "tests/support/emulated/sciencemode/EmulatedPty.h"

namespace tacto::test {
namespace {

using namespace sciencemode;
using sciencemode::Command;
using std::chrono::milliseconds;
using testing::HasSubstr;

/// USB sockets that hold emulated devices.
class EmulatedPorts final : public TransportPorts {
public:
    explicit EmulatedPorts(const Clock& clock) : clock_(clock) {}
    std::shared_ptr<EmulatedLine> add(TransportPort port, const EmulatedSettings& settings) {
        auto line = std::make_shared<EmulatedLine>(clock_, nullptr, settings);
        lines_[port.place] = line;
        ports_.push_back(std::move(port));
        return line;
    }
    std::vector<TransportPort> list() const override { return ports_; }
    Result<std::unique_ptr<Transport>> open(const TransportPort& port) override {
        opened.push_back(port.place);
        return lines_.at(port.place)->connect();
    }
    std::vector<std::string> opened;
    std::vector<TransportPort> ports_;

private:
    const Clock& clock_;
    std::map<std::string, std::shared_ptr<EmulatedLine>> lines_;
};

EmulatedSettings named(std::string id) {
    EmulatedSettings settings;
    settings.id = std::move(id);
    return settings;
}

class ScienceModeUri : public testing::Test {
protected:
    [[nodiscard]] Result<void> open(const std::string& text) {
        devices_ = {};
        const auto uri = DeviceUri::parse(text);
        if (!uri) return failure(uri);
        return driver_->open(*uri, {}, OpenContext{clock_, 1, "1 kohm"}, devices_);
    }
    [[nodiscard]] std::string serial() const { return devices_.stimulator->identity().serial; }
    void deliver(double milliamps = 5) {
        const auto gate = benchGate(clock_, devices_.stimulator->traits());
        const auto delivered = devices_.stimulator->deliver(approve(*gate, clock_, biphasic(milliamps), Seconds(2)));
        ASSERT_IN_TIME(delivered);
    }

    SteadyClock clock_;
    std::shared_ptr<EmulatedPorts> ports_ = std::make_shared<EmulatedPorts>(clock_);
    std::unique_ptr<Driver> driver_ = makeScienceModeDriver(ports_);
    DeviceSet devices_;
};

TEST_F(ScienceModeUri, OpensTheOneThatAnswersAsAStimulator) {
    const auto other = ports_->add({"A1", "1-1", ""}, named("whatever"));
    other->inspect([](auto& device, Instant) { device.misbehave(AckFault::Drop, 1000); });  // some other STM32 device
    ports_->add({"A2", "1-2", ""}, named("P24-000002"));
    ASSERT_IN_TIME(open("sciencemode:"));
    EXPECT_EQ(serial(), "P24-000002");
    EXPECT_FALSE(devices_.stimulator->identity().simulated);
}

TEST_F(ScienceModeUri, FindsADeviceByItsUsbSerialOrItsIdentity) {
    RecordProperty("hazard", "H4");
    ports_->add({"A1", "1-1", ""}, named("P24-000001"));
    ports_->add({"A2", "1-2", ""}, named("P24-000002"));
    ASSERT_IN_TIME(open("sciencemode:P24-000002"));
    EXPECT_EQ(serial(), "P24-000002");
    ASSERT_IN_TIME(open("sciencemode:A1"));
    EXPECT_EQ(serial(), "P24-000001");
    EXPECT_EQ(ports_->opened.back(), "1-1");
    const auto missing = open("sciencemode:P24-000003");
    ASSERT_FALSE(missing.has_value());
    EXPECT_CODE_IN_TIME(missing.error().code, ErrorCode::NotFound);
    EXPECT_EQ(devices_.stimulator, nullptr);
}

TEST_F(ScienceModeUri, EachOfTwoIsListedWithAnAddressThatOpensItAndNoOther) {
    RecordProperty("hazard", "H4");
    ports_->add({"A1", "1-1", ""}, named("P24-000001"));
    ports_->add({"", "1-2", ""}, named("P24-000002"));
    ports_->add({"B", "1-3", ""}, named("P24-000003"));
    ports_->add({"B", "1-4", ""}, named("P24-000004"));
    const auto list = driver_->list();
    std::vector<std::string> uris;
    for (const auto& one : list) uris.push_back(one.uri);
    EXPECT_THAT(uris, testing::ElementsAre("sciencemode:A1", "sciencemode:1-2", "sciencemode:1-3", "sciencemode:1-4"));
    for (std::size_t i = 0; i < uris.size(); ++i) {
        ports_->opened.clear();
        ASSERT_IN_TIME(open(uris[i])) << uris[i];
        EXPECT_EQ(serial(), fmt::format("P24-00000{}", i + 1));
        EXPECT_THAT(ports_->opened, testing::Each(fmt::format("1-{}", i + 1))) << "another one was spoken to";
    }
    EXPECT_THAT(open("sciencemode:B"), refused(ErrorCode::InvalidArgument, "sciencemode:1-3 or sciencemode:1-4"));
}

TEST_F(ScienceModeUri, OfSeveralThatAnswerOneMustBeNamed) {
    RecordProperty("hazard", "H4");
    ports_->add({"A1", "1-1", ""}, named("P24-000001"));
    ports_->add({"A2", "1-2", ""}, named("P24-000002"));
    const auto opened = open("sciencemode:");
    ASSERT_IN_TIME(!opened) << "one of the two did not answer";
    ASSERT_CODE_IN_TIME(opened.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(opened.error().message, HasSubstr("could be sciencemode:A1 or sciencemode:A2: name one"));
    EXPECT_THAT(lookAt(DeviceUri::parse("sciencemode:").value(), ports_.get(), clock_),
                refusedSaying(testing::Eq(opened.error().message)));
    ASSERT_IN_TIME(open("sciencemode:A2"));
    EXPECT_EQ(serial(), "P24-000002");
}

TEST_F(ScienceModeUri, ALookSaysWhoIsWhereAndLeavesWhatRunsAlone) {
    ports_->add({"A1", "1-1", "1-1 may not be opened"}, named("P24-000001"));
    const auto line = ports_->add({"A2", "1-2", ""}, named("P24-000002"));
    line->inspect(startRepeating);
    const auto stops = [&] {
        return line->inspect([](auto& device, Instant) {
            return device.requests(Command::LowLevelStop) + device.requests(Command::MidLevelStop) +
                   device.requests(Command::LowLevelInit);
        });
    };
    const auto before = stops();
    for (const auto* text : {"sciencemode:", "sciencemode:P24-000002", "sciencemode:A2"}) {
        const auto seen = lookAt(*DeviceUri::parse(text), ports_.get(), clock_);
        ASSERT_IN_TIME(seen);
        EXPECT_EQ(seen->identification.id, "P24-000002");
        EXPECT_EQ(seen->place, "1-2");
        EXPECT_FALSE(seen->simulated);
        EXPECT_EQ(seen->status.status, Stimulation::MidLevelRunning);
    }
    EXPECT_EQ(stops(), before);
    EXPECT_THAT(lookAt(*DeviceUri::parse("sciencemode:A1"), ports_.get(), clock_), refusedSaying("may not be opened"));
    EXPECT_EQ(lookAt(*DeviceUri::parse("sciencemode:"), nullptr, clock_).error().code, ErrorCode::NotFound);
    EXPECT_EQ(lookAt(*DeviceUri::parse("sim:"), ports_.get(), clock_).error().code, ErrorCode::InvalidArgument);
}

TEST_F(ScienceModeUri, SaysWhyNothingCouldBeOpened) {
    EXPECT_THAT(open("sciencemode:").error().message, HasSubstr("none is plugged in"));
    ports_->add({"A1", "1-1", "may not be opened by you: run ./dev install-rules"}, named("P24-000001"));
    EXPECT_THAT(open("sciencemode:"), refused(ErrorCode::Io, "install-rules"));
    const auto listed = driver_->list();
    ASSERT_EQ(listed.size(), 1U);
    EXPECT_THAT(listed[0].obstacle, HasSubstr("install-rules"));
    EXPECT_EQ(listed[0].uri, "sciencemode:A1");
}

TEST_F(ScienceModeUri, ParametersReachTheDevice) {
    RecordProperty("hazard", "H4");
    const auto line = ports_->add({"A1", "1-1", ""}, named("P24-000001"));
    ASSERT_IN_TIME(open("sciencemode:?channel=2&connector=green&voltage=60&measure=current"));
    EXPECT_FALSE(devices_.stimulator->traits().readsBack);
    deliver();
    ASSERT_EQ(line->pulses(), 1U);
    EXPECT_EQ(line->pulseList()[0].channel, 6);
    bool found = false;
    for (const auto& bytes : line->written()) {
        FrameDecoder decoder;
        std::span<const std::uint8_t> view(bytes);
        const auto packet = decoder.take(view);
        if (packet->command != 0) continue;
        found = true;
        EXPECT_EQ(readLowLevelInit(packet->payload), (LowLevelInit{HighVoltage::V60, Measurement::Current}));
    }
    EXPECT_TRUE(found);
}

TEST_F(ScienceModeUri, RefusesWhatItDoesNotKnow) {
    ports_->add({"A1", "1-1", ""}, named("P24-000001"));
    for (const auto* wrong :
         {"channel=4", "channel=-1", "channel=1.5", "channel=nan", "channel=x", "connector=blue", "level=mid",
          "level=low", "measure=all", "voltage=40", "emulated=1", "tty=", "speed=3", "channel=1&channel=2"}) {
        EXPECT_THAT(open(std::string("sciencemode:?") + wrong), refused(ErrorCode::InvalidArgument)) << wrong;
    }
    EXPECT_TRUE(ports_->opened.empty());
    ASSERT_IN_TIME(open("sciencemode:"));
    const auto second = driver_->open({"sciencemode", "", {}}, {}, OpenContext{clock_, 1, "1 kohm"}, devices_);
    EXPECT_EQ(second.error().code, ErrorCode::InvalidArgument) << "a bench has one stimulator";
}

TEST_F(ScienceModeUri, AReplugIntoAnotherSocketIsFoundByItsSerialNumber) {
    const auto line = ports_->add({"A1", "1-1", ""}, named("P24-000001"));
    ASSERT_TRUE(open("sciencemode:").has_value());
    line->unplug();
    ports_->ports_.clear();
    EXPECT_CODE_IN_TIME(devices_.stimulator->status().error().code, ErrorCode::Device);
    line->plug();
    const auto stranger = ports_->add({"B7", "1-1", ""}, named("P24-000007"));
    EXPECT_FALSE(devices_.stimulator->status().has_value()) << "the same socket, another device";
    ports_->ports_ = {{"B7", "1-1", ""}};
    EXPECT_FALSE(devices_.stimulator->status().has_value());
    EXPECT_EQ(stranger->written().size(), 0U) << "it is not even asked";
}

// --- through a terminal ---------------------------------------------------------------------------------------------

class ScienceModePty : public ScienceModeUri {
protected:
    void SetUp() override { pty_ = accepted(EmulatedPty::open({}, clock_)); }
    std::unique_ptr<EmulatedPty> pty_;
};

TEST_F(ScienceModePty, DeliversAndReadsBack) {
    const auto opened = open("sciencemode:?emulated=yes&tty=" + pty_->path());
    ASSERT_IN_TIME(opened);
    EXPECT_TRUE(devices_.stimulator->identity().simulated);
    for (int i = 0; i < 100; ++i) {
        ASSERT_NO_FATAL_FAILURE(deliver(0.5 * (i + 1)));
        const auto status = devices_.stimulator->status();
        ASSERT_IN_TIME(status);
        ASSERT_IN_TIME(status->impedance);
        EXPECT_NEAR(status->impedance->value(), 1000, 20);
    }
    EXPECT_EQ(pty_->inspect([](auto& device, Instant now) { return device.pulses(now).size(); }), 100U);
}

TEST_F(ScienceModePty, WhatItSaysOfItselfMakesNothingSimulated) {
    RecordProperty("hazard", "H4");
    ASSERT_IN_TIME(open("sciencemode:?tty=" + pty_->path()));
    EXPECT_TRUE(devices_.stimulator->identity().serial.starts_with("EMU"));
    EXPECT_FALSE(devices_.stimulator->identity().simulated);
    devices_.stimulator.reset();
    for (const auto* emulated : {"no", "yes"}) {
        const auto seen = lookAt(
            *DeviceUri::parse(fmt::format("sciencemode:?emulated={}&tty={}", emulated, pty_->path())), nullptr, clock_);
        ASSERT_IN_TIME(seen);
        EXPECT_EQ(seen->simulated, emulated == std::string_view("yes"));
    }
}

TEST_F(ScienceModeUri, ADeviceThatIsNoEmulatorIsNotOpenedAsOne) {
    RecordProperty("hazard", "H4");
    ports_->add({"A1", "1-1", ""}, named("P24-000001"));
    EXPECT_THAT(open("sciencemode:?emulated=yes"),
                refusedSaying("P24-000001 answers where the address says emulated=yes"));
    ASSERT_IN_TIME(open("sciencemode:"));
    EXPECT_FALSE(devices_.stimulator->identity().simulated);
}

TEST_F(ScienceModePty, StopReachesTheDevice) {
    RecordProperty("hazard", "H2");
    ASSERT_IN_TIME(open("sciencemode:?tty=" + pty_->path()));
    pty_->inspect(startRepeating);
    ASSERT_TRUE(pty_->inspect([](auto& device, Instant now) { return device.repeating(now); }));
    ASSERT_IN_TIME(devices_.stimulator->status().value_or(StimulatorStatus{}).delivering);
    devices_.stimulator->forceOff();
    const auto status = devices_.stimulator->status();  // the ack of the status comes after those of the stops
    ASSERT_IN_TIME(status);
    EXPECT_FALSE(status->delivering);
    EXPECT_FALSE(pty_->inspect([](auto& device, Instant now) { return device.repeating(now); }));
}

TEST_F(ScienceModePty, AHungUpTerminalIsADeviceThatIsGone) {
    RecordProperty("hazard", "H2");
    ASSERT_IN_TIME(open("sciencemode:?tty=" + pty_->path()));
    pty_.reset();
    const auto gate = benchGate(clock_, devices_.stimulator->traits());
    const auto gone = devices_.stimulator->deliver(approve(*gate, clock_, biphasic(5), Seconds(2)));
    ASSERT_FALSE(gone.has_value());
    EXPECT_CODE_IN_TIME(gone.error().code, ErrorCode::Device);
    EXPECT_CODE_IN_TIME(devices_.stimulator->status().error().code, ErrorCode::Device);
    devices_.stimulator->forceOff();
}

TEST_F(ScienceModePty, RefusesWhatIsNoTerminal) {
    EXPECT_EQ(open("sciencemode:?tty=/no/such/terminal").error().code, ErrorCode::NotFound);
    EXPECT_EQ(open("sciencemode:?tty=/dev/null").error().code, ErrorCode::Io);
}

TEST_F(ScienceModePty, ATerminalThatAnotherProgramHasLockedIsRefusedAndThatProgramIsNamed) {
    RecordProperty("hazard", "H2");
    {
        const OtherProgram other(pty_->path(), true);
        EXPECT_THAT(open("sciencemode:?tty=" + pty_->path()),
                    refused(ErrorCode::Io, testing::AllOf(HasSubstr(pty_->path()), HasSubstr(other.text()),
                                                          HasSubstr("close that program"))));
    }
    ASSERT_IN_TIME(open("sciencemode:?tty=" + pty_->path()));
    // The same program cannot open the terminal twice either.
    EXPECT_EQ(TtyTransport::open(pty_->path()).error().code, ErrorCode::Io);
}

TEST_F(ScienceModePty, AReadWaitsNoLongerThanItIsAllowed) {
    auto transport = accepted(TtyTransport::open(pty_->path()));
    std::array<std::uint8_t, 16> into{};
    for (const double s : {0.0, 0.03, -1.0, std::nan("")}) {
        const Instant begin = clock_.now();
        EXPECT_EQ(transport->read(into, Seconds(s)).error().code, ErrorCode::Timeout);
        EXPECT_GE(clock_.now() - begin, s > 0 ? milliseconds(30) : milliseconds(0));
        EXPECT_IN_TIME(clock_.now() - begin < milliseconds(1000));
    }
}

TEST_F(ScienceModePty, UrgentMessagesAndFramesNeverMix) {
    RecordProperty("hazard", "H2");
    auto transport = accepted(TtyTransport::open(pty_->path()));
    // With pauses, because otherwise their acks alone would fill the line.
    std::vector<std::jthread> stoppers;
    for (int i = 0; i < 3; ++i) {
        stoppers.emplace_back([&](const std::stop_token& stop) {
            while (!stop.stop_requested()) {
                transport->writeUrgent(stopFrames().lowLevel.view());
                std::this_thread::sleep_for(std::chrono::microseconds(300));
            }
        });
    }
    Exchange exchange(*transport, clock_);
    for (int i = 0; i < 300; ++i) {
        const auto answer = exchange.ask(Command::StimStatus, {}, Seconds(10));
        ASSERT_IN_TIME(answer);
    }
    stoppers.clear();
    EXPECT_EQ(exchange.counts().junkBytes, 0U);
    EXPECT_EQ(pty_->inspect([](auto& device, Instant) { return device.requests(Command::StimStatus); }), 300U);
    EXPECT_GT(pty_->inspect([](auto& device, Instant) { return device.requests(Command::LowLevelStop); }), 0U);
}

}  // namespace
}  // namespace tacto::test
