// Chunk.h - consecutive samples of a stream as they lie in the file: little-endian doubles, and either a straight
// line of time stamps or each of them.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/measure/Capture.h"

namespace tacto {

/// Stamps this close to a line are stored as the line: the time base counts nanoseconds.
inline constexpr double kStampTolerance_s = 1e-9;

/// t = t0_s + i * step_s
struct StampLine {
    double t0_s;
    double step_s;
};

/// The line that every stamp lies on to within kStampTolerance_s, or nothing. One finite stamp is a line.
[[nodiscard]] std::optional<StampLine> lineThrough(std::span<const double> t_s) noexcept;

/// The head of a chunk in its log row.
struct ChunkHead {
    int stream = 0;
    std::int64_t index = 0;         ///< 0, 1, ... within the stream
    std::uint64_t firstSample = 0;  ///< position of its first sample in the stream
    std::uint64_t samples = 0;
    std::optional<StampLine> line;  ///< nothing: the stamps are stored one by one
    std::uint32_t crc = 0;          ///< over stamps (if stored) and values
};

[[nodiscard]] std::string toJsonText(const ChunkHead& head);
/// Errors: ParseError.
[[nodiscard]] Result<ChunkHead> parseChunkHead(std::string_view json);

/// Errors: ParseError when the sizes do not fit the head.
[[nodiscard]] Result<void> unpackChunk(const ChunkHead& head, std::size_t columns, std::span<const std::byte> stamps,
                                       std::span<const std::byte> data, SampleBlock& into);

// An oscilloscope record as it lies in the file: a description in JSON, and the channels' float32
// samples one channel after the other, deflated where that helps.

struct PackedCapture {
    std::vector<std::byte> data;
    bool deflated = false;
};

/// Deflates at the fastest level and keeps it when it saves at least a tenth.
[[nodiscard]] PackedCapture packSamples(const Capture& capture);
/// The capture without its samples, as the log row's JSON ("trial" and checksums apart). NaN becomes null.
[[nodiscard]] nlohmann::json describePacked(const Capture& capture, const PackedCapture& packed);

/// Errors: ParseError when the description is not one or the samples do not fit it.
[[nodiscard]] Result<Capture> unpackCapture(const nlohmann::json& description, std::span<const std::byte> data);

}  // namespace tacto
