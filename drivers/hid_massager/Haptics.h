// Haptics.h - devices that describe their own vibration on the Haptics page (0x0E) of their report descriptor.
//
// A feature report, read from the device, maps each ordinal to a waveform. Ordinals 1 (none) and 2 (stop) are fixed;
// the device's own ordinals begin at 3 (HID Usage Tables 1.4, section 17; hid-vibration.md). Names differ between
// headers, so the code uses only the numbers.
//
// A burst that the device ends by itself is preferred, because it ends even if this program dies (H2):
//   1. a lasting waveform, 0x1004 (buzz) or 0x1005 (rumble), with a cutoff time (0E:28, ms) in the output report;
//   2. a waveform of known duration (the duration list, ms) with a repeat count (0E:24: plays after the first) and,
//      if the report has one, the retrigger period set to that duration;
//   3. a waveform that lasts until it is stopped.
// In each case the driver also sends the stop at the burst's end.
//
// Thread-safety: pure functions.
#pragma once

#include <functional>

#include "drivers/hid_massager/HidDescriptor.h"
#include "drivers/hid_massager/VibrationReports.h"

namespace tacto::hid {

/// The positions of one SimpleHapticController's controls.
struct HapticControls {
    std::uint8_t report = 0;  ///< number of the output report
    std::size_t length = 0;   ///< bytes in that report, including the report number
    HidField trigger;         ///< ManualTrigger, which is set to an ordinal
    HidField intensity;
    std::optional<HidField> repeatCount;
    std::optional<HidField> retriggerPeriod;
    std::optional<HidField> cutoffTime;

    std::uint8_t listReport = 0;  ///< number of the feature report that lists the waveforms
    std::size_t listLength = 0;
    struct Entry {
        std::uint16_t ordinal = 0;  ///< number of the waveform in the list, 3 or above
        HidField waveform;
        std::optional<HidField> duration;  ///< ms; empty if the same report does not state it
    };
    std::vector<Entry> waveforms;  ///< in order of ordinal
};

/// Returns the first usable controller of the descriptor. Errors: Unsupported naming what is missing.
[[nodiscard]] Result<HapticControls> findHaptics(const HidDescriptor& descriptor);

/// Makes reports from the controls and the feature report `list`. Errors: ParseError if the list is shorter than the
/// descriptor states; Unsupported if the device has none of the vibrations above, naming those it has.
[[nodiscard]] Result<VibrationReports> hapticReports(const HapticControls& controls,
                                                     std::span<const std::uint8_t> list);

}  // namespace tacto::hid
