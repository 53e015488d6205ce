// Schema.h - the tables of a session file.
//
// Everything is a row of `entries`, in the order it was written, linked by hashes (Digest.h). Sample chunks and
// captures keep their bulk in tables of their own under the entry's seq. The views (events, trials, ...) are for people
// with another SQLite program. Triggers refuse changes and deletions: no session is altered by accident.
//
// Thread-safety: pure functions; createSchema() as Database.
#pragma once

#include <cstdint>

#include "core/base/Result.h"
#include "core/session/Database.h"

namespace tacto {

inline constexpr std::uint32_t kApplicationId = 0x54414354;  ///< "TACT"
inline constexpr int kSchemaVersion = 1;
/// The same tables with annotations behind the end mark: a program that does not know them says that it is too old,
/// instead of calling the session damaged.
inline constexpr int kAnnotatedVersion = 2;
/// The same tables with sealed rows (SealedRow.h).
inline constexpr int kSealedVersion = 3;
inline constexpr int kNewestVersion = kSealedVersion;

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
inline constexpr const char* kAnnotation = "annotation";  ///< the only rows after the end: SessionLabels.h
}  // namespace kind

/// Makes the tables, views and triggers of kSchemaVersion and sets both ids.
[[nodiscard]] Result<void> createSchema(Database& database);

}  // namespace tacto
