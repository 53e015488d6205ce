// PlotLooks.h - what can be judged of how plots look: words that are cut, pale or over each other, legends over data.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QString>
#include <QStringList>
#include <QWidget>
#include <qcustomplot.h>
#include <vector>

namespace tacto::test {

/// A word of a plot as it is drawn: tick label, title of an axis, legend entry, item.
struct PlotWord {
    QString text;
    QRectF ink;   ///< the area that its letters cover, in pixels of the plot
    QRectF room;  ///< the area that it may cover: the plot, or its clip
    QColor colour;
};
/// All upright or quarter-turned words of the plot without its watermark, which lies behind them.
[[nodiscard]] std::vector<PlotWord> wordsOf(QCustomPlot& plot);

/// Words of visible plots that lie over each other, or that their plot's edge cuts.
[[nodiscard]] QStringList plotWordFaults(const QWidget& in);
/// Words of visible plots with a contrast below 4.5:1 to what is drawn around their letters.
[[nodiscard]] QStringList palePlotWords(const QWidget& in);
/// Legends within axes that lie over points or lines of their plot.
[[nodiscard]] QStringList legendsOverData(const QWidget& in);
/// Axes of visible plots with a title that does not begin with a capital.
[[nodiscard]] QStringList smallAxisTitles(const QWidget& in);

}  // namespace tacto::test
