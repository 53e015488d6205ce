// SimulatedBoard.h - sim:board: a simulated finger on a sensor board that encodes by itself. The board is the C99 code
// of resources/firmware (FirmwareBoard.h), and the bench speaks to it as to a real one, byte for byte.
//
//   sim:board?encodes=drives    no: samples alone; shown: its R, P and trains beside the bench's; drives: the bench
//                               plays its trains (as sensor:)
//   sim:board?drift=30          its clock runs 30 ppm fast
//   sim:board?profile=FILE.bin  the profile in it (firmware-profile); without: the bench's own
//
// Every other key is the finger's.
//
// Thread-safety: as TactileSensor; deviceReport() from any thread.
#pragma once

#include <memory>

#include "core/base/Clock.h"
#include "core/devices/DeviceUri.h"
#include "core/devices/EncoderLoader.h"
#include "drivers/sensor_board/FirmwareBoard.h"
#include "drivers/sensor_board/PluggedBoard.h"

namespace tacto::sensorboard {

class SimulatedBoard final : public TactileSensor,
                             public EncodingSensor,
                             public EncoderLoader,
                             public ReportingDevice,
                             public Reconnecting {
public:
    /// The keys of `uri` that are the board's.
    [[nodiscard]] static bool isOwn(std::string_view key) noexcept;
    /// Puts the sensors of `finger`, which is simulated, on a board. `uri` has the board's keys alone; `clock` outlives
    /// it. Errors: InvalidArgument naming a key; Unsupported for streams that no board has; Io; as SensorBoard::open().
    [[nodiscard]] static Result<std::unique_ptr<TactileSensor>> open(std::unique_ptr<TactileSensor> finger,
                                                                     const DeviceUri& uri, const Clock& clock);

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept override { return plugged_->streams(); }
    [[nodiscard]] Result<void> read(std::span<SampleBlock> blocks) override { return plugged_->read(blocks); }
    [[nodiscard]] std::optional<BoardEncoder> encoder() const noexcept override { return plugged_->encoder(); }
    [[nodiscard]] const Encoded& encoded() const noexcept override { return plugged_->encoded(); }
    void keepBoardTime() noexcept override { plugged_->keepBoardTime(); }
    [[nodiscard]] std::uint64_t lostOnTheWay() const noexcept override { return plugged_->lostOnTheWay(); }
    [[nodiscard]] bool wantsProfile() const noexcept override { return encodes_ != Encodes::No && !hasOwnProfile_; }
    [[nodiscard]] Result<void> load(std::string_view profile, bool rested) override;
    [[nodiscard]] DeviceReport deviceReport() const noexcept override { return plugged_->deviceReport(); }
    [[nodiscard]] Result<void> reconnect() override { return plugged_->reconnect(); }

private:
    SimulatedBoard(DeviceIdentity identity, std::shared_ptr<FirmwareBoard> board, Encodes encodes, const Clock& clock);
    [[nodiscard]] Result<void> begin(std::string_view profile, bool rested);
    void restart(const te_profile* profile, bool rested);

    const DeviceIdentity identity_;
    const std::shared_ptr<FirmwareBoard> board_;
    const Encodes encodes_;
    const std::shared_ptr<SensorBoardSettings> settings_ = std::make_shared<SensorBoardSettings>();
    const Clock& clock_;
    bool hasOwnProfile_ = false;
    std::string profile_;  // in its encoder; empty: none
    std::unique_ptr<PluggedBoard> plugged_;
};

}  // namespace tacto::sensorboard
