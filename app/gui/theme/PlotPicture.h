// PlotPicture.h - every plot copies and saves. A file is replaced whole or not at all.
#pragma once

#include <QDateTime>
#include <QImage>
#include <QLayout>
#include <QPainter>
#include <QStringList>
#include <QToolButton>
#include <array>
#include <functional>
#include <optional>
#include <qcustomplot.h>
#include <vector>

#include "core/session/SessionTypes.h"

namespace tacto::gui {

// The caption above a saved picture: title, date, devices, scale, readings, and that it is simulated.

/// Empty lines are left out.
struct PictureCaption {
    QString title;      ///< "Oscilloscope · simulated"
    QString date;       ///< "2026-11-26 16:59:39 UTC+01:00"
    QStringList lines;  ///< devices, scale, readings
    [[nodiscard]] bool empty() const { return title.isEmpty() && date.isEmpty() && lines.isEmpty(); }
    /// Around the plot, in px, so that plot and caption share an edge; 0 without a caption.
    [[nodiscard]] int margin() const { return empty() ? 0 : kMargin; }
    static constexpr int kMargin = 16;
};

/// "Oscilloscope · simulated".
[[nodiscard]] QString pictureTitle(const QString& title, bool simulated);
/// The date with its time zone.
[[nodiscard]] QString pictureDate(const QDateTime& taken);
/// "twin SIM-1 (simulated) · Demo device".
[[nodiscard]] QString deviceNames(const std::vector<SessionDevice>& devices);
/// "Interval (s) 0 to 2.2 · Amplitude (V) 0 to 44": the axes that have a title.
[[nodiscard]] QString axesText(const QCustomPlot& plot);

/// A caption laid out for a width: a line without room continues in another.
class CaptionLines {
public:
    CaptionLines(const PictureCaption& caption, int width);
    /// 0 for an empty caption.
    [[nodiscard]] int height() const { return height_; }
    /// Draws from the painter's origin on.
    void draw(QPainter& painter) const;

private:
    QString title_, rest_;
    int width_ = 0, height_ = 0;
};

/// The picture of a moment with its caption: it is saved as it was then, however long a dialog asks for the file's
/// name.
class Still {
public:
    /// The present picture of `plot`, with the caption of captionPictures().
    Still(QCustomPlot& plot);  // NOLINT(google-explicit-constructor): a plot is saved as it is
    /// The present picture of `widget`.
    Still(QWidget& widget, PictureCaption caption);
    /// `draw` paints `size` from the painter's origin on. `title` is for screen readers.
    Still(QSize size, std::function<void(QCPPainter&)> draw, PictureCaption caption, QString title);

    /// Includes the caption and its margin.
    [[nodiscard]] QSize size() const;
    /// Draws all of it, on its ground.
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

/// Saves by the path's ending: .png (twice the screen's resolution), .svg or .pdf. Returns a sentence on any failure.
[[nodiscard]] std::optional<QString> savePicture(const Still& still, const QString& path);
[[nodiscard]] QImage pictureOf(const Still& still, double scale);

void copyPicture(const Still& still);
/// Asks where to; `name` is the file that is proposed.
void askSavePicture(QWidget& parent, const Still& still, const QString& name);

/// A context menu, also by the menu key: copy as picture, save. `name` is the file that is proposed.
void addPlotMenu(QCustomPlot& plot, const QString& name);

/// The buttons with which a plot is saved, copied and shown alone: the same ones in every workspace.
class PictureTools final : public QObject {
    Q_OBJECT
public:
    /// `parent` owns the buttons and the dialog, and outlives this.
    explicit PictureTools(QWidget* parent);
    [[nodiscard]] QToolButton& save() const { return *save_; }
    [[nodiscard]] QToolButton& copy() const { return *copy_; }
    [[nodiscard]] QToolButton& plotOnly() const { return *plotOnly_; }
    [[nodiscard]] std::array<QToolButton*, 3> buttons() const { return {save_, copy_, plotOnly_}; }
    void addTo(QLayout& row);
    /// Save and copy take what `shown` gives when they are clicked; `name` is the file that is proposed.
    void takeFrom(const std::function<Still()>& shown, const QString& name);

signals:
    /// The plot without what is around it, or back.
    void plotOnlyWanted();

private:
    QToolButton* save_;
    QToolButton* copy_;
    QToolButton* plotOnly_;
};

}  // namespace tacto::gui
