// Game pads through the real hidapi, on emulated devices.
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "drivers/hid_input/HidInput.h"
#include "tests/drivers/hid_input/PadDescriptors.h"
#include "tests/support/InTime.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"
#include "tests/support/usb_emulation/EmulatedHidDevice.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;

class SystemInput : public testing::Test {
protected:
    ButtonListener listener() {
        return {[this](const ButtonPress& press) { add(press.down ? int(press.button) + 1 : -int(press.button) - 1); },
                [this](bool there) { add(there ? 1000 : -1000); }};
    }
    void add(int what) {
        const std::scoped_lock lock(mutex);
        heard.push_back(what);
        changed.notify_all();
    }
    bool wait(std::size_t count) {
        std::unique_lock lock(mutex);
        return changed.wait_for(lock, std::chrono::seconds(5), [&] { return heard.size() >= count; });
    }
    UsbTestbed bed;
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<int> heard;  // the button's number, negative if released; ±1000: device back, gone
};

TEST_F(SystemInput, APadIsListedAndItsButtonsAreHeardUntilItIsUnpluggedAndAfterItIsBack) {
    RecordProperty("hazard", "H2");
    EmulatedHidDevice pad(bed, 0x046D, 0xC216, "", padDescriptor(), {});
    const auto devices = hid::systemHidInput();
    const auto list = devices->list();
    ASSERT_EQ(list.size(), 1U);
    EXPECT_EQ(list[0].address, "/dev/hidraw0");
    EXPECT_EQ(list[0].identity, "046d:c216");
    EXPECT_EQ(list[0].buttons.size(), 12U);
    const auto opened = accepted(devices->open(list[0], listener()));
    pad.send(padReport({6}));
    ASSERT_IN_TIME(wait(1));
    pad.send(padReport({}));
    ASSERT_IN_TIME(wait(2));
    pad.unplug();
    ASSERT_IN_TIME(wait(3));
    pad.plug();
    ASSERT_IN_TIME(wait(4));
    pad.send(padReport({1}));
    ASSERT_IN_TIME(wait(5));
    const std::scoped_lock lock(mutex);
    EXPECT_THAT(heard, ElementsAre(6, -6, -1000, 1000, 1));
}

TEST_F(SystemInput, APressIsHeardWithinFiveMilliseconds) {
    RecordProperty("hazard", "H2");
    EmulatedHidDevice pad(bed, 0x046D, 0xC216, "", padDescriptor(), {});
    const auto devices = hid::systemHidInput();
    const auto opened = accepted(devices->open(devices->list().at(0), listener()));
    std::vector<std::chrono::nanoseconds> took;
    while (took.size() < 100) {
        const auto before = std::chrono::steady_clock::now();
        pad.send(padReport(took.size() % 2 == 0 ? std::initializer_list<int>{6} : std::initializer_list<int>{}));
        ASSERT_IN_TIME(wait(took.size() + 1));
        took.push_back(std::chrono::steady_clock::now() - before);
    }
    std::sort(took.begin(), took.end());
    EXPECT_IN_TIME(took[94] <= std::chrono::milliseconds(5)) << took[94].count() << " ns, p95 of 100";
}

TEST_F(SystemInput, AFootSwitchOfProgrammableButtons) {
    EmulatedHidDevice pedal(bed, 0x05F3, 0x00FF, "", pedalDescriptor(), {});
    const auto devices = hid::systemHidInput();
    const auto list = devices->list();
    ASSERT_EQ(list.size(), 1U);
    const auto opened = accepted(devices->open(list[0], listener()));
    pedal.send(Bytes{0x04, 0x00});
    ASSERT_IN_TIME(wait(1));
    const std::scoped_lock lock(mutex);
    EXPECT_THAT(heard, ElementsAre(3));
}

}  // namespace
}  // namespace tacto::test
