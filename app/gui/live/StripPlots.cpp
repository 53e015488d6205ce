#include "app/gui/live/StripPlots.h"

#include <algorithm>

#include "app/gui/live/StripIndex.h"
#include "app/gui/look/Look.h"
#include "app/gui/look/PlotPicture.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kMaxTaxels = TapSample::kMaxChannels;
constexpr double kGapSteps = 2.5;  // of a stream's own step: beyond, a sample is missing
constexpr double kFrameGap_s = 0.1;
// How much of the height each strip gets.
constexpr double kHeights[] = {1.3, 0.8, 0.9, 1.2, 1, 1.1};

QColor axisColour(std::size_t axis) {
    const auto& c = colours();
    const QColor all[] = {c.voltage, c.current, c.math};
    return all[axis % 3];
}

QColor withAlpha(QColor colour, int alpha) {
    colour.setAlpha(alpha);
    return colour;
}

}  // namespace

StripPlots::StripPlots(const LiveHistory& history, QWidget* parent) : QCustomPlot(parent), history_(history) {
    setAccessibleName(tr("Live plots"));
    setToolTip(
        tr("Everything on one time axis, newest at the right. Hatched: no sample has come since. A frozen picture "
           "can be dragged, and zoomed with the wheel."));
    addPlotMenu(*this, "live");
    setNotAntialiasedElements(QCP::aeAll);
    setNoAntialiasingOnDrag(true);
    layer("overlay")->setMode(QCPLayer::lmLogical);  // nothing lies above: one buffer less to clear and to blend
    auto* unused = axisRect();
    strips_.resize(kStripCount);
    makeStrip(kAcceleration, tr("Acceleration"), 1, false);
    makeStrip(kForce, tr("Force"), 0.5, true);
    makeStrip(kTaxels, tr("Taxels"), 0, false);
    makeStrip(kSpectrum, tr("Spectrum"), 0, true);
    makeStrip(kIndices, tr("Indices"), 1, true);
    makeStrip(kTrains, tr("Trains"), 0, true);
    plotLayout()->remove(unused);
    plotLayout()->simplify();
    plotLayout()->setRowSpacing(1);
    auto* group = new QCPMarginGroup(this);
    for (std::size_t i = 0; i < strips_.size(); ++i) {
        strips_[i].axes->setMarginGroup(QCP::msLeft | QCP::msRight, group);
        plotLayout()->setRowStretchFactor(int(i), kHeights[i]);
        connect(strips_[i].axes->axis(QCPAxis::atBottom), qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this,
                &StripPlots::shareTime);
    }
    auto* time = strips_.back().axes->axis(QCPAxis::atBottom);
    time->setTickLabels(true);
    time->setLabel(tr("time (s)"));
    const auto graphIn = [&](std::size_t strip) {
        auto* axes = strips_[strip].axes;
        return new RollingGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    };
    for (std::size_t i = 0; i < 3; ++i) acceleration_.push_back(graphIn(kAcceleration));
    force_.push_back(graphIn(kForce));
    for (std::size_t i = 0; i < kMaxTaxels; ++i) taxels_.push_back(graphIn(kTaxels));
    spectrogram_ = std::make_unique<Spectrogram>(*strips_[kSpectrum].axes);
    roughness_ = graphIn(kIndices);
    pressure_ = graphIn(kIndices);
    pressure_->setDashed(true);
    auto* trains = strips_[kTrains].axes;
    auto *across = trains->axis(QCPAxis::atBottom), *up = trains->axis(QCPAxis::atLeft);
    command_ = addGraph(across, up);
    command_->setLineStyle(QCPGraph::lsStepLeft);
    delivered_ = new QCPBars(across, up);
    delivered_->setWidthType(QCPBars::wtAbsolute);
    delivered_->setWidth(3);
    for (auto** graph : {&measured_, &scoped_, &failed_}) {
        *graph = addGraph(across, up);
        (*graph)->setLineStyle(QCPGraph::lsNone);
    }
    readings_.reserve(kReadings);
    begin(false, false, "V");
}

void StripPlots::makeStrip(std::size_t index, const QString& title, double least, bool fromZero) {
    auto& strip = strips_[index];
    strip.axes = new QCPAxisRect(this);
    plotLayout()->addElement(int(index) + 1, 0, strip.axes);  // before its items: they look for it there
    strip.title = title;
    strip.least = least;
    strip.fromZero = fromZero;
    strip.axes->setMinimumSize(50, 24);
    strip.axes->setRangeDrag(Qt::Horizontal);
    strip.axes->setRangeZoom(Qt::Horizontal);
    for (const auto side : {QCPAxis::atTop, QCPAxis::atRight}) {
        strip.axes->axis(side)->setVisible(false);
        strip.axes->axis(side)->grid()->setVisible(false);
    }
    auto *bottom = strip.axes->axis(QCPAxis::atBottom), *left = strip.axes->axis(QCPAxis::atLeft);
    bottom->setTickLabels(false);
    bottom->ticker()->setTickCount(8);
    left->ticker()->setTickCount(index == kIndices || index == kForce ? 2 : 3);
    left->setNumberFormat("gb");
    left->setNumberPrecision(4);
    for (auto* axis : {bottom, left}) axis->setLayer("axes");
    strip.watermark = addWatermark(*strip.axes);
    strip.watermark->setRotation(0);
    strip.hatch = new QCPItemRect(this);
    for (auto* corner : {strip.hatch->topLeft, strip.hatch->bottomRight}) {
        corner->setAxisRect(strip.axes);
        corner->setAxes(bottom, left);
        corner->setTypeX(QCPItemPosition::ptPlotCoords);
        corner->setTypeY(QCPItemPosition::ptAxisRectRatio);
    }
    strip.hatch->setClipAxisRect(strip.axes);
    strip.hatch->setPen(Qt::NoPen);
    strip.hatch->setVisible(false);
    strip.caption = new StripCaption(*strip.axes);
}

void StripPlots::begin(bool simulatedTouch, bool simulatedSource, const QString& commandUnit) {
    for (std::size_t i = 0; i < strips_.size(); ++i)
        strips_[i].simulated = i == kTrains ? simulatedSource : simulatedTouch;
    setFrozen(false);
    readings_.clear();
    nextReading_ = 0;
    for (const auto index : {kAcceleration, kForce, kTaxels}) {
        auto& strip = strips_[index];
        const auto* info = history_.info(streamOf(index));
        strip.present = info != nullptr;
        if (info == nullptr) continue;
        const auto symbol = symbolOf(info->unit);
        strip.unit = QString::fromUtf8(symbol.data(), qsizetype(symbol.size())).replace("m/s2", "m/s²");
        strip.scale = info->unit == StreamUnit::Pascal ? 1e-3 : 1;
        if (info->unit == StreamUnit::Pascal) strip.unit = "kPa";
    }
    spectrogram_->begin(history_.info(StreamKind::Acceleration));
    strips_[kSpectrum].present = spectrogram_->top_hz() > 0;
    strips_[kSpectrum].unit = "Hz";
    strips_[kIndices].present = !history_.streams().empty();
    strips_[kTrains].unit = commandUnit;
    strips_[kTaxels].fromZero = strips_[kTaxels].unit == "kPa";  // counts stand anywhere
    attach();
    colour();
    layOut();
}

void StripPlots::attach() {
    const auto give = [&](StreamKind kind, std::vector<RollingGraph*>& graphs, const Strip& strip) {
        const auto* series = shown().samples(kind);
        const auto* info = shown().info(kind);
        for (std::size_t c = 0; c < graphs.size(); ++c) {
            const bool has = series != nullptr && c < series->channels();
            graphs[c]->setScale(strip.scale);
            graphs[c]->show(has ? series : nullptr, c, has ? kGapSteps / info->rate_hz : 1);
            graphs[c]->setVisible(has);
        }
    };
    give(StreamKind::Acceleration, acceleration_, strips_[kAcceleration]);
    give(StreamKind::Force, force_, strips_[kForce]);
    give(StreamKind::Taxels, taxels_, strips_[kTaxels]);
    roughness_->show(&shown().frames(), LiveHistory::kRoughness, kFrameGap_s);
    pressure_->show(&shown().frames(), LiveHistory::kPressure, kFrameGap_s);
}

void StripPlots::layOut() {
    for (auto& strip : strips_) {
        strip.axes->setVisible(strip.present);
        strip.axes->setSizeConstraintRect(QCPLayoutElement::scrOuterRect);
        const int line = QFontMetrics(strip.caption->font()).height();
        strip.axes->setMinimumMargins(strip.present ? QMargins(4, line + 2, 8, 2) : QMargins());
        strip.axes->setMinimumSize(strip.present ? 50 : 0, strip.present ? line * 3 : 0);
        strip.axes->setMaximumSize(QWIDGETSIZE_MAX, strip.present ? QWIDGETSIZE_MAX : 1);
        strip.caption->setVisible(strip.present);
        strip.watermark->setVisible(strip.present && strip.simulated);
        strip.hatch->setVisible(false);
    }
}

void StripPlots::colour() {
    const auto& c = colours();
    stylePlot(*this);
    auto small = QApplication::font();
    if (small.pointSizeF() > 0) small.setPointSizeF(small.pointSizeF() * 0.9);
    auto faint = QApplication::font();
    if (faint.pointSizeF() > 0) faint.setPointSizeF(faint.pointSizeF() * 1.5);
    faint.setBold(true);
    const std::vector<QColor> keys[kStripCount] = {
        {axisColour(0), axisColour(1), axisColour(2)},
        {c.text},
        {c.voltage},
        {c.quiet},
        {conditionLook("rough-high").color, conditionLook("smooth-high").color},
        {c.quiet, c.voltage, c.text, c.math, c.amber}};
    for (std::size_t i = 0; i < strips_.size(); ++i) {
        auto& strip = strips_[i];
        strip.watermark->setFont(faint);
        strip.caption->setFont(small);
        strip.caption->setWord(0, strip.unit.isEmpty() ? strip.title : QString("%1 (%2)").arg(strip.title, strip.unit));
        strip.caption->setColour(0, c.text);
        for (std::size_t k = 0; k < keys[i].size(); ++k) strip.caption->setColour(k + 1, keys[i][k]);
        strip.hatch->setBrush(QBrush(withAlpha(c.quiet, 90), Qt::BDiagPattern));
    }
    for (std::size_t i = 0; i < acceleration_.size(); ++i) acceleration_[i]->setPen(QPen(axisColour(i)));
    force_.front()->setPen(QPen(c.text));
    for (auto* taxel : taxels_) taxel->setPen(QPen(withAlpha(c.voltage, 110)));
    roughness_->setPen(QPen(keys[kIndices][0]));
    pressure_->setPen(QPen(keys[kIndices][1]));
    command_->setPen(QPen(c.quiet, 1));
    delivered_->setPen(Qt::NoPen);
    delivered_->setBrush(c.voltage);
    measured_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(c.text), Qt::NoBrush, 7));
    scoped_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDiamond, QPen(c.math, 1.5), Qt::NoBrush, 9));
    failed_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCross, QPen(c.amber, 1.5), Qt::NoBrush, 8));
    write();
}

void StripPlots::changeEvent(QEvent* event) {
    if ((event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) && spectrogram_) {
        colour();
        layOut();
    }
    QCustomPlot::changeEvent(event);
}

}  // namespace tacto::gui
