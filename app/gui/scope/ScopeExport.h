// ScopeExport.h - the screen as a picture and its data as a table. A file is replaced whole or not at all.
//
// Thread-safety: savePicture() and pictureOf() the GUI thread; saveData() any.
#pragma once

#include <QImage>
#include <QString>
#include <optional>

#include "app/gui/scope/Trace.h"

class QCustomPlot;

namespace tacto::gui {

/// By the path's ending: .png (twice the screen's resolution), .svg or .pdf. Returns what went wrong, as a sentence.
[[nodiscard]] std::optional<QString> savePicture(QCustomPlot& plot, const QString& path);
[[nodiscard]] QImage pictureOf(QCustomPlot& plot, double scale);

/// Channels and what is calculated from them, from..to on the session's time base, as a capture file
/// (core/measure/CaptureFile.h). Returns what went wrong, as a sentence.
[[nodiscard]] std::optional<QString> saveData(const ShownCapture& shown, double from_s, double to_s,
                                              const QString& path);

}  // namespace tacto::gui
