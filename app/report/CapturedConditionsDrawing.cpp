// The paper's figure from captures: one lettered lane per condition with its trains as captured, and next to it the
// pulse of the first train.
#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

using CapturedLane = ConditionsFigure::Condition;

constexpr int kCapturedLaneHeight = 78;
constexpr int kCapturedAxisHeight = 34;

/// Puts all lanes on the same scales, so that heights and distances can be compared.
struct LaneScales {
    double span_s = 0;
    double reach_v = 0;
    double pulseBegin_s = 0, pulseEnd_s = 0;
};

/// Returns the samples from the first to the last that stands out, with a margin.
std::pair<std::size_t, std::size_t> pulseSpan(const CapturedLane& lane) {
    double peak = 0;
    for (const double v : lane.pulse_v) peak = std::isfinite(v) ? std::max(peak, std::abs(v)) : peak;
    const auto stands = [peak](double v) { return std::abs(v) > 0.1 * peak; };
    const auto first = std::find_if(lane.pulse_v.begin(), lane.pulse_v.end(), stands);
    const auto last = std::find_if(lane.pulse_v.rbegin(), lane.pulse_v.rend(), stands).base();
    if (first >= last) return {0, lane.pulse_v.size()};
    const auto margin = std::max<std::ptrdiff_t>(5, (last - first) / 5);
    return {static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - lane.pulse_v.begin() - margin)),
            static_cast<std::size_t>(
                std::min<std::ptrdiff_t>(std::ssize(lane.pulse_v), last - lane.pulse_v.begin() + margin))};
}

LaneScales scalesOf(const std::vector<CapturedLane>& lanes) {
    LaneScales scales;
    for (const auto& lane : lanes) {
        for (const auto& train : lane.trains) {
            if (std::isfinite(train.onset_s)) scales.span_s = std::max(scales.span_s, train.onset_s);
            for (const double v : {train.low_v, train.high_v}) {
                if (std::isfinite(v)) scales.reach_v = std::max(scales.reach_v, std::abs(v));
            }
        }
        if (lane.pulse_v.empty() || !(lane.pulseRate_hz > 0)) continue;
        const auto [begin, end] = pulseSpan(lane);
        scales.pulseBegin_s = std::min(scales.pulseBegin_s, lane.pulseStart_s + double(begin) / lane.pulseRate_hz);
        scales.pulseEnd_s = std::max(scales.pulseEnd_s, lane.pulseStart_s + double(end) / lane.pulseRate_hz);
    }
    if (!(scales.span_s > 0)) scales.span_s = 1;
    if (!(scales.reach_v > 0)) scales.reach_v = 1;
    if (!(scales.pulseEnd_s > scales.pulseBegin_s)) scales.pulseEnd_s = scales.pulseBegin_s + 1e-3;
    return scales;
}

class CapturedSheet {
public:
    CapturedSheet(const std::vector<CapturedLane>& lanes, bool simulated)
        : lanes_(lanes),
          scales_(scalesOf(lanes)),
          sheet_(std::make_unique<PlotSheet>(
              kSheetWidth, static_cast<int>(lanes.size()) * kCapturedLaneHeight + kCapturedAxisHeight + 8, simulated)),
          left_(new QCPMarginGroup(&sheet_->plot())),
          right_(new QCPMarginGroup(&sheet_->plot())) {}

    std::unique_ptr<PlotSheet> draw() {
        for (std::size_t i = 0; i < lanes_.size(); ++i) {
            const bool last = i + 1 == lanes_.size();
            drawTrains(static_cast<int>(i), lanes_[i], last);
            drawPulse(static_cast<int>(i), lanes_[i], last);
        }
        sheet_->plot().plotLayout()->setColumnStretchFactor(0, 2.6);
        sheet_->plot().plotLayout()->setRowSpacing(0);
        return std::move(sheet_);
    }

private:
    QCPAxisRect* addLaneAxes(int row, int column, bool labelled) {
        auto* axes = sheet_->addAxes(row, column);
        axes->setMinimumMargins(QMargins(4, 19, 8, 3));
        axes->setMarginGroup(QCP::msLeft, column == 0 ? left_ : right_);
        const int height = kCapturedLaneHeight + (labelled ? kCapturedAxisHeight : 0);
        axes->setMinimumSize(40, height);
        axes->setMaximumSize(QWIDGETSIZE_MAX, height);
        axes->setSizeConstraintRect(QCPLayoutElement::scrOuterRect);
        auto* level = axes->axis(QCPAxis::atLeft);
        level->setRange(-1.12 * scales_.reach_v, 1.12 * scales_.reach_v);
        level->setTicker(
            QSharedPointer<PlainTicker>::create(3, roundBelow(scales_.reach_v), QStringLiteral("\u202fV")));
        level->setTickLabels(column == 0);
        axes->axis(QCPAxis::atBottom)->setTickLabels(labelled);
        return axes;
    }

    void drawTrains(int row, const CapturedLane& lane, bool labelled) {
        auto* axes = addLaneAxes(row, 0, labelled);
        auto* time = axes->axis(QCPAxis::atBottom);
        time->setRange(-0.03 * scales_.span_s, 1.04 * scales_.span_s);
        if (labelled) time->setLabel(axisTitle("Time", "s"));
        auto* name =
            sheet_->addNote(axes, lane.letter + "\u2002" + lane.name, {0, -0.02}, Qt::AlignLeft | Qt::AlignBottom);
        name->setFont(textFont(10, true));
        if (lane.trains.empty()) {
            sheet_->addNote(axes, "not captured", {0.5, 0.5})->setColor(ink::kQuiet);
            return;
        }
        const QString numbers = spreadText(lane.amplitude_v.mean, lane.amplitude_v.sd, "V") + ";  " +
                                spreadText(lane.interval_s.mean, lane.interval_s.sd, "s");
        sheet_->addNote(axes, numbers, {1, -0.02}, Qt::AlignRight | Qt::AlignBottom);
        sheet_->watermark(axes, 14);
        auto* rest = new QCPGraph(time, axes->axis(QCPAxis::atLeft));
        rest->setPen(QPen(ink::kAxis, 0.8));
        rest->setData({time->range().lower, time->range().upper}, {0, 0}, true);
        // At this scale a train is too short to see, so it is drawn as a stem from its lowest to its highest sample.
        auto* stems = new QCPGraph(time, axes->axis(QCPAxis::atLeft));
        const auto style = conditionStyle(lane.name, row);
        stems->setPen(QPen(style.color, 1.6, Qt::SolidLine, Qt::FlatCap));
        stems->setAdaptiveSampling(false);
        QVector<double> x, y;
        for (const auto& train : lane.trains) {
            if (!std::isfinite(train.onset_s) || train.onset_s > scales_.span_s) continue;
            x << train.onset_s << train.onset_s << train.onset_s;
            y << train.low_v << train.high_v << kUnknown;
        }
        stems->setData(x, y, true);
    }

    void drawPulse(int row, const CapturedLane& lane, bool labelled) {
        auto* axes = addLaneAxes(row, 1, labelled);
        auto* time = axes->axis(QCPAxis::atBottom);
        const AxisUnit unit = axisUnit(scales_.pulseEnd_s - scales_.pulseBegin_s, "s");
        time->setRange(scales_.pulseBegin_s * unit.factor, scales_.pulseEnd_s * unit.factor);
        time->setTicker(QSharedPointer<PlainTicker>::create(3));
        if (labelled) time->setLabel(axisTitle("First pulse", unit.unit));
        if (lane.pulse_v.empty() || !(lane.pulseRate_hz > 0)) {
            sheet_->addNote(axes, "not captured", {0.5, 0.5})->setColor(ink::kQuiet);
            return;
        }
        sheet_->watermark(axes, 10);
        const auto [begin, end] = pulseSpan(lane);
        const auto shown = std::span(lane.pulse_v).subspan(begin, end - begin);
        QVector<double> x, y;
        for (const std::size_t i : visiblePoints(shown, 200)) {
            x << (lane.pulseStart_s + double(begin + i) / lane.pulseRate_hz) * unit.factor;
            y << shown[i];
        }
        auto* graph = new QCPGraph(time, axes->axis(QCPAxis::atLeft));
        graph->setPen(QPen(conditionStyle(lane.name, row).color, 1.2));
        graph->setAdaptiveSampling(false);
        graph->setData(x, y, true);
    }

    const std::vector<CapturedLane>& lanes_;
    const LaneScales scales_;
    std::unique_ptr<PlotSheet> sheet_;
    QCPMarginGroup* left_;  // owned by the plot
    QCPMarginGroup* right_;
};

}  // namespace

std::unique_ptr<PlotSheet> drawCapturedConditions(const ConditionsFigure& figure, bool simulated) {
    return CapturedSheet(figure.conditions, simulated).draw();
}

}  // namespace tacto
