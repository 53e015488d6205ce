// FigureDrawing.h - draws a figure as a sheet of plots, and writes the sheet as SVG.
//
// If data are missing or too few, a sentence replaces the figure; a figure is never blank.
//
// Thread-safety: the GUI thread (plots are widgets).
#pragma once

#include <QByteArray>
#include <QString>
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "app/report/Figure.h"
#include "app/report/PlotSheet.h"

namespace tacto {

/// `simulated` adds the watermark to every plot.
[[nodiscard]] std::unique_ptr<PlotSheet> drawFigure(const Figure& figure, bool simulated);

/// Returns sentences that explain the figure (what a bar, an ellipse, a height means) and state its key number.
[[nodiscard]] QString figureLegend(const Figure& figure);

/// Returns an <svg> element for HTML: no XML prologue, scales with its container, `title` for screen readers.
[[nodiscard]] QByteArray sheetSvg(PlotSheet& sheet, const QString& title);

// One function per type, in the file of that name.
[[nodiscard]] std::unique_ptr<PlotSheet> drawConditions(const ConditionsFigure& figure, bool simulated);
/// For conditions with captured trains: draws these instead of means.
[[nodiscard]] std::unique_ptr<PlotSheet> drawCapturedConditions(const ConditionsFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawPlane(const PlaneFigure& figure, bool simulated);
inline constexpr std::size_t kWaveformsShown = 8;  ///< the number of waveforms drawn; more would not fit on a page
[[nodiscard]] std::unique_ptr<PlotSheet> drawWaveforms(const WaveformsFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawConfusion(const ConfusionFigure& figure, bool simulated);
/// Draws rows that have a limit or were not evaluated; the legend names the other rows and says why.
[[nodiscard]] std::unique_ptr<PlotSheet> drawExposure(const ExposureFigure& figure, bool simulated);
[[nodiscard]] QString exposureLegend(const ExposureFigure& figure);
[[nodiscard]] std::unique_ptr<PlotSheet> drawTimeline(const TimelineFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawCalibration(const CalibrationFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawTransitions(const TransitionsFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawCurves(const CurvesFigure& figure, bool simulated);

/// Returns the indices of visible points of a long series: of each of `keep` stretches its extremes in their order, and
/// a gap if the stretch has one. Returns all indices if there are fewer.
[[nodiscard]] std::vector<std::size_t> visiblePoints(std::span<const double> values, std::size_t keep);

/// Returns a sheet with only the sentence `why`.
[[nodiscard]] std::unique_ptr<PlotSheet> emptySheet(const QString& why, bool simulated);

// Joins the texts of a drawn SVG. Qt splits a text where another font supplies a character, and places the next part
// for our fonts. With a reader's other fonts, a number could be separated from its minus.

/// `svg`: output of QSvgGenerator. Joins each text to the text that ends at its beginning, and adds the names of fonts
/// that can replace ours elsewhere.
[[nodiscard]] QString withWholeTexts(const QString& svg);

// Computes how far the axis of a drawing must extend.

/// The smallest range with all finite values that were included.
struct Reach {
    double low = kUnknown, high = kUnknown;
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    [[nodiscard]] bool known() const { return std::isfinite(low); }
    /// Returns 1 if no value is known.
    [[nodiscard]] double magnitude() const { return known() ? std::max(std::abs(low), std::abs(high)) : 1; }
};

}  // namespace tacto
