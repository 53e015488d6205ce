// Schema.h - the tables of a session file.
//
// Every record is a row of `entries`, in the order of writing, linked by hashes (Digest.h). Sample chunks and captures
// have their data in tables of their own, under their entry's seq. The views (events, trials, ...) help people with
// other SQLite programs. Triggers refuse changes and deletions, so that nobody alters a session by accident.
//
// Chunks are packed where that saves space (core/packing/PackedColumns.h); their `stamps` are then NULL. What is
// checked:
//   a chunk's "crc32"    its stamps (unless they are a line) and its values as recorded, as doubles, before packing
//   a capture's "crc32"  its data as stored
//   `digest`             the bytes as stored, `stamps` before `data`; so any changed byte of a packed chunk is noticed
//   `hash`               the row with its digest, and the rows before it
// Chunks of sealed sessions are sealed as they are: the size of a packed chunk would tell what was felt.
//
// Thread-safety: pure functions; createSchema() as Database.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/base/Result.h"
#include "core/session/Database.h"

namespace tacto {

inline constexpr std::uint32_t kApplicationId = 0x54414354;  ///< "TACT"
inline constexpr int kSchemaVersion = 1;
/// The same tables, with annotations behind the end mark. A program that does not know annotations then reports that it
/// is too old, and does not call the session damaged.
inline constexpr int kAnnotatedVersion = 2;
/// The same tables with sealed rows (SealedRow.h).
inline constexpr int kSealedVersion = 3;
/// The same tables with packed chunks, and annotations behind the end mark.
inline constexpr int kPackedVersion = 4;
inline constexpr int kNewestVersion = kPackedVersion;
/// No recording has so many rows; counting beyond this could overflow.
inline constexpr std::int64_t kLastSeq = std::int64_t{1} << 60;

/// The kinds of `entries` rows.
namespace kind {
inline constexpr const char* kAbout = "about";
inline constexpr const char* kStream = "stream";
inline constexpr const char* kChunk = "chunk";
inline constexpr const char* kEvent = "event";
inline constexpr const char* kCommand = "command";
inline constexpr const char* kTrial = "trial";
inline constexpr const char* kCapture = "capture";
inline constexpr const char* kMeasurement = "measurement";
inline constexpr const char* kReport = "report";
inline constexpr const char* kVerdict = "verdict";
inline constexpr const char* kLog = "log";
inline constexpr const char* kEnd = "end";
inline constexpr const char* kAnnotation = "annotation";  ///< the only kind of row after the end mark (SessionLabels.h)
inline constexpr std::string_view kAll[] = {kAbout,       kStream, kChunk,   kEvent, kCommand, kTrial,     kCapture,
                                            kMeasurement, kReport, kVerdict, kLog,   kEnd,     kAnnotation};
}  // namespace kind

/// Creates the tables, views and triggers, and sets application id and version.
[[nodiscard]] Result<void> createSchema(Database& database, int version);

}  // namespace tacto
