// XdfNames.h - the numbers and words of XDF 1.0 files (github.com/sccn/xdf/wiki/Specifications), and those of our own.
//
// Thread-safety: constants.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/Words.h"

namespace tacto::xdf {

inline constexpr std::string_view kMagic = "XDF:";

/// The tag of a chunk. A chunk is: how many bytes its length takes (1, 4 or 8), the length, the tag (2 bytes) and the
/// content; the length counts the tag too. All numbers are little-endian.
enum class Tag : std::uint16_t {
    FileHeader = 1,
    StreamHeader = 2,
    Samples = 3,
    ClockOffset = 4,
    Boundary = 5,
    StreamFooter = 6
};

/// The content of a Boundary chunk.
inline constexpr std::string_view kBoundary("\x43\xA5\x46\xDC\xCB\xF5\x41\x0F\xB3\x0E\xD5\x46\x73\x83\xCB\xE4", 16);

enum class Format { Int8, Int16, Int32, Int64, Float32, Double64, String };
inline constexpr Word<Format> kFormats[] = {
    {"int8", Format::Int8},       {"int16", Format::Int16},       {"int32", Format::Int32},  {"int64", Format::Int64},
    {"float32", Format::Float32}, {"double64", Format::Double64}, {"string", Format::String}};
/// Bytes of one value; 0 for String, whose values state their length.
[[nodiscard]] constexpr std::size_t bytesOf(Format format) noexcept {
    constexpr std::size_t kBytes[] = {1, 2, 4, 8, 4, 8, 0};
    return kBytes[static_cast<std::size_t>(format)];
}

/// A sample begins with one of these: its stamp follows, or it comes one nominal step after the sample before.
inline constexpr char kStamped = 8;
inline constexpr char kDeduced = 0;

/// How XDF's dictionaries call what a unit measures, and the numbers of trains.
[[nodiscard]] constexpr const char* typeOf(std::string_view unit) noexcept {
    return unit == "m/s2" ? "Acceleration" : unit == "N" ? "Force" : unit == "Pa" ? "Pressure" : "Misc";
}
inline constexpr const char* kOfTrains = "Stimulation";
inline constexpr const char* kMarkers = "Markers";  ///< the type of streams of texts that mark moments

// Elements of the headers, all in <info>.
inline constexpr const char* kInfo = "info";
inline constexpr const char* kProgram = "program";      ///< of our files, in the file header: kProgramName and version
inline constexpr const char* kSimulated = "simulated";  ///< of our files, in the file header: 1 or 0
inline constexpr const char* kSerial = "serial";        ///< of the device, in <desc>
inline constexpr std::string_view kProgramName = "Tactoscope";

}  // namespace tacto::xdf
