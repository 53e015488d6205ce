// Trials in the amplitude-interval plane: the positions of the conditions, and the scatter of each.
#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

/// The trials of one condition with their mean and covariance.
struct Cluster {
    QString name;
    QVector<double> intervals, amplitudes;
    double meanInterval = 0, meanAmplitude = 0;
    double varInterval = 0, varAmplitude = 0, covariance = 0;

    [[nodiscard]] bool hasSpread() const { return intervals.size() >= 3; }
};

std::vector<Cluster> clustersOf(const PlaneFigure& figure) {
    std::vector<Cluster> clusters;
    for (const auto& trial : figure.trials) {
        if (!std::isfinite(trial.amplitude_v) || !std::isfinite(trial.interval_s)) continue;
        auto found = std::find_if(clusters.begin(), clusters.end(),
                                  [&](const Cluster& cluster) { return cluster.name == trial.condition; });
        if (found == clusters.end()) {
            found = clusters.emplace(clusters.end());
            found->name = trial.condition;
        }
        found->intervals << trial.interval_s;
        found->amplitudes << trial.amplitude_v;
    }
    for (auto& cluster : clusters) {
        const auto n = static_cast<double>(cluster.intervals.size());
        for (const double x : cluster.intervals) cluster.meanInterval += x / n;
        for (const double y : cluster.amplitudes) cluster.meanAmplitude += y / n;
        for (qsizetype i = 0; i < cluster.intervals.size() && n > 1; ++i) {
            const double dx = cluster.intervals[i] - cluster.meanInterval;
            const double dy = cluster.amplitudes[i] - cluster.meanAmplitude;
            cluster.varInterval += dx * dx / (n - 1);
            cluster.varAmplitude += dy * dy / (n - 1);
            cluster.covariance += dx * dy / (n - 1);
        }
    }
    return clusters;
}

/// Returns the ellipse around 0 that contains 95 % of a normal distribution with this covariance.
void ellipse(const Cluster& cluster, double xFactor, double yFactor, QVector<double>& x, QVector<double>& y) {
    constexpr double kRadius = 2.447746830680816;  // square root of the 95 % point of chi-squared, 2 degrees of freedom
    // Cholesky: x from one normal variable, y from that and a second.
    const double a = std::sqrt(cluster.varInterval);
    const double b = a > 0 ? cluster.covariance / a : 0;
    const double c = std::sqrt(std::max(0.0, cluster.varAmplitude - b * b));
    for (int i = 0; i <= 72; ++i) {
        const double angle = i * 2 * std::numbers::pi / 72;
        x << kRadius * a * std::cos(angle) * xFactor;
        y << kRadius * (b * std::cos(angle) + c * std::sin(angle)) * yFactor;
    }
}

double reach(const QVector<double>& values) {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
}

void drawPoints(QCPAxisRect* axes, const QVector<double>& x, const QVector<double>& y, const ConditionStyle& style,
                double size) {
    auto* points = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    points->setLineStyle(QCPGraph::lsNone);
    points->setScatterStyle(QCPScatterStyle(style.marker, QPen(style.color, 1), QBrush(Qt::NoBrush), size));
    points->setData(x, y);
}

/// Draws one condition as deviations from its mean, in suitable units.
void drawEnlarged(PlotSheet& sheet, QCPLayoutGrid* grid, int cell, const Cluster& cluster, int index) {
    auto* axes = sheet.addAxes(cell / 2, cell % 2, grid);
    auto* horizontal = axes->axis(QCPAxis::atBottom);
    auto* vertical = axes->axis(QCPAxis::atLeft);
    auto* title = sheet.addNote(axes, cluster.name, {0, -0.02}, Qt::AlignLeft | Qt::AlignBottom);
    title->setFont(textFont(10, true));
    axes->setMinimumMargins(QMargins(4, 18, 8, 4));
    if (!cluster.hasSpread()) {
        sheet.explain(axes, QString("n = %1:\ntoo few for\nan ellipse").arg(cluster.intervals.size()));
        return;
    }
    sheet.watermark(axes, 13);
    const auto style = conditionStyle(cluster.name, index);
    QVector<double> dx, dy, ex, ey;
    for (const double value : cluster.intervals) dx << value - cluster.meanInterval;
    for (const double value : cluster.amplitudes) dy << value - cluster.meanAmplitude;
    ellipse(cluster, 1, 1, ex, ey);
    double xReach = std::max(reach(dx), reach(ex));
    double yReach = std::max(reach(dy), reach(ey));
    // A quantity without any variation still needs an axis.
    if (!(xReach > 1e-12 * std::abs(cluster.meanInterval))) xReach = 1e-6;
    if (!(yReach > 1e-12 * std::abs(cluster.meanAmplitude))) yReach = 1e-6;
    const AxisUnit xUnit = axisUnit(xReach, "s");
    const AxisUnit yUnit = axisUnit(yReach, "V");
    for (auto* values : {&dx, &ex}) {
        for (double& value : *values) value *= xUnit.factor;
    }
    for (auto* values : {&dy, &ey}) {
        for (double& value : *values) value *= yUnit.factor;
    }
    horizontal->setRange(-1.12 * xReach * xUnit.factor, 1.12 * xReach * xUnit.factor);
    vertical->setRange(-1.12 * yReach * yUnit.factor, 1.12 * yReach * yUnit.factor);
    horizontal->setLabel(axisTitle("Δ interval", xUnit.unit));
    vertical->setLabel(axisTitle("Δ amplitude", yUnit.unit));
    for (auto* axis : {horizontal, vertical}) {
        axis->setLabelFont(textFont(9));
        axis->setTickLabelFont(textFont(9));
    }
    horizontal->setTicker(QSharedPointer<PlainTicker>::create(3, roundBelow(1.1 * xReach * xUnit.factor)));
    vertical->setTicker(QSharedPointer<PlainTicker>::create(3, roundBelow(1.1 * yReach * yUnit.factor)));
    drawPoints(axes, dx, dy, style, 4);
    auto* curve = new QCPCurve(horizontal, vertical);
    curve->setPen(style.pen(1.5));
    curve->setData(ex, ey);
}

}  // namespace

std::unique_ptr<PlotSheet> drawPlane(const PlaneFigure& figure, bool simulated) {
    const auto clusters = clustersOf(figure);
    if (clusters.empty()) {
        return emptySheet(figure.trials.empty() ? "No trial was recorded."
                                                : "No trial has both a measured amplitude and a measured interval.",
                          simulated);
    }
    const bool enlarge = clusters.size() <= 4;
    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, 330, simulated);
    auto* axes = sheet->addAxes(0, 0);
    sheet->watermark(axes);
    double lowX = kUnknown, highX = kUnknown, lowY = kUnknown, highY = kUnknown;
    auto* legend = sheet->addLegend(1, 0, enlarge ? 2 : 4);
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const auto& cluster = clusters[i];
        const auto style = conditionStyle(cluster.name, static_cast<int>(i));
        drawPoints(axes, cluster.intervals, cluster.amplitudes, style, 6);
        auto* entry = qobject_cast<QCPGraph*>(axes->plottables().last());
        entry->setName(cluster.name.isEmpty() ? "(no condition)" : cluster.name);
        entry->addToLegend(legend);
        lowX = std::fmin(lowX, *std::min_element(cluster.intervals.begin(), cluster.intervals.end()));
        highX = std::fmax(highX, *std::max_element(cluster.intervals.begin(), cluster.intervals.end()));
        lowY = std::fmin(lowY, *std::min_element(cluster.amplitudes.begin(), cluster.amplitudes.end()));
        highY = std::fmax(highY, *std::max_element(cluster.amplitudes.begin(), cluster.amplitudes.end()));
        if (cluster.hasSpread()) {
            QVector<double> ex, ey;
            ellipse(cluster, 1, 1, ex, ey);
            for (auto& x : ex) x += cluster.meanInterval;
            for (auto& y : ey) y += cluster.meanAmplitude;
            lowX = std::min(lowX, *std::min_element(ex.begin(), ex.end()));
            highX = std::max(highX, *std::max_element(ex.begin(), ex.end()));
            lowY = std::min(lowY, *std::min_element(ey.begin(), ey.end()));
            highY = std::max(highY, *std::max_element(ey.begin(), ey.end()));
            auto* curve = new QCPCurve(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
            curve->setPen(style.pen(1.2));
            curve->setData(ex, ey);
        }
    }
    for (const auto& cluster : clusters) {
        auto* centroid = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
        centroid->setLineStyle(QCPGraph::lsNone);
        centroid->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssPlus, QPen(ink::kText, 1), Qt::NoBrush, 11));
        centroid->addData(cluster.meanInterval, cluster.meanAmplitude);
    }
    axes->axis(QCPAxis::atBottom)->setRange(padded(lowX, highX, 0.12));
    axes->axis(QCPAxis::atLeft)->setRange(padded(lowY, highY, 0.12));
    axes->axis(QCPAxis::atBottom)->setLabel(axisTitle("Interval between trains", "s"));
    axes->axis(QCPAxis::atLeft)->setLabel(axisTitle("Amplitude", "V"));
    if (enlarge) {
        auto* grid = sheet->addGrid(0, 1);
        grid->setRowSpacing(4);
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            drawEnlarged(*sheet, grid, static_cast<int>(i), clusters[i], static_cast<int>(i));
        }
        sheet->plot().plotLayout()->setColumnStretchFactor(0, 0.85);
        axes->axis(QCPAxis::atBottom)->setTicker(QSharedPointer<PlainTicker>::create(4));
    }
    PlotSheet::fitLegend(legend);
    return sheet;
}

}  // namespace tacto
