// PlotSheet.h - a figure as plots on a sheet of fixed size, in the style of all reports: light grid, units on the axes,
// conditions that differ in colour, dash and marker, "SIMULATED" across every plot of a simulated session.
//
// Drawn as vectors onto a page or into an SVG. Everything must lie inside its axes, because the SVG is not clipped.
// Sizes are in the report's unit, 1/96 inch.
//
// Thread-safety: the GUI thread (plots are widgets).
#pragma once

#include <memory>
#include <qcustomplot.h>
#include <vector>

#include "app/report/Ink.h"

namespace tacto {

struct ConditionStyle {
    QColor color;
    Qt::PenStyle dash = Qt::SolidLine;
    QCPScatterStyle::ScatterShape marker = QCPScatterStyle::ssDisc;
    [[nodiscard]] QPen pen(double width) const { return QPen(color, width, dash, Qt::FlatCap, Qt::MiterJoin); }
};
/// The four conditions have fixed styles; other names take further colours by `index`.
[[nodiscard]] ConditionStyle conditionStyle(const QString& name, int index);

inline constexpr int kSheetWidth = 656;  ///< the text width of an A4 page

class PlotSheet {
public:
    PlotSheet(int width, int height, bool simulated);

    [[nodiscard]] QCustomPlot& plot() noexcept { return *plot_; }
    [[nodiscard]] QSize size() const noexcept { return size_; }
    [[nodiscard]] bool simulated() const noexcept { return simulated_; }

    /// Adds styled axes in a cell of `grid` (null: the sheet's own layout); left and bottom axis are shown.
    QCPAxisRect* addAxes(int row, int column, QCPLayoutGrid* grid = nullptr);
    /// Adds a left-aligned line of text in a cell.
    void addTitle(int row, int column, const QString& text, bool bold, QCPLayoutGrid* grid = nullptr);
    QCPLayoutGrid* addGrid(int row, int column);
    /// Adds text inside axes; `ratio` is its position as a fraction of the axis rectangle.
    QCPItemText* addNote(QCPAxisRect* axes, const QString& text, QPointF ratio,
                         Qt::Alignment alignment = Qt::AlignCenter);
    /// Writes in the middle of empty axes why they are empty, and hides their ticks.
    void explain(QCPAxisRect* axes, const QString& why);
    /// Adds a legend below the plots, with one entry per condition: line or marker and name.
    QCPLegend* addLegend(int row, int column, int entriesPerLine);
    /// Makes the legend no wider than its entries. Call this after adding them.
    static void fitLegend(QCPLegend* legend);
    /// Marks the plot as simulated, behind the data. Call this for every axes with data.
    void watermark(QCPAxisRect* axes, int size = 26);

    /// Draws the sheet with its top left corner at the painter's origin. Never rasterises.
    void paint(QCPPainter& painter);

private:
    std::unique_ptr<QCustomPlot> plot_;
    QSize size_;
    bool simulated_;
};

/// Ticks with a true minus, all with the number of decimals that their step needs.
class PlainTicker : public QCPAxisTicker {
public:
    /// About `count` ticks, or one every `fixedStep` from 0. `suffix`: a unit, for an axis without room for a label.
    explicit PlainTicker(int count, double fixedStep = 0, QString suffix = {})
        : fixed_(fixedStep), suffix_(std::move(suffix)) {
        setTickCount(count);
        setTickStepStrategy(tssReadability);
    }

protected:
    QString getTickLabel(double tick, const QLocale& locale, QChar format, int precision) override;
    double getTickStep(const QCPRange& range) override;

private:
    double fixed_;
    QString suffix_;
    double step_ = 1;
};

/// Returns the largest round number in (reach / 2, reach], for an axis with ticks only at 0 and at this number.
[[nodiscard]] double roundBelow(double reach);

/// Returns [low, high] with a margin of `share` of its width at each end; never empty.
[[nodiscard]] QCPRange padded(double low, double high, double share);

}  // namespace tacto
