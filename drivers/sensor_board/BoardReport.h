// BoardReport.h - combines the reports on a board and its line, also over several openings of the same board.
//
// Thread-safety: pure functions.
#pragma once

#include "core/devices/Device.h"
#include "drivers/sensor_board/SensorBoard.h"

namespace tacto::sensorboard {

/// Returns `now` plus the counts from before the board was opened again. The clock's figures are those of `now`.
[[nodiscard]] SensorBoardReport together(const SensorBoardReport& before, const SensorBoardReport& now) noexcept;

/// Returns how many samples, blocks and bytes are missing or unused, over all streams and both ends.
[[nodiscard]] std::uint64_t lossesOf(const SensorBoardReport& report) noexcept;

[[nodiscard]] DeviceReport rowsOf(const SensorBoardReport& report) noexcept;

}  // namespace tacto::sensorboard
