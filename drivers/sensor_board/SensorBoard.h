// SensorBoard.h - a microcontroller with accelerometer, taxels and force sensor as a TactileSensor, over any Transport
// that speaks the sensor board protocol (resources/firmware/sensor_board/PROTOCOL.md).
//
// open() asks who the board is, refuses a wrong version of the protocol, wrong units or garbage in one sentence, reads
// configuration and calibration, measures the line's delay and starts the streams. On a steady clock a thread listens,
// so that the moment of arrival is known; read() takes what has arrived and never waits. Samples carry the board's own
// time stamps, mapped to the session's clock (ClockFit.h); what is lost is counted and stays a gap in them.
//
// Errors of read() are lasting: after one the board must be opened again. They are: the line failed (unplugged);
// kGarbageBytes of noise and no valid frame for kGarbageTime; a board that began again, whose clock jumped by more than
// kMaxJump ahead, or runs wrong by more than kMaxDrift.
//
// Thread-safety: as TactileSensor; report() from any thread.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/Clock.h"
#include "core/base/SpscRing.h"
#include "core/devices/TactileSensor.h"
#include "drivers/sensor_board/BoardLink.h"
#include "drivers/sensor_board/StreamTrack.h"

namespace tacto {

/// The state of a board and its line since open().
struct SensorBoardReport {
    std::array<sensorboard::StreamCounts, sensorboard::kMaxStreams> streams;  ///< by SensorBoard::streams()
    sensorboard::LineCounts line;
    sensorboard::BoardStatus board;  ///< the last STATUS
    std::uint64_t dropped = 0;       ///< bytes that the host did not read in time, about
    std::uint64_t foreign = 0;       ///< valid frames of another version, of no known stream, or not well formed
    bool driftKnown = false;
    double drift_ppm = 0;  ///< how much faster the board's clock runs than the session's
    double driftUncertainty_ppm = 0;
    double driftSpan_s = 0;  ///< board time that the drift stands on
    double delayMost_s = 0;  ///< shortest round trip seen at open: stamps are late by no more, about
    std::uint64_t clockSteps = 0;
};

struct SensorBoardSettings {
    std::string uri = "sensor:";     ///< the URI in its identity
    std::string serial = {};         ///< the board that it must be; empty: any
    double accelerationRate_hz = 0;  ///< 0: as the board is configured
    double slowRate_hz = 0;          ///< rate of taxels and force; 0: as the board is configured
    bool emulated = false;           ///< the operator's word, in the address: what it gives is simulated
};

class SensorBoard final : public TactileSensor {
public:
    static constexpr std::size_t kGarbageBytes = 4096;
    static constexpr Seconds kGarbageTime{0.5};
    static constexpr double kMaxJump_s = 0.1;
    static constexpr double kMaxDrift_ppm = 10'000;
    static constexpr std::uint64_t kMaxLate = 8;    ///< late blocks in a row: the board began again
    static constexpr std::size_t kMaxRead = 65536;  ///< bytes taken by one read()

    /// `clock` outlives the board. Waits for answers, about a second at most for a board that is well. Errors: Timeout
    /// (it does not answer); Device (garbage, wrong units, refused, unplugged); Unsupported (wrong version of the
    /// protocol, no stream); NotFound (another serial number).
    [[nodiscard]] static Result<std::unique_ptr<SensorBoard>> open(std::unique_ptr<Transport> transport,
                                                                   const SensorBoardSettings& settings,
                                                                   const Clock& clock);
    /// Tells the board to stop, without waiting.
    ~SensorBoard() override;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept override { return infos_; }
    [[nodiscard]] Result<void> read(std::span<SampleBlock> blocks) override;

    /// The calibrations read back from the board, one per stream. Constant while open.
    [[nodiscard]] const std::vector<sensorboard::StreamCalibration>& calibrations() const noexcept {
        return calibrations_;
    }
    [[nodiscard]] const sensorboard::StreamConfiguration& configuration(std::size_t stream) const noexcept {
        return tracks_[stream].configuration();
    }
    /// The report at the last read(). Any thread.
    [[nodiscard]] SensorBoardReport report() const noexcept { return report_.read(); }

private:
    SensorBoard(std::unique_ptr<Transport> transport, const Clock& clock);
    [[nodiscard]] Result<void> identify(const SensorBoardSettings& settings);
    [[nodiscard]] Result<void> configure(const SensorBoardSettings& settings, std::size_t streams);
    [[nodiscard]] Result<sensorboard::StreamConfiguration> setRate(sensorboard::StreamConfiguration now,
                                                                   double rate_hz);
    [[nodiscard]] Result<void> measureDelay();

    [[nodiscard]] Result<void> takeFrames(std::span<SampleBlock> blocks);
    [[nodiscard]] Result<void> takeBlock(const sensorboard::Frame& frame, std::span<SampleBlock> blocks);
    [[nodiscard]] Result<void> observe(std::uint64_t device_us);
    [[nodiscard]] Result<void> judgeNoise();
    void publish() noexcept;

    sensorboard::BoardLink link_;
    const Clock& clock_;
    DeviceIdentity identity_;
    std::vector<StreamInfo> infos_;
    std::vector<sensorboard::StreamTrack> tracks_;
    std::vector<sensorboard::StreamCalibration> calibrations_;
    std::array<int, sensorboard::kMaxStreams> trackOf_{};  // by the board's number; -1: not one of ours
    sensorboard::ClockFit fit_;
    Instant lastSound_{0};           // when a valid frame last came
    std::uint64_t soundFrames_ = 0;  // by then
    std::uint64_t bytesThen_ = 0;    // by then
    bool began_ = false;             // START was acknowledged
    std::optional<Error> failed_;
    SensorBoardReport current_;
    Latest<SensorBoardReport> report_;
};

}  // namespace tacto
