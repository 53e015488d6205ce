// Chunk.h - consecutive samples of a stream as the file stores them: with either a straight line of time stamps or
// every single stamp; packed (core/packing/PackedColumns.h) or, where that saves nothing, as little-endian doubles.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
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

/// Stamps this close to a straight line are stored as the line: the time base has a resolution of one nanosecond.
inline constexpr double kStampTolerance_s = 1e-9;

/// t = t0_s + i * step_s
struct StampLine {
    double t0_s;
    double step_s;
};

/// Returns the line that runs within kStampTolerance_s of every stamp, or nothing. A single finite stamp makes a line.
[[nodiscard]] std::optional<StampLine> lineThrough(std::span<const double> t_s) noexcept;

/// The description of a chunk in its row of the log.
struct ChunkHead {
    int stream = 0;
    std::int64_t index = 0;         ///< number of the chunk within the stream, from 0
    std::uint64_t firstSample = 0;  ///< position of the chunk's first sample in the stream
    std::uint64_t samples = 0;
    std::optional<StampLine> line;            ///< if not set, the stamps are stored one by one
    std::uint32_t crc = 0;                    ///< checksum of the stamps (if stored) and the values, before packing
    std::optional<std::string> packing = {};  ///< kPackedAsSteps, of stamps and values together; not set: doubles
};

[[nodiscard]] std::string toJsonText(const ChunkHead& head);
/// Errors: ParseError.
[[nodiscard]] Result<ChunkHead> parseChunkHead(std::string_view json);
[[nodiscard]] Result<ChunkHead> chunkHeadFrom(const nlohmann::json& json);

/// Returns the stamps, if `withStamps`, and the values: what the head's checksum covers.
[[nodiscard]] std::array<std::span<const std::byte>, 2> recordedBytes(const SampleBlock& block,
                                                                      bool withStamps) noexcept;

/// Reads the samples of a chunk. Errors: ParseError if the sizes do not fit the head; Unsupported for a packing that
/// this program does not know.
[[nodiscard]] Result<void> unpackChunk(const ChunkHead& head, std::size_t columns, std::span<const std::byte> stamps,
                                       std::span<const std::byte> data, SampleBlock& into);

/// Puts the stamps of a chunk whose head has their line into `into`, and no values.
void stampsOf(const ChunkHead& head, SampleBlock& into);

// An oscilloscope record as the file stores it: a description in JSON, and the float32 samples of one channel after the
// other, deflated if that saves space.

struct PackedCapture {
    std::vector<std::byte> data;
    bool deflated = false;
};

/// Deflates at the fastest level; keeps the deflated samples if they are at least a tenth smaller.
[[nodiscard]] PackedCapture packSamples(const Capture& capture);
/// Returns the capture without its samples as JSON for its log row, without "trial" and checksums. NaN becomes null.
[[nodiscard]] nlohmann::json describePacked(const Capture& capture, const PackedCapture& packed);

/// Errors: ParseError if the description is not valid or the samples do not fit it.
[[nodiscard]] Result<Capture> unpackCapture(const nlohmann::json& description, std::span<const std::byte> data);

}  // namespace tacto
