// VibrationReports.h - the reports for a massager, as bytes: one that starts vibration and one that stops it. They come
// from a template file or a device's own Haptics page. The driver and "show bytes" use the same reports, so that "show
// bytes" shows what is sent.
//
// Byte 0 of every report is its number (0 if the device has none), as hidapi expects.
//
// Thread-safety: pure functions on plain data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Units.h"
#include "core/base/Words.h"

namespace tacto::hid {

/// The motor that a value in a report drives. Intensity drives all vibration of the device; weak is a gamepad's small,
/// fast motor and strong its large, slow motor. Each value follows the burst's intensity over its own range.
enum class VibrationRole { Intensity, Weak, Strong };
inline constexpr Word<VibrationRole> kVibrationRoles[] = {
    {"intensity", VibrationRole::Intensity}, {"weak", VibrationRole::Weak}, {"strong", VibrationRole::Strong}};
[[nodiscard]] constexpr std::string_view nameOf(VibrationRole role) noexcept { return wordFor(kVibrationRoles, role); }

enum class ByteOrder { Little, Big };

/// The position of a number in a report. Little: bit 0 of the value is bit `bit` of the report, counted from bit 0 of
/// byte 0, as in HID. Big: whole bytes, the highest first.
struct ReportField {
    std::uint32_t bit = 8;
    std::uint8_t bits = 8;  ///< size in bits, 1 to 32
    ByteOrder order = ByteOrder::Little;
    std::int64_t min = 0;    ///< value at intensity 0
    std::int64_t max = 255;  ///< value at intensity 1; above min. If min is negative: two's complement
    VibrationRole role = VibrationRole::Intensity;
    friend bool operator==(const ReportField&, const ReportField&) = default;
};

/// A number that makes the device end a burst by itself: the burst's length in units of the device.
struct DurationField {
    ReportField at;          ///< accepts min to max; its role is ignored
    Seconds unit{0.001};     ///< one millisecond, or the length of the device's waveform
    std::int64_t first = 0;  ///< units that the device plays at value 0: a repetition count starts after the first play
    friend bool operator==(const DurationField&, const DurationField&) = default;
};

struct VibrationReports {
    std::vector<std::uint8_t> start;  ///< the whole report with all constant bytes, into which the fields are written
    std::vector<ReportField> fields;  ///< at least one
    std::vector<std::uint8_t> stop;   ///< the whole report
    /// Makes a burst finite; if empty, the device vibrates until it is stopped.
    std::optional<DurationField> ends = std::nullopt;
    Seconds keepAlive{0};      ///< while vibrating, repeat the report at this interval; 0: not needed
    Seconds shortestWrite{0};  ///< least time between two writes
    friend bool operator==(const VibrationReports&, const VibrationReports&) = default;
};

inline constexpr std::size_t kMaxReport = 4096;    ///< bytes
inline constexpr Seconds kMaxShortestWrite{0.04};  ///< a burst must still begin within 50 ms of its approval
inline constexpr Seconds kMinKeepAlive{0.005};

/// Errors: InvalidArgument naming the field and what would fit: a field outside its report, over another field or over
/// the report number, a range too large for its bits, reports of different length, impossible times. `ends` is checked
/// as the last field.
[[nodiscard]] Result<void> validate(const VibrationReports& reports);

/// Writes the start report of a burst into `into`. `reports` must be valid. If the device ends the burst by itself, it
/// lasts at least `duration`. Never allocates on success. Errors: InvalidArgument unless 0 ≤ intensity ≤ 1, `into` has
/// the report's length and the device can play the burst's duration.
[[nodiscard]] Result<void> writeStart(const VibrationReports& reports, double intensity, Seconds duration,
                                      std::span<std::uint8_t> into);

/// Returns the start report in new bytes, for "show bytes".
[[nodiscard]] Result<std::vector<std::uint8_t>> startBytes(const VibrationReports& reports, double intensity,
                                                           Seconds duration = Seconds(0.1));

/// Returns the value of `field` in a report that contains the field; sign-extended if the field's range is signed.
[[nodiscard]] std::int64_t valueOf(const ReportField& field, std::span<const std::uint8_t> report) noexcept;
/// Writes `value`, which must fit the field's bits, into a report that contains the field.
void setValue(const ReportField& field, std::int64_t value, std::span<std::uint8_t> report) noexcept;

/// Formats bytes as "02 03 00 7F 7F".
[[nodiscard]] std::string hexOf(std::span<const std::uint8_t> bytes);

}  // namespace tacto::hid
