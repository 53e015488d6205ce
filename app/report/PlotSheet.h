// PlotSheet.h - one figure as plots on a sheet of fixed size, in the report's one look: quiet grid, units on the axes,
// conditions told apart by colour, dash and marker, "SIMULATED" across every plot of a simulated session.
//
// Drawn as vectors onto a page or into an SVG. Everything drawn lies inside its axes: SVG knows no clipping here.
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
/// The four conditions have their own; other names take the further colours by `index`.
[[nodiscard]] ConditionStyle conditionStyle(const QString& name, int index);

inline constexpr int kSheetWidth = 656;  ///< the text width of an A4 page

class PlotSheet {
public:
    PlotSheet(int width, int height, bool simulated);

    [[nodiscard]] QCustomPlot& plot() noexcept { return *plot_; }
    [[nodiscard]] QSize size() const noexcept { return size_; }
    [[nodiscard]] bool simulated() const noexcept { return simulated_; }

    /// Styled axes in a cell of `grid` (the sheet's own layout when null); left and bottom axis shown.
    QCPAxisRect* addAxes(int row, int column, QCPLayoutGrid* grid = nullptr);
    /// A line of text in a cell, left-aligned.
    void addTitle(int row, int column, const QString& text, bool bold, QCPLayoutGrid* grid = nullptr);
    QCPLayoutGrid* addGrid(int row, int column);
    /// Text inside axes, at a position in axis-rect ratios.
    QCPItemText* addNote(QCPAxisRect* axes, const QString& text, QPointF ratio,
                         Qt::Alignment alignment = Qt::AlignCenter);
    /// Says in the middle of empty axes why they are empty, and hides their ticks.
    void explain(QCPAxisRect* axes, const QString& why);
    /// Adds a legend below the plots, with an entry per condition: line or marker with its name.
    QCPLegend* addLegend(int row, int column, int entriesPerLine);
    /// Called once its entries are in, so that it is no wider than they are.
    static void fitLegend(QCPLegend* legend);
    /// Marks the session as simulated, behind the data. Called for every axes that show data.
    void watermark(QCPAxisRect* axes, int size = 26);

    /// Draws with the sheet's top left corner at the painter's origin. Never rasterises.
    void paint(QCPPainter& painter);

private:
    std::unique_ptr<QCustomPlot> plot_;
    QSize size_;
    bool simulated_;
};

/// Ticks with a true minus, all with as many decimals as their step needs.
class PlainTicker : public QCPAxisTicker {
public:
    /// About `count` ticks, or one every `fixedStep` from 0; `suffix` is a unit where an axis has no room for a label.
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

/// The largest round number that is not above `reach`, and above half of it: for ticks at it and at 0 alone.
[[nodiscard]] double roundBelow(double reach);

/// A range around [low, high] with `share` of its width as margin at each end; never empty.
[[nodiscard]] QCPRange padded(double low, double high, double share);

}  // namespace tacto
