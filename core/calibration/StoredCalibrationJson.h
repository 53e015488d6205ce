// StoredCalibrationJson.h - one calibration as the store writes it.
//
// Thread-safety: pure functions.
#pragma once

#include "core/calibration/CalibrationStore.h"

namespace tacto {

/// Errors of check(): InvalidArgument naming the value and what is accepted.
[[nodiscard]] Result<void> check(const StoredCalibration& calibration);
[[nodiscard]] nlohmann::json toJson(const StoredCalibration& calibration);
/// Errors: ParseError naming the key; as check().
[[nodiscard]] Result<StoredCalibration> storedCalibrationFrom(const nlohmann::json& json);

}  // namespace tacto
