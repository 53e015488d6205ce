// PlotLegend.h - a plot's legend at the left above its axes, where it covers no data; as wide as its entries.
#pragma once

#include <qcustomplot.h>

namespace tacto::gui {

/// Moves the legend of `plot` into its own line above the axes. Call once, before anything is drawn.
void putLegendAbove(QCustomPlot& plot);
/// Fits the legend to its entries in the current theme. Call it again after a change of entries, theme or text size,
/// and when the legend is shown or hidden.
void fitLegend(QCustomPlot& plot);
/// Arranges the entries from now on in one row if the plot is wide enough, else in as few rows of equal length as
/// possible.
void wrapLegend(QCustomPlot& plot);
/// Draws a trace's symbol in the legend: a horizontal line in its pen.
void drawLineIcon(QCPPainter& painter, const QRectF& icon, const QPen& pen);

}  // namespace tacto::gui
