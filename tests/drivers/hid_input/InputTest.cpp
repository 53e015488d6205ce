// HidInput with fake devices: which devices are offered, what a listener hears, and what happens after unplugging.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/hid_input/HidInput.h"
#include "tests/drivers/hid_input/PadDescriptors.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Records what a listener hears, in words: "down 4", "gone".
class Heard {
public:
    ButtonListener listener() {
        return {[this](const ButtonPress& press) {
                    add(fmt::format("{} {}", press.down ? "down" : "up", press.button));
                    last_ = press.at;
                },
                [this](bool there) { add(there ? "back" : "gone"); }};
    }
    [[nodiscard]] std::vector<std::string> all() const {
        const std::scoped_lock lock(mutex_);
        return all_;
    }
    /// Waits up to 5 s; true if `count` events were heard.
    [[nodiscard]] bool wait(std::size_t count) const {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, std::chrono::seconds(5), [&] { return all_.size() >= count; });
    }

private:
    void add(std::string what) {
        const std::scoped_lock lock(mutex_);
        all_.push_back(std::move(what));
        changed_.notify_all();
    }
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    std::vector<std::string> all_;  // guarded by mutex_
    std::chrono::steady_clock::time_point last_;
};

class HidInputTest : public testing::Test {
protected:
    FakeHidDevice& plug(std::uint16_t product, const std::string& serial, Bytes descriptor,
                        hid::Usage usage = 0x10004) {
        const auto path = fmt::format("/dev/hidraw{}", backend->plugged.size());
        const hid::HidDeviceInfo info{0x046D, product, serial, "Pad", path, usage, true};
        backend->plugged.push_back(std::make_shared<FakeHidDevice>(clock, info, std::move(descriptor)));
        return *backend->plugged.back();
    }
    const SteadyClock clock;
    std::shared_ptr<FakeHidBackend> backend = std::make_shared<FakeHidBackend>();
    std::shared_ptr<const ButtonDevices> devices = hid::makeHidInput(backend);
    Heard heard;
};

TEST_F(HidInputTest, PadsAndPedalsAreOfferedWithTheirButtonsAndWhatTypesIsNot) {
    plug(0xC216, "", padDescriptor());
    plug(0x0001, "17", pedalDescriptor(), 0x000C0003);
    const Bytes keyboard{0x05, 0x01, 0x09, 0x06, 0xA1, 0x01, 0x05, 0x07, 0x19, 0x00, 0x29, 0x65,
                         0x15, 0x00, 0x25, 0x65, 0x75, 0x08, 0x95, 0x06, 0x81, 0x00, 0xC0};
    plug(0x0002, "", keyboard, 0x10006);
    const auto list = devices->list();
    ASSERT_EQ(list.size(), 2U);
    EXPECT_EQ(list[0].identity, "046d:c216");
    EXPECT_EQ(list[0].buttons.size(), 12U);
    EXPECT_EQ(list[0].obstacle, "");
    EXPECT_EQ(list[1].identity, "046d:0001 17");
    EXPECT_THAT(list[1].buttons, ElementsAre("1", "2", "3"));
}

TEST_F(HidInputTest, WhatCannotBeUsedSaysWhyAndIsNotOpened) {
    plug(0x0001, "", Bytes{0x05});  // a truncated descriptor
    plug(0x0002, "", Bytes{0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0xC0}, 0x10005);
    plug(0x0003, "", padDescriptor()).setPermitted(false);
    const auto list = devices->list();
    ASSERT_EQ(list.size(), 3U);
    EXPECT_THAT(list[0].obstacle, HasSubstr("046d:0001 at /dev/hidraw0 cannot answer: HID report descriptor: byte 0"));
    EXPECT_THAT(list[1].obstacle, HasSubstr("0 other inputs and no button"));
    EXPECT_THAT(list[2].obstacle, HasSubstr("./dev install-rules --device 046d:0003"));
    for (const auto& one : list) {
        EXPECT_THAT(devices->open(one, heard.listener()), refusedSaying(testing::Eq(one.obstacle)));
    }
}

TEST_F(HidInputTest, TwinsCannotBeToldApartAndNeitherIsOpened) {
    RecordProperty("hazard", "H4");
    plug(0xC216, "", padDescriptor());
    auto& second = plug(0xC216, "", padDescriptor());
    const auto list = devices->list();
    ASSERT_EQ(list.size(), 2U);
    for (const auto& one : list) {
        EXPECT_THAT(one.obstacle, HasSubstr("2 devices are 046d:c216"));
        EXPECT_FALSE(devices->open(one, heard.listener()));
    }
    second.unplug();
    EXPECT_EQ(devices->list().at(0).obstacle, "");
}

TEST_F(HidInputTest, APressIsHeardOnceHoweverOftenTheDeviceReportsIt) {
    RecordProperty("hazard", "H2");
    auto& pad = plug(0xC216, "", padDescriptor());
    const auto opened = accepted(devices->open(devices->list().at(0), heard.listener()));
    for (int i = 0; i < 50; ++i) pad.send(padReport({5}));
    pad.send(padReport({}));
    ASSERT_IN_TIME(heard.wait(2));
    EXPECT_THAT(heard.all(), ElementsAre("down 4", "up 4"));
}

TEST_F(HidInputTest, UnpluggedItSaysSoAndComesBackByItselfWithNoButtonDown) {
    RecordProperty("hazard", "H2");
    auto& pad = plug(0xC216, "", padDescriptor());
    const auto opened = devices->open(devices->list().at(0), heard.listener());
    ASSERT_TRUE(opened);
    pad.send(padReport({1}));
    ASSERT_IN_TIME(heard.wait(1));
    pad.unplug();
    ASSERT_IN_TIME(heard.wait(2));
    pad.plug();
    ASSERT_IN_TIME(heard.wait(3));
    pad.send(padReport({1}));
    ASSERT_IN_TIME(heard.wait(4));
    EXPECT_THAT(heard.all(), ElementsAre("down 0", "gone", "back", "down 0"));
    EXPECT_EQ(pad.openNow(), 1);
}

TEST_F(HidInputTest, AnotherDeviceTakesNoPlaceOfOneThatWent) {
    RecordProperty("hazard", "H4");
    auto& pad = plug(0xC216, "A", padDescriptor());
    auto& other = plug(0xC216, "B", padDescriptor());
    const auto opened = devices->open(devices->list().at(0), heard.listener());
    ASSERT_TRUE(opened);
    pad.unplug();
    ASSERT_IN_TIME(heard.wait(1));
    other.send(padReport({1}));
    pad.setDescriptor(pedalDescriptor());  // same numbers, but another descriptor: another device
    pad.plug();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // nothing may happen in this time
    EXPECT_THAT(heard.all(), ElementsAre("gone"));
    EXPECT_EQ(other.openings(), 0);
}

TEST_F(HidInputTest, OneLikeItThatWasThereBesideItTakesNoPlaceOfIt) {
    RecordProperty("hazard", "H4");
    auto& pad = plug(0xC216, "", padDescriptor());
    const auto opened = devices->open(devices->list().at(0), heard.listener());
    ASSERT_TRUE(opened);
    auto& spare = plug(0xC216, "", padDescriptor());  // a spare pad for the next participant
    pad.unplug();
    ASSERT_IN_TIME(heard.wait(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // nothing may happen in this time
    EXPECT_THAT(heard.all(), ElementsAre("gone"));
    EXPECT_EQ(spare.openings(), 0);
    pad.plug();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // nothing may happen: the two cannot be told apart
    EXPECT_THAT(heard.all(), ElementsAre("gone"));
    spare.unplug();
    ASSERT_IN_TIME(heard.wait(2));
    EXPECT_THAT(heard.all(), ElementsAre("gone", "back"));
    EXPECT_EQ(pad.openNow(), 1);
}

TEST_F(HidInputTest, AReportThatIsTooShortChangesNothingAndOneThatIsTooLongCountsByItsBeginning) {
    RecordProperty("hazard", "H4");
    auto& pad = plug(0xC216, "", padDescriptor());
    const auto opened = devices->open(devices->list().at(0), heard.listener());
    ASSERT_TRUE(opened);
    const auto report = padReport({5});
    pad.send(Bytes(report.begin(), report.end() - 1));
    pad.send(padReport({1}));
    auto longer = padReport({1, 2});
    longer.push_back(0xFF);
    pad.send(longer);
    ASSERT_IN_TIME(heard.wait(2));
    EXPECT_THAT(heard.all(), ElementsAre("down 0", "down 1"));
}

TEST_F(HidInputTest, ClosingTakesNoLongerThanItSaysAndNothingIsHeardAfterwards) {
    auto& pad = plug(0xC216, "", padDescriptor());
    auto opened = accepted(devices->open(devices->list().at(0), heard.listener()));
    const auto before = std::chrono::steady_clock::now();
    opened.reset();
    EXPECT_IN_TIME(std::chrono::steady_clock::now() - before <= std::chrono::milliseconds(50));
    pad.send(padReport({1}));
    EXPECT_TRUE(heard.all().empty());
    EXPECT_EQ(pad.openNow(), 0);
}

}  // namespace
}  // namespace tacto::test
