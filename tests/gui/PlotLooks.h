// PlotLooks.h - finds visible faults of plots: text that is cut off, pale or overlapping, and legends over data.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QString>
#include <QStringList>
#include <QWidget>
#include <qcustomplot.h>
#include <vector>

namespace tacto::test {

/// A text of a plot as drawn: tick label, axis title, legend entry or item.
struct PlotWord {
    QString text;
    QRectF ink;   ///< the area covered by the letters, in pixels of the plot
    QRectF room;  ///< the area that the text may use: the plot, or its clip
    QColor colour;
};
/// All upright or quarter-turned texts of the plot, except the watermark, which lies behind them.
[[nodiscard]] std::vector<PlotWord> wordsOf(QCustomPlot& plot);

/// Texts of visible plots that overlap, or that the plot's edge cuts off.
[[nodiscard]] QStringList plotWordFaults(const QWidget& in);
/// Texts of visible plots with a contrast below 4.5:1 to the colour drawn around their letters.
[[nodiscard]] QStringList palePlotWords(const QWidget& in);
/// Legends inside the axes that cover points or lines of their plot.
[[nodiscard]] QStringList legendsOverData(const QWidget& in);
/// Axes of visible plots with a title that does not start with a capital letter.
[[nodiscard]] QStringList smallAxisTitles(const QWidget& in);

}  // namespace tacto::test
