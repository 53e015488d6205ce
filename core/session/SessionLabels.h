// SessionLabels.h - people's words about a session, entered or changed after it ended: operator, sample, tags, a note.
//
// Each change is a row of its own behind the end mark, on the same hash chain. The recording and its head (the hash of
// the end mark, which the report prints) do not change. The row is added to a copy of the file; the complete copy then
// replaces the file, so that the file always has either the whole change or none of it.
//
//   {"wall": "2026-11-20T14:03:05Z", "operator": "...", "sample": "...", "note": "...", "tags": ["...", ...]}
//
// The row holds only the fields that the person changed; a change by another program to another field is kept.
//
// Thread-safety: any thread and several programs: while one program changes a session, others are refused.
#pragma once

#include <filesystem>
#include <functional>

#include "core/base/Result.h"
#include "core/session/SessionTypes.h"

namespace tacto {

class SessionReader;

inline constexpr std::size_t kLabelLimit = 200;  ///< characters of operator and of sample
inline constexpr std::size_t kSessionNoteLimit = 1000;
inline constexpr std::size_t kTagLimit = 40;
inline constexpr std::size_t kMaxTags = 20;

/// Errors: InvalidArgument naming a text that is too long, is not UTF-8 or holds a control character; a tag that is
/// empty, holds a comma or appears twice; too many tags.
[[nodiscard]] Result<void> checkLabels(const SessionLabels& labels);

/// Checks that the labels of `session`, which `reader` reads, can be changed. Errors: Unsupported if it has no end mark
/// (it is being recorded, or was interrupted) or is sealed; Io if it is read-only.
[[nodiscard]] Result<void> takesLabels(const std::filesystem::path& session, const SessionReader& reader);

/// Copies to `onto` each field in which `edited` differs from `shown`. The list of tags is one field.
void takeEdit(const SessionLabels& shown, const SessionLabels& edited, SessionLabels& onto);

/// Saves in the session the fields that a person edited after seeing `shown`; writes nothing if the session has them
/// already. Returns the labels of the session after the change. Blocks while the file is copied. Errors: as
/// checkLabels(), SessionReader and takesLabels(); Io if another program has locked the session or it cannot be
/// written. After an error the session is unchanged.
[[nodiscard]] Result<SessionLabels> saveLabels(const std::filesystem::path& session, const SessionLabels& shown,
                                               const SessionLabels& edited);

/// Adds a row with the body that `bodyFor` returns and the present time; adds none if the body is empty. The row is not
/// sealed, also in a sealed session. The session is locked from before `bodyFor` reads it. Errors: as `bodyFor` and
/// saveLabels(), but for a sealed session.
[[nodiscard]] Result<void> annotateSession(const std::filesystem::path& session,
                                           const std::function<Result<nlohmann::json>(const SessionReader&)>& bodyFor);

/// Copies the labels in the body of a row, which is an annotation or the report's notes, to `labels`.
void applyLabels(const nlohmann::json& body, SessionLabels& labels);

}  // namespace tacto
