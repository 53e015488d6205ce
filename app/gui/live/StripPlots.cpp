#include "app/gui/live/StripPlots.h"

#include <algorithm>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

enum StripIndex : std::size_t { kAcceleration, kForce, kTaxels, kSpectrum, kIndices, kTrains };
constexpr std::size_t kMostTaxels = TapSample::kMaxChannels;

QColor axisColour(std::size_t axis) {
    const auto& c = colours();
    const QColor all[] = {c.voltage, c.current, c.math};
    return all[axis % 3];
}

/// The next of 1, 2, 5 times a power of ten at or above `value`: an axis that steps instead of breathing.
double stepAbove(double value) {
    if (!(value > 0)) return 1;
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0, 10.0}) {
        if (step * decade >= value * 0.999) return step * decade;
    }
    return 10 * decade;
}

}  // namespace

StripPlots::StripPlots(const LiveHistory& history, QWidget* parent) : QCustomPlot(parent), history_(history) {
    setAccessibleName(tr("Live plots"));
    setToolTip(tr("Everything on one time axis, newest at the right. The window's length is chosen below."));
    setNotAntialiasedElements(QCP::aeAll);
    setNoAntialiasingOnDrag(true);
    plotLayout()->setRowSpacing(2);
    auto* unused = axisRect();
    auto* group = new QCPMarginGroup(this);
    strips_ = {
        makeStrip(tr("Acceleration"), "m/s²", 0.5), makeStrip(tr("Force"), "N", 0.5), makeStrip(tr("Taxels"), "Pa", 0),
        makeStrip(tr("Spectrum"), "Hz", 0),         makeStrip(tr("R, P"), "", 1),     makeStrip(tr("Trains"), "V", 10)};
    plotLayout()->remove(unused);
    plotLayout()->simplify();
    for (auto& strip : strips_) strip.axes->setMarginGroup(QCP::msLeft | QCP::msRight, group);
    plotLayout()->setRowStretchFactor(int(kForce), 0.7);
    strips_[kSpectrum].axes->axis(QCPAxis::atLeft)->setNumberFormat("f");
    strips_[kSpectrum].axes->axis(QCPAxis::atLeft)->setNumberPrecision(0);
    strips_.back().axes->axis(QCPAxis::atBottom)->setTickLabels(true);
    strips_.back().axes->axis(QCPAxis::atBottom)->setLabel(tr("time (s)"));
    const auto graphIn = [&](std::size_t strip) {
        auto* axes = strips_[strip].axes;
        return new RollingGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    };
    for (std::size_t i = 0; i < 3; ++i) acceleration_.push_back(graphIn(kAcceleration));
    force_.push_back(graphIn(kForce));
    for (std::size_t i = 0; i < kMostTaxels; ++i) taxels_.push_back(graphIn(kTaxels));
    spectrogram_ = std::make_unique<Spectrogram>(*strips_[kSpectrum].axes);
    roughness_ = graphIn(kIndices);
    pressure_ = graphIn(kIndices);
    roughness_->show(&history_.frames(), LiveHistory::kRoughness);
    pressure_->show(&history_.frames(), LiveHistory::kPressure);
    auto* trains = strips_[kTrains].axes;
    commanded_ = new QCPBars(trains->axis(QCPAxis::atBottom), trains->axis(QCPAxis::atLeft));
    commanded_->setWidthType(QCPBars::wtAbsolute);
    commanded_->setWidth(2);
    measured_ = addGraph(trains->axis(QCPAxis::atBottom), trains->axis(QCPAxis::atLeft));
    measured_->setLineStyle(QCPGraph::lsNone);
    refused_ = addGraph(trains->axis(QCPAxis::atBottom), trains->axis(QCPAxis::atLeft));
    refused_->setLineStyle(QCPGraph::lsNone);
    begin(false);
}

StripPlots::Strip StripPlots::makeStrip(const QString& title, const QString& unit, double least) {
    auto* axes = new QCPAxisRect(this);
    plotLayout()->addElement(axes);  // before its items: they look for it there
    axes->setMinimumMargins(QMargins(4, 2, 8, 2));
    for (const auto side : {QCPAxis::atTop, QCPAxis::atRight}) {
        axes->axis(side)->setVisible(false);
        axes->axis(side)->grid()->setVisible(false);
    }
    auto* bottom = axes->axis(QCPAxis::atBottom);
    bottom->setTickLabels(false);
    auto* left = axes->axis(QCPAxis::atLeft);
    left->ticker()->setTickCount(3);
    left->setNumberFormat("gb");
    left->setNumberPrecision(3);
    for (auto* axis : {bottom, left}) axis->setLayer("axes");
    return {axes, title, unit, addWatermark(*axes), least};
}

void StripPlots::begin(bool simulated) {
    simulated_ = simulated;
    for (auto* graph : acceleration_) graph->show(nullptr, 0);
    for (auto* graph : force_) graph->show(nullptr, 0);
    for (auto* graph : taxels_) graph->show(nullptr, 0);
    const auto attach = [&](StreamKind kind, std::vector<RollingGraph*>& graphs, Strip& strip) {
        const auto* series = history_.samples(kind);
        const auto* info = history_.info(kind);
        if (series == nullptr) return;
        strip.unit = QString::fromUtf8(symbolOf(info->unit).data(), qsizetype(symbolOf(info->unit).size()));
        strip.unit.replace("m/s2", "m/s²");
        const double scale = strip.unit == "Pa" ? 1e-3 : 1;
        if (strip.unit == "Pa") strip.unit = "kPa";
        for (auto* graph : graphs) graph->setScale(scale);
        for (std::size_t c = 0; c < std::min(series->channels(), graphs.size()); ++c) graphs[c]->show(series, c);
    };
    attach(StreamKind::Acceleration, acceleration_, strips_[kAcceleration]);
    attach(StreamKind::Force, force_, strips_[kForce]);
    attach(StreamKind::Taxels, taxels_, strips_[kTaxels]);
    spectrogram_->begin(history_.info(StreamKind::Acceleration));
    colour();
}

void StripPlots::setWindow(double seconds) { window_s_ = seconds; }

void StripPlots::setCommandUnit(const QString& unit) {
    strips_[kTrains].unit = unit;
    colour();
}

void StripPlots::colour() {
    const auto& c = colours();
    stylePlot(*this);
    for (auto& strip : strips_) {
        auto* left = strip.axes->axis(QCPAxis::atLeft);
        left->setLabel(strip.unit.isEmpty() ? strip.title : QString("%1\n(%2)").arg(strip.title, strip.unit));
        strip.watermark->setVisible(simulated_);
        auto font = strip.watermark->font();
        font.setPointSizeF(15);
        strip.watermark->setFont(font);
        strip.watermark->setRotation(0);
    }
    for (std::size_t i = 0; i < acceleration_.size(); ++i) acceleration_[i]->setPen(QPen(axisColour(i)));
    force_.front()->setPen(QPen(c.text));
    for (std::size_t i = 0; i < taxels_.size(); ++i) {
        auto colour = axisColour(i);
        colour.setHsvF(float(std::fmod(double(i) * 0.13 + 0.5, 1.0)), 0.55F,
                       currentTheme() == Theme::Dark ? 0.9F : 0.65F);
        taxels_[i]->setPen(QPen(colour));
    }
    roughness_->setPen(QPen(conditionLook("rough-high").color));
    pressure_->setPen(QPen(conditionLook("smooth-high").color));
    commanded_->setPen(QPen(c.voltage));
    commanded_->setBrush(c.voltage);
    measured_->setPen(QPen(c.text));
    measured_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, c.text, Qt::NoBrush, 6));
    refused_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCross, c.fault, 7));
}

void StripPlots::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
        if (commanded_ != nullptr) colour();
    }
    QCustomPlot::changeEvent(event);
}

void StripPlots::fit(Strip& strip, std::span<RollingGraph* const> graphs, bool fromZero) {
    QCPRange all;
    bool any = false;
    for (const auto* graph : graphs) {
        const auto range = graph->extent(history_.now_s() - window_s_);
        if (!range) continue;
        if (any)
            all.expand(*range);
        else
            all = *range;
        any = true;
    }
    double reach = std::max(strip.least, any ? std::max(std::abs(all.lower), std::abs(all.upper)) : 1.0);
    reach = stepAbove(reach);
    const double bottom = fromZero && !(any && all.lower < -0.02 * reach) ? -0.05 * reach : -reach;
    strip.axes->axis(QCPAxis::atLeft)->setRange(bottom, reach * 1.05);
}

void StripPlots::drawTrains(double from_s) {
    QVector<double> at, amplitude, measuredAt, measured, refusedAt, refused;
    double most = strips_[kTrains].least;
    for (const auto& train : history_.trains()) {
        const double t = toSeconds(train.onset);
        if (t < from_s || train.isCheck) continue;
        if (train.outcome == TrainOutcome::Delivered) {
            at << t;
            amplitude << train.amplitude;
            if (std::isfinite(train.measured)) {
                measuredAt << t;
                measured << train.measured;
            }
            most = std::max({most, train.amplitude, std::isfinite(train.measured) ? train.measured : 0});
        } else {
            refusedAt << t;
            refused << train.amplitude;
        }
    }
    commanded_->setData(at, amplitude, true);
    measured_->setData(measuredAt, measured, true);
    refused_->setData(refusedAt, refused, true);
    strips_[kTrains].axes->axis(QCPAxis::atLeft)->setRange(0, stepAbove(most) * 1.1);
}

void StripPlots::redraw() {
    if (frozen_) return;
    const QCPRange window(history_.now_s() - window_s_, history_.now_s());
    for (auto& strip : strips_) strip.axes->axis(QCPAxis::atBottom)->setRange(window);
    fit(strips_[kAcceleration], acceleration_, false);
    fit(strips_[kForce], force_, true);
    fit(strips_[kTaxels], taxels_, true);
    strips_[kIndices].axes->axis(QCPAxis::atLeft)->setRange(-0.05, 1.05);
    strips_[kSpectrum].axes->axis(QCPAxis::atLeft)->setRange(0, 1000);
    if (const auto* series = history_.samples(StreamKind::Acceleration)) spectrogram_->update(*series, window);
    drawTrains(window.lower);
    replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace tacto::gui
