// SealedRow.h - what a row of a sealed session shows to readers without its key, and how the rest lies in it.
//
// Shown: number, kind and order of rows, their time to the whole second (finer would tell response times), the name of
// events that say how far the session went, devices, calibration, limit sets, interlock states, faults, stops, and
// refusals with their numbers left out. All other names and all else in the bodies is sealed: what no rule names is.
// The stored body is
//   {"sealed": "...", what is shown}
// and what opens is {"t_ns": exact time, "name": "...", "body": {...}}. Rows "stream" and "end" have nothing to hide.
// A chunk's stamps and values are sealed together, its head in the row; a capture's samples as well.
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

/// A row as it is stored, or as it was before.
struct OutsideRow {
    Instant at{0};
    std::string name;
    std::string body;  ///< JSON
};
struct InsideRow {
    Instant at{0};
    std::string name;
    nlohmann::json body;
    bool sealed = false;  ///< still: there is no key, name and body are what is shown
};

/// `body` is JSON.
[[nodiscard]] OutsideRow sealedRow(const RowSeal& seal, std::int64_t seq, std::string_view kind, Instant at,
                                   std::string_view name, std::string_view body);

/// `seal` may be null: the row says {"sealed": true} with what is shown, and its name is "sealed" where that is.
/// Errors: ParseError for a row that the key does not open.
[[nodiscard]] Result<InsideRow> openedRow(const RowSeal* seal, std::int64_t seq, std::string_view kind, Instant at,
                                          std::string_view name, nlohmann::json body);

/// The bytes of the chunk or capture of row `seq`.
[[nodiscard]] std::vector<std::byte> sealedBulk(const RowSeal& seal, std::int64_t seq, std::string_view kind,
                                                std::span<const std::span<const std::byte>> parts);
[[nodiscard]] Result<std::vector<std::byte>> openedBulk(const RowSeal& seal, std::int64_t seq, std::string_view kind,
                                                        std::span<const std::byte> sealed);
/// Stamps and values of an opened chunk.
[[nodiscard]] Result<void> unpackOpenedChunk(const ChunkHead& head, std::size_t columns,
                                             std::span<const std::byte> opened, SampleBlock& into);

/// Whether rows of this kind are sealed in a sealed session.
[[nodiscard]] bool isSealedKind(std::string_view kind) noexcept;
/// Cut to the whole second.
[[nodiscard]] Instant wholeSecond(Instant at) noexcept;

}  // namespace tacto
