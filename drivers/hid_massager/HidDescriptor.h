// HidDescriptor.h - reads a HID report descriptor: which controls a device has, and at which position in which report.
// (HID 1.11 section 6.2.2; hidapi 0.13 of Debian 12 has no function for this.)
//
// Descriptors come from devices and are untrusted: all tables are limited in size, and a descriptor that exceeds them
// or contradicts itself is refused.
//
// Positions count bits in a report as hidapi sends it: byte 0 is the report number (0 if the device has no numbers), so
// the first control is at bit 8.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto::hid {

/// Usage page in the high half, usage in the low: 0x000E0023 is Intensity of the Haptics page.
using Usage = std::uint32_t;
[[nodiscard]] constexpr Usage usageOf(std::uint16_t page, std::uint16_t id) noexcept { return Usage{page} << 16 | id; }
[[nodiscard]] constexpr std::uint16_t pageOf(Usage usage) noexcept { return static_cast<std::uint16_t>(usage >> 16); }
[[nodiscard]] constexpr std::uint16_t idOf(Usage usage) noexcept { return static_cast<std::uint16_t>(usage); }

enum class ReportKind { Input, Output, Feature };
[[nodiscard]] std::string_view nameOf(ReportKind kind) noexcept;  // "input", "output", "feature"

inline constexpr std::uint16_t kNoCollection = 0xFFFF;

struct HidCollection {
    Usage usage = 0;
    std::uint8_t type = 0;                 ///< 0 physical, 1 application, 2 logical ...
    std::uint16_t parent = kNoCollection;  ///< index of the enclosing collection, or kNoCollection
};

/// One control. Padding is not stored as a control.
struct HidField {
    ReportKind kind = ReportKind::Input;
    std::uint8_t report = 0;  ///< the report's number; 0 if reports have none
    Usage usage = 0;          ///< 0 in an array, which holds usages as values
    std::uint32_t bit = 0;    ///< first bit within the report, counted including the number byte
    std::uint8_t bits = 0;    ///< size in bits, 1 to 32
    std::int64_t min = 0;     ///< logical minimum
    std::int64_t max = 0;     ///< logical maximum; ≥ min
    bool array = false;
    std::uint16_t collection = kNoCollection;  ///< the innermost collection around the control
};

struct HidDescriptor {
    struct Report {
        ReportKind kind = ReportKind::Input;
        std::uint8_t number = 0;
        std::uint32_t bits = 0;  ///< bits of the report, without its number
    };
    std::vector<HidCollection> collections;
    std::vector<HidField> fields;
    std::vector<Report> reports;

    /// Returns the bytes of a report with the number byte that hidapi expects, or nothing if there is no such report.
    [[nodiscard]] std::optional<std::size_t> lengthOf(ReportKind kind, std::uint8_t number) const noexcept;
    /// True if `collection` has this usage or is inside a collection that has it.
    [[nodiscard]] bool isInside(std::uint16_t collection, Usage usage) const noexcept;
    /// Returns the innermost collection of this usage around `collection` (or itself); kNoCollection if there is none.
    [[nodiscard]] std::uint16_t enclosing(std::uint16_t collection, Usage usage) const noexcept;
};

inline constexpr std::size_t kMaxDescriptor = 4096;  ///< bytes; same as Linux's HID_MAX_DESCRIPTOR_SIZE
inline constexpr std::size_t kMaxFields = 4096;
inline constexpr std::size_t kMaxCollections = 512;
inline constexpr std::uint32_t kMaxReportBits = 8 * 4096;

/// Errors: ParseError naming the position and the fault.
[[nodiscard]] Result<HidDescriptor> parseHidDescriptor(std::span<const std::uint8_t> bytes);

}  // namespace tacto::hid
