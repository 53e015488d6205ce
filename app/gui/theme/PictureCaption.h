// PictureCaption.h - what stands above a saved picture and says what it shows: title, date, devices, scale, readings,
// and that it is simulated.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDateTime>
#include <QPainter>
#include <QString>
#include <QStringList>
#include <qcustomplot.h>
#include <vector>

#include "core/session/SessionTypes.h"

namespace tacto::gui {

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
/// With its zone.
[[nodiscard]] QString pictureDate(const QDateTime& taken);
/// "twin SIM-1 (simulated) · Demo device".
[[nodiscard]] QString deviceNames(const std::vector<SessionDevice>& devices);
/// "Interval (s) 0 to 2.2 · Amplitude (V) 0 to 44": the axes that have a title.
[[nodiscard]] QString axesText(const QCustomPlot& plot);

/// A caption laid out for a width: a line that has no room goes on in another.
class CaptionLines {
public:
    CaptionLines(const PictureCaption& caption, int width);
    /// 0 for an empty caption.
    [[nodiscard]] int height() const { return height_; }
    /// From the painter's origin on.
    void draw(QPainter& painter) const;

private:
    QStringList title_, rest_;
    int width_ = 0, height_ = 0;
};

}  // namespace tacto::gui
