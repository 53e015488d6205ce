#include "app/gui/live/TactilePlane.h"

#include <algorithm>
#include <cmath>

#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kTrail_s = 3;
constexpr double kHighest = 1.25;                  // largest height divided by width
constexpr double kNowSize = 21;                    // diameter in pixels
constexpr double kBesideR = 0.36, kBesideP = 0.3;  // least margins around the square
constexpr int kAroundName = 8, kBelowName = 6;     // pixels

/// A ring with a dot in its centre, six units wide as QCustomPlot expects; what lies below it stays visible.
QPainterPath target() {
    QPainterPath path;  // filled between the outlines
    for (const double radius : {3.0, 2.45, 0.85}) path.addEllipse(QPointF(), radius, radius);
    return path;
}

}  // namespace

TactilePlane::TactilePlane(QWidget* parent) : QCustomPlot(parent) {
    setAccessibleName(tr("Tactile plane"));
    setToolTip(tr("Roughness R across, pressure P up. The marks are the four conditions; the dot is now."));
    setNotAntialiasedElements(QCP::aeNone);
    layer("overlay")->setMode(QCPLayer::lmLogical);  // nothing lies above: this saves a buffer
    addPlotMenu(*this, "tactile-plane");
    connect(this, &QCustomPlot::afterLayout, this, &TactilePlane::makeRoomForNames);
    yAxis->setLabel(tr("Pressure P"));
    for (auto* axis : {xAxis, yAxis}) {
        axis->ticker()->setTickCount(3);
        axis->setNumberFormat("f");
        axis->setNumberPrecision(1);
    }
    watermark_ = addWatermark(*axisRect());
    trail_ = new QCPCurve(xAxis, yAxis);
    now_ = addGraph();
    now_->setLineStyle(QCPGraph::lsNone);
    addLayer("now", layer("main"));
    now_->setLayer("now");  // stays visible on top of a condition
    setOrigin(false, true);
    colour();
    onLookChange(*this, [this] { colour(); });
}

/// Keeps the plane from growing much higher than wide, as both axes run from 0 to 1.
void TactilePlane::resizeEvent(QResizeEvent* event) {
    // Must come first: while the plane is first shown, a later limit would cause no further resize event.
    setMaximumHeight(std::max(minimumHeight(), int(width() * kHighest)));
    QCustomPlot::resizeEvent(event);
}

/// The names of the conditions are placed outside the square, in which the point moves.
void TactilePlane::makeRoomForNames() {
    const QFontMetrics words(textFont(TextSize::Small));
    double besideR = kBesideR, besideP = kBesideP;
    // The room the axis needs on each side of 0 to 1, so that `share` of the axis lies beyond a point at `at`.
    const auto beyond = [](double share, double at) {
        return (share - std::min(at, 1 - at)) / std::max(0.1, 1 - 2 * share);
    };
    for (const auto& condition : conditions_) {
        const int wide = words.horizontalAdvance(QString::fromStdString(condition.name)) + 2 * kAroundName;
        besideR = std::max(besideR, beyond(0.5 * wide / std::max(1, axisRect()->width()), condition.R));
        besideP = std::max(
            besideP, beyond(double(words.height() + kBelowName) / std::max(1, axisRect()->height()), condition.P));
    }
    xAxis->setRange(-besideR, 1 + besideR);
    yAxis->setRange(-besideP, 1 + besideP);
}

QSize TactilePlane::sizeHint() const { return {fontMetrics().height() * 15, fontMetrics().height() * 14}; }

void TactilePlane::setConditions(const std::vector<Condition>& conditions) {
    if (conditions == conditions_) return;
    conditions_ = conditions;
    for (auto* mark : marks_) removePlottable(mark);
    for (auto* name : names_) removeItem(name);
    marks_.clear();
    names_.clear();
    for (const auto& condition : conditions_) {
        auto* mark = addGraph();
        mark->setLineStyle(QCPGraph::lsNone);
        mark->addData(condition.R, condition.P);
        marks_.push_back(mark);
        auto* name = new QCPItemText(this);
        name->setText(QString::fromStdString(condition.name));
        name->position->setCoords(condition.R, condition.P);
        name->setPositionAlignment(Qt::AlignHCenter | (condition.P < 0.5 ? Qt::AlignTop : Qt::AlignBottom));
        name->setPadding(QMargins(kAroundName, kBelowName, kAroundName, kBelowName));
        names_.push_back(name);
    }
    colour();
}

void TactilePlane::setOrigin(bool simulated, bool calibrated) {
    watermark_->setVisible(simulated);
    xAxis->setLabel(calibrated ? tr("Roughness R") : tr("Roughness R, uncalibrated"));
}

std::optional<QPointF> TactilePlane::point() const {
    if (now_->data()->isEmpty()) return std::nullopt;
    const auto& point = *now_->data()->constBegin();
    return QPointF(point.key, point.value);
}

void TactilePlane::colour() {
    stylePlot(*this);
    setMinimumSize(fontMetrics().height() * 10, fontMetrics().height() * 9);
    const auto& c = colours();
    const auto small = textFont(TextSize::Small);
    for (std::size_t i = 0; i < marks_.size(); ++i) {
        const auto style = conditionInTheme(QString::fromStdString(conditions_[i].name), int(i));
        marks_[i]->setScatterStyle(QCPScatterStyle(style.marker, QPen(style.color, 2), QBrush(style.color), 10));
        names_[i]->setColor(c.text);
        names_[i]->setFont(small);
    }
    watermark_->setFont(textFont(TextSize::Large, QFont::Bold));
    trail_->setPen(QPen(c.frame, 1.5));
    now_->setPen(Qt::NoPen);
    now_->setScatterStyle(QCPScatterStyle(target(), Qt::NoPen, c.text, kNowSize));
}

void TactilePlane::show(const Series& frames, double now_s, double roughness, double pressure, bool byHand) {
    for (auto* list : {&t_, &r_, &p_}) list->clear();
    for (auto i = byHand ? frames.size() : frames.firstFrom(now_s - kTrail_s); i < frames.size(); ++i) {
        const float R = frames.value(i, LiveHistory::kRoughness), P = frames.value(i, LiveHistory::kPressure);
        if (std::isnan(R) && r_.isEmpty()) continue;
        // NaN breaks the line while nothing was felt.
        t_ << frames.time(i);
        r_ << double(std::isnan(P) ? P : R);
        p_ << double(std::isnan(R) ? R : P);
    }
    trail_->setData(t_, r_, p_, true);
    now_->data()->clear();
    if (std::isfinite(roughness) && std::isfinite(pressure)) now_->addData(roughness, pressure);
    replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace tacto::gui

#include "moc_TactilePlane.cpp"
