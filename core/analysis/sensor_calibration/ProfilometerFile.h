// ProfilometerFile.h - finds Ra and Rz of a surface in a profilometer's text export.
//
// There is no common format, so the file is searched for the two names; other content is ignored:
//   Ra;1,62;µm         Ra [um],1.62         Ra = 1.62 µm         a name and its value
//   Trace,Ra (µm),Rz (µm)                                        a header, then rows; the units may have a row
//   1,1.60,11.2                                                  of their own; several rows are averaged
// Fields are separated by ; or tab or comma. A decimal comma is accepted if commas are not separators. The unit must be
// stated as nm, µm (um, micron) or mm, because a wrong guess means a factor of 1000. In a table, rows that begin with a
// word for spread or extremes (SD, min, max ...) are ignored; a row "mean" or "average" replaces all others.
//
// Thread-safety: pure functions, apart from reading a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

inline constexpr std::size_t kLargestProfilometerFile = 4U << 20U;  ///< bytes; for results, not raw profiles

struct ProfilometerReading {
    double ra_um = std::numeric_limits<double>::quiet_NaN();  ///< > 0
    double rz_um = std::numeric_limits<double>::quiet_NaN();  ///< ≥ Ra; NaN: not stated
    std::size_t raValues = 0;                                 ///< number of averaged values
    std::size_t rzValues = 0;
};

/// `source` begins every error message. Errors: ParseError naming the line: no Ra, a name without value or unit, a
/// value that is not positive, a comma with two possible meanings, Rz below Ra, or UTF-16 text.
[[nodiscard]] Result<ProfilometerReading> parseProfilometer(std::string_view text, std::string_view source);
/// Errors: NotFound, Io; ParseError for a file that is too large; those of parseProfilometer().
[[nodiscard]] Result<ProfilometerReading> readProfilometer(const std::filesystem::path& path);

}  // namespace tacto
