// ProfilometerFile.h - Ra and Rz of a surface, out of the text that a profilometer exports.
//
// There is no common format, so the file is searched for the two names, whatever else it holds:
//   Ra;1,62;µm         Ra [um],1.62         Ra = 1.62 µm         a name and its value
//   Trace,Ra (µm),Rz (µm)                                        a header, then rows; the units may have a row
//   1,1.60,11.2                                                  of their own; several rows are averaged
// Separators are ; or tab or comma. A decimal comma is taken where the comma does not separate. The unit is nm, µm (um,
// micron) or mm and must be stated: a factor of 1000 is too much to guess. In a table, rows that begin with a word
// for spread or extremes (SD, min, max ...) are left out, and a row that begins with "mean" or "average" speaks alone.
//
// Thread-safety: pure functions but for reading a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

inline constexpr std::size_t kLargestProfilometerFile = 4U << 20U;  ///< bytes; results, not raw profiles

struct ProfilometerReading {
    double ra_um = std::numeric_limits<double>::quiet_NaN();  ///< > 0
    double rz_um = std::numeric_limits<double>::quiet_NaN();  ///< ≥ Ra; NaN: not stated
    std::size_t raValues = 0;                                 ///< how many were averaged
    std::size_t rzValues = 0;
};

/// `source` begins the message of an error. Errors: ParseError naming the line: no Ra, a name without value or unit, a
/// value that is not above 0, a comma that could be a decimal or a separator, Rz below Ra, text that is UTF-16.
[[nodiscard]] Result<ProfilometerReading> parseProfilometer(std::string_view text, std::string_view source);
/// Errors: NotFound, Io; ParseError for a file that is too large; as parseProfilometer().
[[nodiscard]] Result<ProfilometerReading> readProfilometer(const std::filesystem::path& path);

}  // namespace tacto
