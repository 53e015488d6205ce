// HidButtons.h - the buttons of a game pad, joystick or foot switch: finds them in the report descriptor and reads them
// from input reports.
//
// A button is a one-bit input on the Button page (0x09) in an application collection of usage Joystick, Game Pad or
// Multi-axis Controller (01:04, 01:05, 01:08) or Programmable Buttons (0C:03), as foot switches have. Mice and
// keyboards have none of these; the window gets their keys from the system. Two such collections in one device are two
// pads with separate buttons. (HID Usage Tables 1.4, sections 4, 12 and 15; hid-buttons.md.)
//
// Thread-safety: one caller.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "drivers/hid_massager/HidDescriptor.h"

namespace tacto::hid {

/// True for the usage of a top-level collection that may hold buttons.
[[nodiscard]] bool isButtonUsage(Usage usage) noexcept;
/// True if the descriptor has such a collection.
[[nodiscard]] bool hasButtonUsage(const HidDescriptor& descriptor) noexcept;

class HidButtons {
public:
    static constexpr std::size_t kMaxButtons = 128;

    /// Errors: Unsupported, naming the device's inputs and the accepted ones.
    [[nodiscard]] static Result<HidButtons> of(const HidDescriptor& descriptor);

    /// Names of the buttons: "1" for button 1; "2-1" for button 1 of a second pad.
    [[nodiscard]] const std::vector<std::string>& labels() const noexcept { return labels_; }
    /// Returns the bytes of the longest input report, number included.
    [[nodiscard]] std::size_t longest() const noexcept { return longest_; }

    struct Change {
        std::size_t button = 0;  ///< index into labels()
        bool down = false;
        bool operator==(const Change&) const = default;
    };
    /// Returns the changes in the report, in button order. `report` is as read, with its number first if reports are
    /// numbered. A report that is too short or has an unknown number changes nothing.
    [[nodiscard]] std::vector<Change> read(std::span<const std::uint8_t> report);
    /// Marks all buttons as up, after the device was plugged in again.
    void forget();

private:
    struct Bit {
        std::uint8_t report = 0;
        std::uint32_t bit = 0;  ///< position, as in HidField::bit
        std::size_t button = 0;
    };
    struct Length {
        std::uint8_t report = 0;
        std::size_t bytes = 0;  ///< bytes of the report, number included
    };
    std::vector<std::string> labels_;
    std::vector<Bit> bits_;
    std::vector<Length> lengths_;
    std::vector<bool> down_;
    bool numbered_ = false;
    std::size_t longest_ = 0;
};

}  // namespace tacto::hid
