// Haptics.h - a device that says by itself how it vibrates: the Haptics page (0x0E) of its report descriptor.
//
// Which waveform an ordinal stands for is in a feature report, read from the device. Ordinals 1 (none) and 2 (stop) are
// implicit, the device's own begin at 3 (HID Usage Tables 1.4, section 17; ../shared/wire/hid-vibration.md). A
// vibration that lasts until it is stopped is needed, so that one burst is as long as it was approved: waveform 0x1004
// (buzz) or 0x1005 (rumble), whichever ordinal comes first. Names differ between headers, so only the numbers count.
//
// Thread-safety: pure functions.
#pragma once

#include <functional>

#include "drivers/hid_massager/HidDescriptor.h"
#include "drivers/hid_massager/VibrationReports.h"

namespace tacto::hid {

/// Where the controls of one SimpleHapticController stand.
struct HapticControls {
    std::uint8_t report = 0;  ///< number of the output report
    std::size_t length = 0;   ///< of it, its number's byte included
    HidField trigger;         ///< ManualTrigger: takes an ordinal
    HidField intensity;
    std::optional<HidField> repeatCount;
    std::optional<HidField> retriggerPeriod;

    std::uint8_t listReport = 0;  ///< number of the feature report that holds the waveforms
    std::size_t listLength = 0;
    struct Entry {
        std::uint16_t ordinal = 0;  ///< 3 and above
        HidField waveform;
    };
    std::vector<Entry> waveforms;  ///< by ordinal
};

/// The first controller of the descriptor that can be used. Errors: Unsupported naming what is missing.
[[nodiscard]] Result<HapticControls> findHaptics(const HidDescriptor& descriptor);

/// Makes reports of the controls, given the feature report `list` as it was read. Errors: ParseError where the list is
/// shorter than it said; Unsupported where the device has no vibration that lasts, naming those that it has.
[[nodiscard]] Result<VibrationReports> hapticReports(const HapticControls& controls,
                                                     std::span<const std::uint8_t> list);

}  // namespace tacto::hid
