// SessionLabels.h - what people say about a session, entered or changed after it ended: operator, sample, tags, a note.
//
// A change is a row of its own behind the end mark, on the same hash chain, and the recording before it stays as it is:
// its head, which the report prints, is the hash of the end mark. The row is added to a copy, which takes the file's
// place when it is whole: whatever happens in between, the file is what it was before or has the change.
//
//   {"wall": "2026-11-20T14:03:05Z", "operator": "...", "sample": "...", "note": "...", "tags": ["...", ...]}
//
// It holds only what the person changed: a field that another program changed meanwhile stays as that program left it.
//
// Thread-safety: any thread, several programs: the second to change a session is refused while the first is at it.
#pragma once

#include <filesystem>

#include "core/base/Result.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionReader;

inline constexpr std::size_t kLabelLimit = 200;  ///< characters of operator and sample
inline constexpr std::size_t kSessionNoteLimit = 1000;
inline constexpr std::size_t kTagLimit = 40;
inline constexpr std::size_t kMaxTags = 20;

/// Errors: InvalidArgument naming what is too long, is not UTF-8 or holds a control character; a tag that is empty,
/// holds a comma or stands twice; too many of them.
[[nodiscard]] Result<void> checkLabels(const SessionLabels& labels);

/// Whether `session`, which `reader` reads, takes changes. Errors: Unsupported for a session without an end mark (it is
/// being recorded, or was interrupted); Io for a read-only one.
[[nodiscard]] Result<void> takesLabels(const std::filesystem::path& session, const SessionReader& reader);

/// Takes over into `onto` each field in which `edited` differs from `shown`. The list of tags is one field.
void takeEdit(const SessionLabels& shown, const SessionLabels& edited, SessionLabels& onto);

/// Keeps in the session the fields that a person edited, who was shown `shown`; writes nothing where it has them
/// already. Returns the labels that the session has then. Blocks while the file is copied. Errors: as checkLabels(),
/// SessionReader and takesLabels(); Io when it is locked by another program or cannot be written. After an error the
/// session is as it was.
[[nodiscard]] Result<SessionLabels> saveLabels(const std::filesystem::path& session, const SessionLabels& shown,
                                               const SessionLabels& edited);

/// Takes over what the body of a row says: of an annotation, or of the report's notes.
void applyLabels(const nlohmann::json& body, SessionLabels& labels);

}  // namespace tacto
