// PlotPicture.h - every plot copies and saves. A file is replaced whole or not at all.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QImage>
#include <QString>
#include <optional>
#include <qcustomplot.h>

namespace tacto::gui {

/// By the path's ending: .png (twice the screen's resolution), .svg or .pdf. Its title is the plot's accessible name.
/// Returns what went wrong, as a sentence.
[[nodiscard]] std::optional<QString> savePicture(QCustomPlot& plot, const QString& path);
[[nodiscard]] QImage pictureOf(QCustomPlot& plot, double scale);

void copyPicture(QCustomPlot& plot);
/// Asks where to; `name` is the file that is proposed.
void askSavePicture(QCustomPlot& plot, const QString& name);

/// A context menu, also by the menu key: copy as picture, save. `name` is the file that is proposed.
void addPlotMenu(QCustomPlot& plot, const QString& name);

}  // namespace tacto::gui
