// WholeFile.h - replaces a file by a whole new one or leaves it as it was, also on a disk that fills up (hazard H8).
//
// QSaveFile alone does not do it: its commit() replaces the file even where the last buffered piece was not written.
//
// Thread-safety: any thread; two that write one file at once both leave a whole one.
#pragma once

#include <QByteArray>
#include <QString>

#include "core/base/Result.h"

namespace tacto {

/// Returns when the disk holds all of `content`.
/// Errors: Io with the system's reason as half a sentence ("No space left on device"), for the caller's own sentence.
[[nodiscard]] Result<void> writeWholeFile(const QString& path, const QByteArray& content);

}  // namespace tacto
