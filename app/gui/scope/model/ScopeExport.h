// ScopeExport.h - what is on the screen as a table. A file is replaced whole or not at all.
//
// Thread-safety: any thread.
#pragma once

#include <QString>
#include <optional>

#include "app/gui/scope/model/Trace.h"

namespace tacto::gui {

/// Channels and what is calculated from them, from..to on the session's time base, as a capture file
/// (core/measure/CaptureFile.h). Returns what went wrong, as a sentence.
[[nodiscard]] std::optional<QString> saveData(const ShownCapture& shown, double from_s, double to_s,
                                              const QString& path);

}  // namespace tacto::gui
