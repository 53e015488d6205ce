// PluggedBoard.h - the sensor board that a driver hands out: one that is opened again, by its serial number, after it
// was unplugged.
//
// The board that comes back must be the same one, set as before: its streams do not change under a session that records
// them. Its reports keep counting.
//
// Thread-safety: as TactileSensor; deviceReport() from any thread.
#pragma once

#include <functional>

#include "core/base/SpscRing.h"
#include "core/devices/Device.h"
#include "core/devices/TactileSensor.h"
#include "drivers/sensor_board/SensorBoard.h"

namespace tacto::sensorboard {

class PluggedBoard final : public TactileSensor, public ReportingDevice, public Reconnecting {
public:
    /// Opens the board of that serial number, wherever it is now.
    using Open = std::function<Result<std::unique_ptr<SensorBoard>>(const std::string& serial)>;

    PluggedBoard(std::unique_ptr<SensorBoard> board, Open open);

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept override { return streams_; }
    [[nodiscard]] Result<void> read(std::span<SampleBlock> blocks) override;
    [[nodiscard]] Result<void> reconnect() override;
    [[nodiscard]] DeviceReport deviceReport() const noexcept override;

private:
    const DeviceIdentity identity_;
    const std::vector<StreamInfo> streams_;
    const Open open_;
    std::unique_ptr<SensorBoard> board_;  // null after a reconnect() that failed
    SensorBoardReport before_;            // what earlier openings reported
    Latest<SensorBoardReport> report_;
};

}  // namespace tacto::sensorboard
