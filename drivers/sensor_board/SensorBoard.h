// SensorBoard.h - a microcontroller with accelerometer, taxels and force sensor as a TactileSensor, over any Transport
// that uses the sensor board protocol (resources/firmware/sensor_board/PROTOCOL.md).
//
// open() identifies the board, refuses a wrong protocol version, wrong units or garbage in one sentence, reads
// configuration and calibration, measures the line's delay and starts the streams. A board that is asked to encode is
// refused if it cannot, or if its own profile is refused there. On a steady clock a thread listens,
// so that arrival times are known; read() returns what has arrived and never waits. Samples carry the board's own time
// stamps, mapped to the session's clock (ClockFit.h); lost samples are counted and stay gaps.
//
// Errors of read() are final; the board must then be opened again. They are: the line failed (unplugged); kGarbageBytes
// of noise without a valid frame for kGarbageTime; the board restarted; its clock jumped ahead by more than kMaxJump,
// or runs wrong by more than kMaxDrift.
//
// Thread-safety: as TactileSensor; report() from any thread.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/Clock.h"
#include "core/base/SpscRing.h"
#include "core/devices/EncodingSensor.h"
#include "core/devices/TactileSensor.h"
#include "drivers/sensor_board/BoardLink.h"
#include "drivers/sensor_board/ClockFit.h"
#include "drivers/sensor_board/StreamTrack.h"

namespace tacto {

/// The state of a board and its line, counted since open().
struct SensorBoardReport {
    std::array<sensorboard::StreamCounts, sensorboard::kMaxStreams> streams;  ///< indexed as SensorBoard::streams()
    sensorboard::LineCounts line;
    sensorboard::BoardStatus board;  ///< the last STATUS
    std::uint64_t dropped = 0;       ///< approximate bytes that the host did not read in time
    std::uint64_t foreign = 0;       ///< valid frames of another version or an unknown stream, or with a wrong format
    bool driftKnown = false;
    double drift_ppm = 0;  ///< how much faster the board's clock runs than the session's
    double driftUncertainty_ppm = 0;
    double driftSpan_s = 0;  ///< length of board time behind the drift
    double delayMost_s = 0;  ///< shortest round trip at open: about the most that stamps are late
    std::uint64_t clockSteps = 0;
    std::uint64_t encodedLost = 0;  ///< readings, trains and silences of the board's encoder that did not come
    std::uint64_t encodedLate = 0;  ///< that came again, after later ones, or with a time that cannot be
};

/// Whether the board encodes, and whether its trains are played while the sensor drives.
enum class Encodes { No, Shown, Drives };

struct SensorBoardSettings {
    std::string uri = "sensor:";     ///< the URI for the board's identity
    std::string serial = {};         ///< serial number that the board must have; empty: any
    double accelerationRate_hz = 0;  ///< 0: keep the board's own rate
    double slowRate_hz = 0;          ///< rate of taxels and force; 0: keep the board's own
    bool emulated = false;           ///< the operator's statement in the address: data are simulated
    Encodes encodes = Encodes::No;
};

class SensorBoard final : public TactileSensor, public EncodingSensor {
public:
    static constexpr std::size_t kGarbageBytes = 4096;
    static constexpr Seconds kGarbageTime{0.5};
    static constexpr double kMaxJump_s = 0.1;
    static constexpr double kMaxDrift_ppm = 10'000;
    static constexpr std::uint64_t kMaxLate = 8;    ///< this many late blocks in a row mean that the board restarted
    static constexpr std::size_t kMaxRead = 65536;  ///< bytes taken by one read()
    static constexpr double kEncodedWithin_s = 1;   ///< times of its encoder further from now cannot be

    /// Waits for answers, at most about a second if the board is in order. `clock` outlives the board. Errors: Timeout
    /// (no answer); Device (garbage, wrong units, refused, unplugged); Unsupported (wrong protocol version, no stream,
    /// no encoder that it is asked for, or one of another layout); NotFound (another serial number).
    [[nodiscard]] static Result<std::unique_ptr<SensorBoard>> open(std::unique_ptr<Transport> transport,
                                                                   const SensorBoardSettings& settings,
                                                                   const Clock& clock);
    /// Tells the board to stop, without waiting for an answer.
    ~SensorBoard() override;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] std::span<const StreamInfo> streams() const noexcept override { return infos_; }
    [[nodiscard]] Result<void> read(std::span<SampleBlock> blocks) override;
    [[nodiscard]] std::optional<BoardEncoder> encoder() const noexcept override { return encoder_; }
    [[nodiscard]] const Encoded& encoded() const noexcept override { return encoded_; }
    void keepBoardTime() noexcept override { boardTime_ = true; }
    [[nodiscard]] std::uint64_t lostOnTheWay() const noexcept override;

    /// The calibrations that were read from the board, one per stream. Constant while open.
    [[nodiscard]] const std::vector<sensorboard::StreamCalibration>& calibrations() const noexcept {
        return calibrations_;
    }
    [[nodiscard]] const sensorboard::StreamConfiguration& configuration(std::size_t stream) const noexcept {
        return tracks_[stream].configuration();
    }
    /// Returns the report as of the last read(). Any thread.
    [[nodiscard]] SensorBoardReport report() const noexcept { return report_.read(); }

private:
    SensorBoard(std::unique_ptr<Transport> transport, const Clock& clock);
    [[nodiscard]] Result<void> identify(const SensorBoardSettings& settings);
    [[nodiscard]] Result<void> configure(const SensorBoardSettings& settings, std::size_t streams);
    [[nodiscard]] Result<sensorboard::StreamConfiguration> setRate(sensorboard::StreamConfiguration now,
                                                                   double rate_hz);
    [[nodiscard]] Result<void> measureDelay();
    [[nodiscard]] Result<void> askToEncode(Encodes wanted);

    [[nodiscard]] Result<void> takeFrames(std::span<SampleBlock> blocks);
    [[nodiscard]] Result<void> takeBlock(const sensorboard::Frame& frame, std::span<SampleBlock> blocks);
    /// False for a frame that is none of the encoder's.
    bool takeEncoded(const sensorboard::Frame& frame);
    /// Returns the session's time of a message that is the next of its kind; nothing for one that is not used.
    [[nodiscard]] std::optional<double> place(sensorboard::SequenceTrack& track, std::uint32_t sequence,
                                              std::uint64_t time_us) noexcept;
    [[nodiscard]] double timeOf(double device_us) const noexcept {
        return boardTime_ ? device_us * 1e-6 : fit_.toSession(device_us);
    }
    [[nodiscard]] Result<void> observe(std::uint64_t device_us);
    [[nodiscard]] Result<void> judgeNoise();
    void publish() noexcept;

    sensorboard::BoardLink link_;
    const Clock& clock_;
    DeviceIdentity identity_;
    std::vector<StreamInfo> infos_;
    std::vector<sensorboard::StreamTrack> tracks_;
    std::vector<sensorboard::StreamCalibration> calibrations_;
    std::array<int, sensorboard::kMaxStreams> trackOf_{};  // index: the board's stream number; -1: unused
    sensorboard::ClockFit fit_;
    bool boardTime_ = false;
    Instant lastSound_{0};           // when a valid frame last came
    std::uint64_t soundFrames_ = 0;  // value at lastSound_
    std::uint64_t bytesThen_ = 0;    // value at lastSound_
    bool began_ = false;             // true once START was acknowledged
    int highestVersion_ = 0;         // of the protocol, that the board speaks
    std::optional<BoardEncoder> encoder_;
    Encoded encoded_;
    sensorboard::SequenceTrack readings_, trains_, silences_;
    double lastOnset_s_ = -std::numeric_limits<double>::infinity();
    std::optional<Error> failed_;
    SensorBoardReport current_;
    Latest<SensorBoardReport> report_;
};

}  // namespace tacto
