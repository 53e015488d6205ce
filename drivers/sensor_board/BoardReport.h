// BoardReport.h - what a board and its line have been like, for sessions and windows; and over several openings of the
// same board.
//
// Thread-safety: none needed.
#pragma once

#include "core/devices/Device.h"
#include "drivers/sensor_board/SensorBoard.h"

namespace tacto::sensorboard {

/// `now` with the counts from before the board was opened again. The clock's figures come from `now`.
[[nodiscard]] SensorBoardReport together(const SensorBoardReport& before, const SensorBoardReport& now) noexcept;

/// Samples, blocks and bytes that are missing or were not used, of all streams and both ends.
[[nodiscard]] std::uint64_t lossesOf(const SensorBoardReport& report) noexcept;

[[nodiscard]] DeviceReport rowsOf(const SensorBoardReport& report) noexcept;

}  // namespace tacto::sensorboard
