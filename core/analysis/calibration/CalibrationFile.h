// CalibrationFile.h - the table that `analyze calibration` reads.
//
// Thread-safety: pure functions on files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/analysis/calibration/Calibration.h"
#include "core/base/Result.h"

namespace tacto {

/// Readings from CSV columns `commanded`, `measured` and, where there are such, `direction` (up, down or empty) and `u`
/// (standard uncertainty), in any order among others; names are trimmed. An empty or nan measured value was not
/// measured; an empty or nan `u` is not stated.
/// Errors: NotFound, Io; ParseError naming file, line and what was expected.
[[nodiscard]] Result<std::vector<CalibrationReading>> readCalibrationReadings(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Result<std::vector<CalibrationReading>> parseCalibrationReadings(std::string_view text,
                                                                               std::string_view name);

}  // namespace tacto
