// PluggedBoard.h - the sensor board that the driver hands out; it can be opened again, by its serial number, after it
// was unplugged.
//
// The board that comes back must be the same one with the same settings and the same profile in its encoder, so that
// the streams of a session that records them do not change; only rewrite() gives it another profile. The counts in its
// reports continue.
//
// Thread-safety: as TactileSensor; deviceReport() from any thread.
#pragma once

#include <functional>

#include "core/base/SpscRing.h"
#include "core/devices/Device.h"
#include "core/devices/EncodingSensor.h"
#include "core/devices/TactileSensor.h"
#include "drivers/sensor_board/SensorBoard.h"

namespace tacto::sensorboard {

class PluggedBoard final : public TactileSensor, public EncodingSensor, public ReportingDevice, public Reconnecting {
public:
    /// Opens the board with that serial number in whatever socket it is now.
    using Open = std::function<Result<std::unique_ptr<SensorBoard>>(const std::string& serial)>;

    PluggedBoard(std::unique_ptr<SensorBoard> board, Open open);

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept override { return streams_; }
    [[nodiscard]] Result<void> read(std::span<SampleBlock> blocks) override;
    [[nodiscard]] std::optional<BoardEncoder> encoder() const noexcept override { return encoder_; }
    [[nodiscard]] const Encoded& encoded() const noexcept override { return encoded_; }
    void keepBoardTime() noexcept override {
        if (board_) board_->keepBoardTime();
    }
    [[nodiscard]] std::uint64_t lostOnTheWay() const noexcept override { return board_ ? board_->lostOnTheWay() : 0; }
    [[nodiscard]] Result<void> reconnect() override;
    /// Opens the board again after `write` has given it another profile, while it is closed. Errors: as reconnect().
    [[nodiscard]] Result<void> rewrite(const std::function<void()>& write);
    [[nodiscard]] DeviceReport deviceReport() const noexcept override;

private:
    void close();
    [[nodiscard]] Result<std::unique_ptr<SensorBoard>> openAgain() const;

    const DeviceIdentity identity_;
    const std::vector<StreamInfo> streams_;
    std::optional<BoardEncoder> encoder_;
    Encoded encoded_;
    const Open open_;
    std::unique_ptr<SensorBoard> board_;  // null after a failed reconnect()
    SensorBoardReport before_;            // sum of the reports of earlier openings
    Latest<SensorBoardReport> report_;
};

}  // namespace tacto::sensorboard
