// HidButtons: which buttons a descriptor offers, and what each report says about them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/hid_input/HidButtons.h"
#include "tests/drivers/hid_input/PadDescriptors.h"
#include "tests/support/Refused.h"

namespace tacto::test {
namespace {

using hid::HidButtons;
using testing::ElementsAre;
using testing::IsEmpty;
using Change = HidButtons::Change;

Result<HidButtons> buttonsOf(const Bytes& bytes) {
    const auto descriptor = hid::parseHidDescriptor(bytes);
    if (!descriptor) return failure(descriptor);
    return HidButtons::of(*descriptor);
}

TEST(HidButtons, APadHasItsTwelveAndNeitherSticksNorHat) {
    RecordProperty("hazard", "H4");
    auto buttons = accepted(buttonsOf(padDescriptor()));
    ASSERT_EQ(buttons.labels().size(), 12U);
    EXPECT_EQ(buttons.labels().front(), "1");
    EXPECT_EQ(buttons.labels().back(), "12");
    EXPECT_THAT(buttons.read(padReport({})), IsEmpty());
    for (int button = 1; button <= 12; ++button) {
        EXPECT_THAT(buttons.read(padReport({button})), ElementsAre(Change{std::size_t(button - 1), true})) << button;
        auto moved = padReport({button});
        moved[0] = 0;     // a stick
        moved[7] = 0x12;  // a byte of the vendor's own
        EXPECT_THAT(buttons.read(moved), IsEmpty()) << "held: one press";
        EXPECT_THAT(buttons.read(padReport({})), ElementsAre(Change{std::size_t(button - 1), false})) << button;
    }
    EXPECT_THAT(buttons.read(padReport({5, 6})), ElementsAre(Change{4, true}, Change{5, true}));
    EXPECT_THAT(buttons.read(padReport({6, 1})), ElementsAre(Change{0, true}, Change{4, false}));
}

TEST(HidButtons, ThePedalsOfAFootSwitch) {
    auto buttons = accepted(buttonsOf(pedalDescriptor()));
    EXPECT_THAT(buttons.labels(), ElementsAre("1", "2", "3"));
    EXPECT_THAT(buttons.read(Bytes{0x02, 0}), ElementsAre(Change{1, true}));
    buttons.forget();
    EXPECT_THAT(buttons.read(Bytes{0x02, 0}), ElementsAre(Change{1, true})) << "plugged in again";
}

TEST(HidButtons, TwoPadsInOneDeviceAreToldApartByTheirReports) {
    RecordProperty("hazard", "H4");
    auto buttons = accepted(buttonsOf(twoPadsDescriptor()));
    EXPECT_THAT(buttons.labels(), ElementsAre("1", "2", "2-1", "2-2"));
    EXPECT_THAT(buttons.read(Bytes{2, 0x01}), ElementsAre(Change{2, true}));
    EXPECT_THAT(buttons.read(Bytes{1, 0x01}), ElementsAre(Change{0, true})) << "and the other one's is still down";
    EXPECT_THAT(buttons.read(Bytes{3, 0x03}), IsEmpty()) << "a report that it does not have";
}

TEST(HidButtons, ACutReportChangesNothing) {
    RecordProperty("hazard", "H10");
    auto buttons = accepted(buttonsOf(padDescriptor()));
    const auto whole = padReport({1, 12});
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_THAT(buttons.read(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(length))), IsEmpty()) << length;
    EXPECT_THAT(buttons.read(whole), ElementsAre(Change{0, true}, Change{11, true}));
}

TEST(HidButtons, WithoutButtonsOrWithTooManyItIsRefusedWithWhatItHas) {
    // In turn: only the sticks of a pad; the buttons of a mouse; 200 buttons.
    const Bytes sticks{0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0x75, 0x08, 0x95, 0x02, 0x15,
                       0x00, 0x26, 0xFF, 0x00, 0x09, 0x30, 0x09, 0x31, 0x81, 0x02, 0xC0};
    EXPECT_THAT(buttonsOf(sticks), refused(ErrorCode::Unsupported, "2 other inputs and no button"));
    const Bytes mouse{0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0x05, 0x09, 0x19, 0x01, 0x29, 0x03,
                      0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x08, 0x81, 0x02, 0xC0};
    EXPECT_FALSE(buttonsOf(mouse)) << "whose buttons are the window's";
    const Bytes many{0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0x05, 0x09, 0x19, 0x01, 0x29, 0xC8,
                     0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0xC8, 0x81, 0x02, 0xC0};
    EXPECT_THAT(buttonsOf(many), refusedSaying("1 to 128 are accepted"));
}

}  // namespace
}  // namespace tacto::test
