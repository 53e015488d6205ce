// VibrationReports.h - the reports for a massager: one that makes it vibrate and one that stops it, as bytes. Made from
// a template file or from a device's own Haptics page; used by the driver and by "show bytes", so that it shows what is
// sent.
//
// Byte 0 of every report is its number (0 where the device has none), as hidapi takes it.
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

/// The motor that a value in a report drives. Intensity is all of a device's vibration; weak and strong are a gamepad's
/// small, fast motor and its large, slow one. Each follows the burst's intensity over its own range.
enum class VibrationRole { Intensity, Weak, Strong };
inline constexpr Word<VibrationRole> kVibrationRoles[] = {
    {"intensity", VibrationRole::Intensity}, {"weak", VibrationRole::Weak}, {"strong", VibrationRole::Strong}};
[[nodiscard]] constexpr std::string_view nameOf(VibrationRole role) noexcept { return wordFor(kVibrationRoles, role); }

enum class ByteOrder { Little, Big };

/// A number inside a report. Little: bit 0 of the value at bit `bit`, counted from bit 0 of byte 0 upward, as in HID.
/// Big: whole bytes, the highest first.
struct ReportField {
    std::uint32_t bit = 8;
    std::uint8_t bits = 8;  ///< 1 to 32
    ByteOrder order = ByteOrder::Little;
    std::int64_t min = 0;    ///< at intensity 0
    std::int64_t max = 255;  ///< at intensity 1; above min. A negative min makes it two's complement
    VibrationRole role = VibrationRole::Intensity;
    friend bool operator==(const ReportField&, const ReportField&) = default;
};

/// A number by which the device ends a burst by itself: how many of the device's units the burst lasts.
struct DurationField {
    ReportField at;          ///< accepts min to max; its role is not used
    Seconds unit{0.001};     ///< one millisecond, or how long the device's own waveform plays once
    std::int64_t first = 0;  ///< units that the device plays at value 0: a count of repetitions begins after the first
    friend bool operator==(const DurationField&, const DurationField&) = default;
};

struct VibrationReports {
    std::vector<std::uint8_t> start;  ///< the whole report with all constant bytes; fields are written into it
    std::vector<ReportField> fields;  ///< at least one
    std::vector<std::uint8_t> stop;   ///< the whole report
    /// Makes a burst finite; nothing: the device vibrates until it is stopped.
    std::optional<DurationField> ends = std::nullopt;
    Seconds keepAlive{0};      ///< repeat the report this often while vibrating; 0: not needed
    Seconds shortestWrite{0};  ///< least time between two writes
    friend bool operator==(const VibrationReports&, const VibrationReports&) = default;
};

inline constexpr std::size_t kMaxReport = 4096;    ///< bytes
inline constexpr Seconds kMaxShortestWrite{0.04};  ///< a burst must still begin within the 50 ms of its approval
inline constexpr Seconds kMinKeepAlive{0.005};

/// Errors: InvalidArgument naming the field and what would fit: outside its report, over another field, over the report
/// number, a range that its bits cannot hold, reports of different length, times that cannot be kept. `ends` counts as
/// the last field.
[[nodiscard]] Result<void> validate(const VibrationReports& reports);

/// Writes the start report of a burst into `into`, which has the report's length. `reports` is valid. A burst that the
/// device ends by itself lasts at least `duration`. Never allocates on success. Errors: InvalidArgument unless
/// 0 ≤ intensity ≤ 1, `into` has the report's length and the device can play the burst's duration.
[[nodiscard]] Result<void> writeStart(const VibrationReports& reports, double intensity, Seconds duration,
                                      std::span<std::uint8_t> into);

/// The start report in new bytes: "show bytes".
[[nodiscard]] Result<std::vector<std::uint8_t>> startBytes(const VibrationReports& reports, double intensity,
                                                           Seconds duration = Seconds(0.1));

/// The value that `field` holds in a report that contains it; sign-extended where its range is signed.
[[nodiscard]] std::int64_t valueOf(const ReportField& field, std::span<const std::uint8_t> report) noexcept;
/// Writes `value`, which its bits can hold, into a report that contains it.
void setValue(const ReportField& field, std::int64_t value, std::span<std::uint8_t> report) noexcept;

/// Writes bytes as "02 03 00 7F 7F".
[[nodiscard]] std::string hexOf(std::span<const std::uint8_t> bytes);

}  // namespace tacto::hid
