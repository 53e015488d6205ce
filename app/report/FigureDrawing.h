// FigureDrawing.h - a figure's data as a sheet of plots, and that sheet as SVG.
//
// Data that are missing or too few to draw are said in words in the figure's place; a figure is never blank.
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

/// `simulated` puts the watermark on every plot.
[[nodiscard]] std::unique_ptr<PlotSheet> drawFigure(const Figure& figure, bool simulated);

/// All that one must know to read the figure (what a bar, an ellipse, a height is), and its key number, in sentences.
[[nodiscard]] QString figureLegend(const Figure& figure);

/// An <svg> element for use inside HTML: no XML prologue, scales with its container, `title` for screen readers.
[[nodiscard]] QByteArray sheetSvg(PlotSheet& sheet, const QString& title);

// One per type; each in the file of its name.
[[nodiscard]] std::unique_ptr<PlotSheet> drawConditions(const ConditionsFigure& figure, bool simulated);
/// Conditions that come with trains: as captured, not from their means.
[[nodiscard]] std::unique_ptr<PlotSheet> drawCapturedConditions(const ConditionsFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawPlane(const PlaneFigure& figure, bool simulated);
inline constexpr std::size_t kWaveformsShown = 8;  ///< the first; more would not fit on a page
[[nodiscard]] std::unique_ptr<PlotSheet> drawWaveforms(const WaveformsFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawConfusion(const ConfusionFigure& figure, bool simulated);
/// Draws rows that have a limit or were not evaluated; its legend tells the others, and why.
[[nodiscard]] std::unique_ptr<PlotSheet> drawExposure(const ExposureFigure& figure, bool simulated);
[[nodiscard]] QString exposureLegend(const ExposureFigure& figure);
[[nodiscard]] std::unique_ptr<PlotSheet> drawTimeline(const TimelineFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawCalibration(const CalibrationFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawTransitions(const TransitionsFigure& figure, bool simulated);
[[nodiscard]] std::unique_ptr<PlotSheet> drawCurves(const CurvesFigure& figure, bool simulated);

/// Points of a long series that can be seen: `keep` stretches, of each its extremes in their order, and a gap where
/// the stretch has one. All indices when there are fewer.
[[nodiscard]] std::vector<std::size_t> visiblePoints(std::span<const double> values, std::size_t keep);

/// A sheet that holds nothing but the sentence `why`.
[[nodiscard]] std::unique_ptr<PlotSheet> emptySheet(const QString& why, bool simulated);

// Texts of a drawn SVG, each in one piece: Qt writes a text again wherever another face helps out, at a
// place that holds for the reader's faces only if they are ours, and a number must not come apart from its minus.

/// `svg`, as QSvgGenerator writes it, with each text joined to the one before that ends where it begins; the faces are
/// named with those that stand in for them elsewhere.
[[nodiscard]] QString withWholeTexts(const QString& svg);

// Computes how far a drawing's axis must go.

/// The smallest range that holds everything finite it was shown.
struct Reach {
    double low = kUnknown, high = kUnknown;
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = std::fmin(low, value);
        high = std::fmax(high, value);
    }
    [[nodiscard]] bool known() const { return std::isfinite(low); }
    /// 1 where nothing is known.
    [[nodiscard]] double magnitude() const { return known() ? std::max(std::abs(low), std::abs(high)) : 1; }
};

}  // namespace tacto
