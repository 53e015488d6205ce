// PlotLegend.h - a plot's legend above its axes, where it covers no data: as wide as its entries, at the left.
#pragma once

#include <qcustomplot.h>

namespace tacto::gui {

/// Puts the legend of `plot` into a line of its own. Call once, before anything is drawn.
void putLegendAbove(QCustomPlot& plot);
/// Fits it to its entries, in the current theme: call again when they, the theme or the size of text change, and when
/// it is shown or hidden.
void fitLegend(QCustomPlot& plot);
/// From now on its entries stand in one row where the plot is wide enough, else in as few rows of equal length as that
/// takes.
void wrapLegend(QCustomPlot& plot);
/// A trace's icon in the legend: a level line in its pen.
void drawLineIcon(QCPPainter& painter, const QRectF& icon, const QPen& pen);

}  // namespace tacto::gui
