// PlotPicture.h - copies and saves pictures of plots. A file is replaced completely or not at all.
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

// The caption above a saved picture: title, date, devices, scale, readings, and whether the data are simulated.

/// Empty lines are left out.
struct PictureCaption {
    QString title;      ///< "Oscilloscope · simulated"
    QString date;       ///< "2026-11-26 16:59:39 UTC+01:00"
    QStringList lines;  ///< devices, scale, readings
    [[nodiscard]] bool empty() const { return title.isEmpty() && date.isEmpty() && lines.isEmpty(); }
    /// Margin around the plot in pixels, with which plot and caption line up; 0 without a caption.
    [[nodiscard]] int margin() const { return empty() ? 0 : kMargin; }
    static constexpr int kMargin = 16;
};

/// Returns a title such as "Oscilloscope · simulated".
[[nodiscard]] QString pictureTitle(const QString& title, bool simulated);
/// Returns the date with its time zone.
[[nodiscard]] QString pictureDate(const QDateTime& taken);
/// Returns the names in one line: "twin SIM-1 (simulated) · Demo device".
[[nodiscard]] QString deviceNames(const std::vector<SessionDevice>& devices);
/// "Interval (s) 0 to 2.2 · Amplitude (V) 0 to 44": the ranges of all axes with a title.
[[nodiscard]] QString axesText(const QCustomPlot& plot);

/// A caption laid out for a given width: lines that are too long are wrapped.
class CaptionLines {
public:
    CaptionLines(const PictureCaption& caption, int width);
    /// 0 for an empty caption.
    [[nodiscard]] int height() const { return height_; }
    /// Draws the caption with its top left at the painter's origin.
    void draw(QPainter& painter) const;

private:
    QString title_, rest_;
    int width_ = 0, height_ = 0;
};

/// The picture of one moment with its caption, saved unchanged even if the user takes long to choose a file name.
class Still {
public:
    /// The present picture of `plot`, with the caption set by captionPictures().
    Still(QCustomPlot& plot);  // NOLINT(google-explicit-constructor): a plot is saved as it is
    /// The present picture of `widget`.
    Still(QWidget& widget, PictureCaption caption);
    /// `draw` paints an area of `size` from the painter's origin. `title` is for screen readers.
    Still(QSize size, std::function<void(QCPPainter&)> draw, PictureCaption caption, QString title);

    /// Includes the caption and its margin.
    [[nodiscard]] QSize size() const;
    /// Draws the whole picture on its background.
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

/// Sets the caption for all pictures of `plot`, also those made with its menu.
void captionPictures(QCustomPlot& plot, const std::function<PictureCaption()>& caption);

/// Saves as the path's ending says: .png (twice the screen's resolution), .svg or .pdf. Returns errors as a sentence.
[[nodiscard]] std::optional<QString> savePicture(const Still& still, const QString& path);
[[nodiscard]] QImage pictureOf(const Still& still, double scale);

void copyPicture(const Still& still);
/// Asks for the file and saves; `name` is the suggested file name.
void askSavePicture(QWidget& parent, const Still& still, const QString& name);

/// Adds a context menu (also on the menu key) to copy or save the picture. `name` is the suggested file name. The
/// action that saves is named kSavePlot.
inline constexpr const char* kSavePlot = "savePlot";
void addPlotMenu(QCustomPlot& plot, const QString& name);

/// The buttons that save, copy and enlarge a plot, the same in every workspace.
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
    /// Sets the picture that Save and Copy get when clicked; `name` is the suggested file name.
    void takeFrom(const std::function<Still()>& shown, const QString& name);
    /// The picture that Save would get now; only after takeFrom().
    [[nodiscard]] Still picture() const { return shown_(); }

signals:
    /// Asks the window to show the plot alone, or everything again.
    void plotOnlyWanted();

private:
    QToolButton* save_;
    QToolButton* copy_;
    QToolButton* plotOnly_;
    std::function<Still()> shown_;
};

}  // namespace tacto::gui
