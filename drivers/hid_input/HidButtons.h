// HidButtons.h - the buttons of a game pad, a joystick or a foot switch, as its report descriptor says, and what its
// input reports say of them.
//
// A button is an input of one bit on the Button page (0x09) in an application collection of usage Joystick, Game Pad or
// Multi-axis Controller (01:04, 01:05, 01:08) or Programmable Buttons (0C:03), which foot switches have. Mice and
// keyboards have none of these: the window gets their keys from the system. Two such collections in one device are two
// pads, and their buttons are told apart. (HID Usage Tables 1.4, sections 4, 12 and 15; hid-buttons.md.)
//
// Thread-safety: one caller.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "drivers/hid_massager/HidDescriptor.h"

namespace tacto::hid {

/// A top-level collection that may hold buttons.
[[nodiscard]] bool isButtonUsage(Usage usage) noexcept;
/// Whether the descriptor has such a collection.
[[nodiscard]] bool hasButtonUsage(const HidDescriptor& descriptor) noexcept;

class HidButtons {
public:
    static constexpr std::size_t kMaxButtons = 128;

    /// Errors: Unsupported, naming what the device has and what is accepted.
    [[nodiscard]] static Result<HidButtons> of(const HidDescriptor& descriptor);

    /// "1" for button 1; "2-1" for button 1 of a second pad.
    [[nodiscard]] const std::vector<std::string>& labels() const noexcept { return labels_; }
    /// Bytes that the longest input report has, its number included.
    [[nodiscard]] std::size_t longest() const noexcept { return longest_; }

    struct Change {
        std::size_t button = 0;  ///< index in labels()
        bool down = false;
        bool operator==(const Change&) const = default;
    };
    /// The changes in the report, in the order of the buttons. `report` is as read: with its number in front where
    /// reports are numbered. A report that is shorter than its descriptor says, or of no known number, changes nothing.
    [[nodiscard]] std::vector<Change> read(std::span<const std::uint8_t> report);
    /// All buttons count as up: the device was plugged in again.
    void forget();

private:
    struct Bit {
        std::uint8_t report = 0;
        std::uint32_t bit = 0;  ///< as HidField::bit
        std::size_t button = 0;
    };
    struct Length {
        std::uint8_t report = 0;
        std::size_t bytes = 0;  ///< the report's length with the byte of its number
    };
    std::vector<std::string> labels_;
    std::vector<Bit> bits_;
    std::vector<Length> lengths_;
    std::vector<bool> down_;
    bool numbered_ = false;
    std::size_t longest_ = 0;
};

}  // namespace tacto::hid
