// Messages.h - turns a board's payloads into values (PROTOCOL.md, sections 3 to 5 and 7). Pure: no I/O, no state.
//
// Nothing here trusts the board: a wrong payload length, a field out of range, a scale that is not a number or a unit
// that does not fit the kind of stream is refused in one sentence.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "drivers/sensor_board/Wire.h"

namespace tacto::sensorboard {

inline constexpr std::size_t kMaxStreams = 8;
inline constexpr std::size_t kMaxColumns = 16;

/// How an emulated board's serial number begins (PROTOCOL.md, section 4). Only the address marks a board as simulated;
/// if the address says "emulated" and another serial number answers, the board is not opened.
inline constexpr std::string_view kEmulatedSerial = "EMU-";

struct BoardIdentity {
    int lowestVersion = 0;  ///< the oldest protocol version that the board speaks
    int highestVersion = 0;
    std::size_t streams = 0;
    std::string name;
    std::string serial;
    std::string firmware;
};

enum class SampleFormat : std::uint8_t { Int16 = 1, Int32 = 2 };
[[nodiscard]] constexpr std::size_t bytesOf(SampleFormat format) noexcept {
    return format == SampleFormat::Int16 ? 2 : 4;
}

/// Turns a raw number into a value: scale * raw + offset.
struct Column {
    double scale = 1;
    double offset = 0;
};

struct StreamConfiguration {
    std::uint8_t stream = 0;
    bool enabled = false;
    StreamKind kind = StreamKind::Acceleration;
    StreamUnit unit = StreamUnit::Count;
    SampleFormat format = SampleFormat::Int16;
    std::uint32_t rate_mhz = 0;  ///< sampling rate in thousandths of hertz, as in the protocol
    std::vector<Column> columns;

    [[nodiscard]] double rate_hz() const noexcept { return rate_mhz / 1000.0; }
};

struct StreamCalibration {
    std::uint8_t stream = 0;
    bool calibrated = false;
    std::string date;                 ///< "2026-11-20"; empty if the board states none
    std::string reference;            ///< number of the certificate or procedure
    std::vector<double> uncertainty;  ///< relative standard uncertainty (k = 1) of each column's scale
};

struct BoardStatus {
    bool running = false;
    std::uint8_t faultyStreams = 0;  ///< bit i is set if the sensor of stream i does not answer
    std::uint64_t time_us = 0;       ///< time since power-up
    std::uint32_t samplesLost = 0;
    std::uint32_t blocksDropped = 0;
    std::uint32_t framesRefused = 0;
};

/// `samples` points into the payload: count * columns numbers, not yet checked against the stream's configuration.
struct DataBlock {
    std::uint8_t stream = 0;
    std::uint8_t count = 0;
    std::uint32_t sequence = 0;
    std::uint32_t index = 0;
    std::uint64_t time_us = 0;
    std::uint32_t interval_ns = 0;
    std::span<const std::uint8_t> samples;
};

/// What encodes in the board. Layout, hash and refusal are those of resources/firmware/tactile_encoder.
struct EncoderState {
    bool encodes = false;      ///< from the next START on
    std::uint8_t refusal = 0;  ///< enum te_refusal of the profile; 0: accepted
    std::uint32_t layout = 0;
    std::uint32_t hash = 0;
};

/// One frame of the board's encoder. NaN: absent.
struct BoardReading {
    std::uint32_t sequence = 0;
    std::uint64_t time_us = 0;  ///< the middle of its window
    bool contact = false, sliding = false, slidingAssumed = false;
    std::uint32_t faults = 0;  ///< TE_FAULT_...
    double R = 0, P = 0;       ///< 0..1
    double pressure_pa = 0, h = 0, v = 0;
};

struct BoardTrain {
    std::uint32_t sequence = 0;
    std::uint64_t onset_us = 0;
    double interval_s = 0, command_v = 0, amplitude = 0;
    std::uint8_t shape = 0;  ///< enum te_shape
    bool negative = false;
    double width_us = 0, gap_us = 0, rechargeRatio = 0;
    std::uint32_t pulses = 0;
    double rate_hz = 0;
    std::uint16_t ahead_us = 0;  ///< from when it was made to its onset
};

struct BoardSilence {
    std::uint32_t sequence = 0;
    std::uint64_t time_us = 0;
    std::uint32_t faults = 0;
    std::uint8_t refusal = 0;  ///< enum te_refusal of a train that was due; 0: none
};

struct Refusal {
    std::uint8_t command = 0;
    std::uint8_t reason = 0;
    [[nodiscard]] std::string text() const;
};

/// Returns the token of an answer, or 0 for a frame that nobody asked for.
[[nodiscard]] std::uint8_t tokenOf(const Frame& frame) noexcept;

/// Errors of each function: ParseError naming the field, its value and what was expected.
[[nodiscard]] Result<BoardIdentity> readIdentity(const Frame& frame);
[[nodiscard]] Result<StreamConfiguration> readConfiguration(const Frame& frame);
[[nodiscard]] Result<StreamCalibration> readCalibration(const Frame& frame);
[[nodiscard]] Result<BoardStatus> readStatus(const Frame& frame);
[[nodiscard]] Result<Refusal> readRefusal(const Frame& frame);
/// Returns the board time in a DONE answer to `command`.
[[nodiscard]] Result<std::uint64_t> readDone(const Frame& frame, Command command);
/// Reads a block without allocating; returns nothing for a payload that is not a block.
[[nodiscard]] std::optional<DataBlock> readBlock(const Frame& frame) noexcept;
[[nodiscard]] Result<EncoderState> readEncoder(const Frame& frame);
/// These return nothing for another length, unknown flags or shapes, and values that are infinite or out of their
/// range; of a train also for one that is absent.
[[nodiscard]] std::optional<BoardReading> readReading(const Frame& frame) noexcept;
[[nodiscard]] std::optional<BoardTrain> readTrain(const Frame& frame) noexcept;
[[nodiscard]] std::optional<BoardSilence> readSilence(const Frame& frame) noexcept;

/// Returns the payload of SET_CONFIGURATION without the token.
[[nodiscard]] std::vector<std::uint8_t> configurationPayload(const StreamConfiguration& configuration);

}  // namespace tacto::sensorboard
