// TrancePort.h - the ASCII Trance Vibrator (0B49:064F). It is no HID device: one control request sets its vibration,
// bmRequestType 0x43, bRequest 1, wValue = speed 0 to 255 (resources/design/wire/hid-vibration.md).
//
// To HidMassager it looks like a device with one report of two bytes: 0 and the speed.
//
// Thread-safety: as HidPort.
#pragma once

#include <memory>

#include "drivers/hid_massager/HidPort.h"
#include "drivers/hid_massager/VibrationReports.h"
#include "drivers/usb/UsbContext.h"
#include "drivers/usb/UsbControl.h"

namespace tacto::hid {

inline constexpr std::uint16_t kTranceVendor = 0x0B49;
inline constexpr std::uint16_t kTranceProduct = 0x064F;

[[nodiscard]] VibrationReports tranceReports();

class TrancePort final : public HidPort {
public:
    /// Limit for one request: a full-speed bus needs a few milliseconds; a device that takes longer has hung.
    static constexpr Seconds kTimeout{0.2};

    /// Errors: as UsbControl::open().
    [[nodiscard]] static Result<std::unique_ptr<HidPort>> open(std::shared_ptr<UsbContext> context,
                                                               const UsbDeviceInfo& info);

    [[nodiscard]] Result<std::size_t> write(std::span<const std::uint8_t> report) override;
    [[nodiscard]] Result<std::size_t> feature(std::span<std::uint8_t> report) override;
    [[nodiscard]] Result<std::unique_ptr<Watchdog>> watch(std::span<const std::uint8_t> stop) override;
    [[nodiscard]] bool stopNow() noexcept override;

private:
    explicit TrancePort(std::unique_ptr<UsbControl> control) : control_(std::move(control)) {}
    const std::unique_ptr<UsbControl> control_;
};

}  // namespace tacto::hid
