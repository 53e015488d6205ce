// Haptics.h - a device that says by itself how it vibrates: the Haptics page (0x0E) of its report descriptor.
//
// A feature report, read from the device, tells which waveform an ordinal stands for. Ordinals 1 (none) and 2 (stop)
// are implicit, the device's own begin at 3 (HID Usage Tables 1.4, section 17; hid-vibration.md). Names differ between
// headers, so only the numbers count.
//
// A burst that the device ends by itself is preferred, because it ends even if this program dies (H2):
//   1. a waveform that lasts, 0x1004 (buzz) or 0x1005 (rumble), with a cutoff time (0E:28, ms) in the output report;
//   2. a waveform of known duration (the duration list, ms) with a repeat count (0E:24: plays after the first) and,
//      where the report has one, the retrigger period set to that duration;
//   3. a waveform that lasts until it is stopped.
// The driver sends the stop at the burst's end in each case.
//
// Thread-safety: pure functions.
#pragma once

#include <functional>

#include "drivers/hid_massager/HidDescriptor.h"
#include "drivers/hid_massager/VibrationReports.h"

namespace tacto::hid {

/// The places of one SimpleHapticController's controls.
struct HapticControls {
    std::uint8_t report = 0;  ///< number of the output report
    std::size_t length = 0;   ///< its length, the byte of its number included
    HidField trigger;         ///< ManualTrigger, which takes an ordinal
    HidField intensity;
    std::optional<HidField> repeatCount;
    std::optional<HidField> retriggerPeriod;
    std::optional<HidField> cutoffTime;

    std::uint8_t listReport = 0;  ///< number of the feature report that holds the waveforms
    std::size_t listLength = 0;
    struct Entry {
        std::uint16_t ordinal = 0;  ///< 3 and above
        HidField waveform;
        std::optional<HidField> duration;  ///< ms; nothing where the same report does not tell it
    };
    std::vector<Entry> waveforms;  ///< by ordinal
};

/// The first controller of the descriptor that can be used. Errors: Unsupported naming what is missing.
[[nodiscard]] Result<HapticControls> findHaptics(const HidDescriptor& descriptor);

/// Makes reports of the controls, given the feature report `list` as it was read. Errors: ParseError where the list is
/// shorter than it said; Unsupported where the device has no vibration of the kinds above, naming those that it has.
[[nodiscard]] Result<VibrationReports> hapticReports(const HapticControls& controls,
                                                     std::span<const std::uint8_t> list);

}  // namespace tacto::hid
