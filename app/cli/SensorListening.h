// SensorListening.h - a few seconds of a sensor board's streams: how fast they come, and what is lost.
//
// Thread-safety: one caller.
#pragma once

#include <vector>

#include "app/run/SignalStop.h"
#include "core/acquisition/StreamHealth.h"
#include "drivers/sensor_board/SensorBoard.h"

namespace tacto::cli {

struct Listened {
    double seconds = 0;                ///< how long it listened
    std::vector<HealthReport> health;  ///< by SensorBoard::streams()
    SensorBoardReport report;
};

/// Listens for `time`, or until Ctrl+C is pressed. Errors: as SensorBoard::read().
[[nodiscard]] Result<Listened> listenTo(SensorBoard& board, Seconds time, const SignalStop& interrupts);

}  // namespace tacto::cli
