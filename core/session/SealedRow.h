// SealedRow.h - what a row of a sealed session shows to readers without the key, and how the row stores the rest.
//
// Shown are: number, kind and order of rows; their time in whole seconds (a finer time would reveal response times);
// names of events that tell the progress of a session; devices, calibration, limit sets, interlock states, faults,
// stops; and refusals without their numbers. All other names and contents are sealed, also those that no rule mentions.
// The stored body is
//   {"sealed": "...", what is shown}
// and the opened seal is {"t_ns": exact time, "name": "...", "body": {...}}. Rows "stream" and "end" are not sealed. A
// chunk's stamps and values are sealed together, and its row holds its head; a capture's samples are sealed too.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Units.h"
#include "core/session/Chunk.h"
#include "core/session/RowSeal.h"

namespace tacto {

/// A row as stored, or as it was before sealing.
struct OutsideRow {
    Instant at{0};
    std::string name;
    std::string body;  ///< JSON
};
struct InsideRow {
    Instant at{0};
    std::string name;
    nlohmann::json body;
    bool sealed = false;  ///< still sealed, because there is no key: name and body hold only what is shown
};

/// `body` must be JSON.
[[nodiscard]] OutsideRow sealedRow(const RowSeal& seal, std::int64_t seq, std::string_view kind, Instant at,
                                   std::string_view name, std::string_view body);

/// `seal` may be null: a sealed row then has the body {"sealed": true} with what is shown, and a sealed name reads
/// "sealed". Errors: ParseError for a row that the key does not open.
[[nodiscard]] Result<InsideRow> openedRow(const RowSeal* seal, std::int64_t seq, std::string_view kind, Instant at,
                                          std::string_view name, nlohmann::json body);

/// Seals or opens the bytes of the chunk or capture in row `seq`.
[[nodiscard]] std::vector<std::byte> sealedBulk(const RowSeal& seal, std::int64_t seq, std::string_view kind,
                                                std::span<const std::span<const std::byte>> parts);
[[nodiscard]] Result<std::vector<std::byte>> openedBulk(const RowSeal& seal, std::int64_t seq, std::string_view kind,
                                                        std::span<const std::byte> sealed);
/// Unpacks the stamps and values of an opened chunk.
[[nodiscard]] Result<void> unpackOpenedChunk(const ChunkHead& head, std::size_t columns,
                                             std::span<const std::byte> opened, SampleBlock& into);

/// Whether rows of this kind are sealed in a sealed session.
[[nodiscard]] bool isSealedKind(std::string_view kind) noexcept;
/// Rounds down to the whole second.
[[nodiscard]] Instant wholeSecond(Instant at) noexcept;

}  // namespace tacto
