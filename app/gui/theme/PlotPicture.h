// PlotPicture.h - every plot copies and saves. A file is replaced whole or not at all.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QImage>
#include <QString>
#include <functional>
#include <optional>
#include <qcustomplot.h>

#include "app/gui/theme/PictureCaption.h"

namespace tacto::gui {

/// The picture of a moment, its caption above it: it is saved as it was then, however long a dialog asks for the
/// file's name.
class Still {
public:
    /// What `plot` shows now, with the caption of captionPictures().
    Still(QCustomPlot& plot);  // NOLINT(google-explicit-constructor): a plot is saved as it is
    /// What `widget` shows now.
    Still(QWidget& widget, PictureCaption caption);
    /// `draw` paints `size` from the painter's origin on. `title` is for screen readers.
    Still(QSize size, std::function<void(QCPPainter&)> draw, PictureCaption caption, QString title);

    /// Includes the caption and its margin.
    [[nodiscard]] QSize size() const;
    /// All of it, on its ground.
    void draw(QCPPainter& painter) const;
    [[nodiscard]] const QString& title() const { return title_; }

private:
    [[nodiscard]] CaptionLines captionLines() const;
    QSize size_;
    std::function<void(QCPPainter&)> draw_;
    PictureCaption caption_;
    QString title_;
    QColor ground_;
};

/// Every picture of `plot` says this above it, also by its menu.
void captionPictures(QCustomPlot& plot, const std::function<PictureCaption()>& caption);

/// By the path's ending: .png (twice the screen's resolution), .svg or .pdf. Returns what went wrong, as a sentence.
[[nodiscard]] std::optional<QString> savePicture(const Still& still, const QString& path);
[[nodiscard]] QImage pictureOf(const Still& still, double scale);

void copyPicture(const Still& still);
/// Asks where to; `name` is the file that is proposed.
void askSavePicture(QWidget& parent, const Still& still, const QString& name);

/// A context menu, also by the menu key: copy as picture, save. `name` is the file that is proposed.
void addPlotMenu(QCustomPlot& plot, const QString& name);

}  // namespace tacto::gui
