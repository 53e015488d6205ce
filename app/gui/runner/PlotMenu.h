// PlotMenu.h - every plot copies and saves: a context menu, also by the menu key.
//
// Thread-safety: the GUI thread.
#pragma once

#include <qcustomplot.h>

namespace tacto::gui {

/// Copy as picture, save as PNG or PDF. `name` is the file that is proposed.
void addPlotMenu(QCustomPlot& plot, const QString& name);

}  // namespace tacto::gui
