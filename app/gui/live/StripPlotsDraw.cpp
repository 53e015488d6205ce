// What StripPlots does for every picture.
#include <algorithm>
#include <cmath>

#include "app/gui/live/StripIndex.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/look/Look.h"
#include "core/acquisition/StreamHealth.h"

namespace tacto::gui {

namespace {

constexpr double kUnderZero = 0.06;  // of the height, so that a trace at zero is seen
constexpr int kTextEvery = 4;        // pictures: as fast as one reads

/// The next of 1, 2, 5 times a power of ten at or above `value`: an axis that steps instead of breathing.
double stepAbove(double value) {
    if (!(value > 0)) return 1;
    const double decade = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0, 10.0}) {
        if (step * decade >= value * 0.999) return step * decade;
    }
    return 10 * decade;
}

/// The range that `wanted` needs in whole steps; the one `before` stays as long as it fits and is not too wide.
QCPRange steady(const QCPRange& before, const QCPRange& wanted) {
    const double step = stepAbove(wanted.size() / 4);
    const QCPRange whole(std::floor(wanted.lower / step) * step, std::ceil(wanted.upper / step) * step);
    const bool fits = before.lower <= wanted.lower && before.upper >= wanted.upper;
    return fits && wanted.size() > 0.4 * before.size() ? before : whole;
}

QString indexText(const QString& name, float value) {
    return QString("%1 %2").arg(name, std::isfinite(value) ? QString::number(double(value), 'f', 2) : QString("–"));
}

}  // namespace

void StripPlots::setWindow(double seconds) {
    window_s_ = seconds;
    if (frozen_) shareTime(QCPRange(frozen_->now_s() - seconds, frozen_->now_s()));
}

void StripPlots::setFrozen(bool frozen) {
    if (frozen == (frozen_ != nullptr)) return;
    frozen_ = frozen ? std::make_unique<LiveHistory>(history_) : nullptr;
    setInteraction(QCP::iRangeDrag, frozen);
    setInteraction(QCP::iRangeZoom, frozen);
    attach();
}

void StripPlots::addScopeReading(double t_s, double amplitude) {
    if (readings_.size() < kReadings)
        readings_.emplace_back(t_s, amplitude);
    else
        readings_[nextReading_++ % kReadings] = QCPGraphData(t_s, amplitude);
}

QCPRange StripPlots::shownTime() const { return strips_.back().axes->axis(QCPAxis::atBottom)->range(); }

bool StripPlots::has(StreamKind kind) const {
    const auto index = kind == StreamKind::Force ? kForce : kind == StreamKind::Taxels ? kTaxels : kAcceleration;
    return strips_[index].present;
}

bool StripPlots::stale(StreamKind kind) const {
    const auto index = kind == StreamKind::Force ? kForce : kind == StreamKind::Taxels ? kTaxels : kAcceleration;
    return strips_[index].present && strips_[index].hatch->visible();
}

namespace {
template <class Container>
std::vector<double> valuesOf(const Container& data) {
    std::vector<double> values;
    for (auto point = data.constBegin(); point != data.constEnd(); ++point) values.push_back(point->value);
    return values;
}
}  // namespace

std::vector<double> StripPlots::shownTrains() const { return valuesOf(*delivered_->data()); }
std::vector<double> StripPlots::shownCommand() const { return valuesOf(*command_->data()); }
std::vector<double> StripPlots::scopeReadings() const { return valuesOf(*scoped_->data()); }

void StripPlots::redraw() {
    if (frozen_) return;
    // In whole pixels: a column keeps its samples while it moves, and the trace does not shimmer.
    const double pixel = window_s_ / std::max(1, strips_.back().axes->width());
    // A picture that is not full yet fills from the left.
    const double now = std::max(std::floor(history_.now_s() / pixel) * pixel, history_.began_s() + window_s_);
    shareTime(QCPRange(now - window_s_, now));
    if (frame_++ % kTextEvery == 0) write();
    replot(QCustomPlot::rpQueuedReplot);
}

void StripPlots::shareTime(const QCPRange& time) {
    if (std::exchange(sharing_, true)) return;
    for (auto& strip : strips_) strip.axes->axis(QCPAxis::atBottom)->setRange(time);
    fit(strips_[kAcceleration], acceleration_, time);
    fit(strips_[kForce], force_, time);
    fit(strips_[kTaxels], taxels_, time);
    strips_[kIndices].axes->axis(QCPAxis::atLeft)->setRange(-0.08, 1.08);
    if (const auto* series = shown().samples(StreamKind::Acceleration);
        series != nullptr && spectrogram_->top_hz() > 0) {
        strips_[kSpectrum].axes->axis(QCPAxis::atLeft)->setRange(0, spectrogram_->top_hz());
        spectrogram_->update(*series, time, std::max(50, strips_[kSpectrum].axes->width() / 2));
    }
    for (const auto index : {kAcceleration, kForce, kTaxels})
        hatch(strips_[index], shown().samples(streamOf(index)), shown().now_s());
    drawCommand(time);
    drawTrains(time);
    sharing_ = false;
}

void StripPlots::fit(Strip& strip, std::span<RollingGraph* const> graphs, const QCPRange& time) {
    if (!strip.present) return;
    QCPRange all;
    bool any = false;
    for (const auto* graph : graphs) {
        if (!graph->visible()) continue;
        const auto range = graph->extent(time);
        if (!range) continue;
        if (any)
            all.expand(*range);
        else
            all = *range;
        any = true;
    }
    if (!any) return;
    if (strip.fromZero) all.expand(0);
    const double room = std::max({0.06 * all.size(), (strip.least - all.size()) / 2, 1e-9});
    const bool up = strip.fromZero && all.lower > -0.05 * all.upper;  // noise about zero is no sign
    all = up ? QCPRange(0, all.upper + room) : QCPRange(all.lower - room, all.upper + room);
    auto* axis = strip.axes->axis(QCPAxis::atLeft);
    auto range = steady(up ? QCPRange(0, axis->range().upper) : axis->range(), all);
    if (up) range.lower = -kUnderZero * range.upper;
    if (range != axis->range()) axis->setRange(range);
}

void StripPlots::hatch(Strip& strip, const Series* series, double now_s) {
    const bool stale =
        strip.present && series != nullptr && (series->empty() || now_s - series->newest() > StreamHealth::kStale_s);
    strip.hatch->setVisible(stale);
    if (!stale) return;
    strip.hatch->topLeft->setCoords(series->empty() ? now_s - LiveHistory::kKept_s : series->newest(), 0);
    strip.hatch->bottomRight->setCoords(now_s, 1);
}

void StripPlots::drawCommand(const QCPRange& time) {
    // Volts, or what they come to in milliamps through the impedance of the time.
    const bool milliamps = strips_[kTrains].unit == "mA";
    const auto& commands = shown().commands();
    at_.clear();
    value_.clear();
    std::size_t first = commands.firstFrom(time.lower);
    if (first > 0) --first;
    for (std::size_t i = first; i < commands.size() && commands.time(i) <= time.upper; ++i) {
        const double volts = double(commands.value(i, LiveHistory::kAmplitude_v));
        const double value = milliamps ? 1e3 * volts / double(commands.value(i, LiveHistory::kImpedance_ohm)) : volts;
        // A step line needs its corners only.
        if (!value_.isEmpty() && (value == value_.back() || (std::isnan(value) && std::isnan(value_.back())))) continue;
        at_ << commands.time(i);
        value_ << value;
    }
    if (!value_.isEmpty() && !std::isnan(value_.back()) && commands.newest() > at_.back()) {
        at_ << commands.newest();
        value_ << double(value_.back());
    }
    command_->setData(at_, value_, true);
}

void StripPlots::drawTrains(const QCPRange& time) {
    double most = 0;
    for (auto* list : {&at_, &value_, &measuredAt_, &measuredValue_, &failedAt_, &failedValue_}) list->clear();
    const auto& trains = shown().trains();
    for (std::size_t i = 0; i < trains.size(); ++i) {
        const auto& train = trains[i];
        const double t = toSeconds(train.onset);
        if (!time.contains(t) || train.isCheck) continue;
        if (train.outcome != TrainOutcome::Delivered) {
            failedAt_ << t;
            failedValue_ << train.amplitude;
            continue;
        }
        at_ << t;
        value_ << train.amplitude;
        most = std::max(most, train.amplitude);
        if (!std::isfinite(train.measured)) continue;
        measuredAt_ << t;
        measuredValue_ << train.measured;
        most = std::max(most, train.measured);
    }
    delivered_->setData(at_, value_, true);
    measured_->setData(measuredAt_, measuredValue_, true);
    failed_->setData(failedAt_, failedValue_, true);
    scoped_->data()->clear();
    for (const auto& reading : readings_) {
        if (time.contains(reading.key)) scoped_->data()->add(reading);
    }
    for (const auto& point : *command_->data()) {
        if (std::isfinite(point.value)) most = std::max(most, point.value);
    }
    auto* axis = strips_[kTrains].axes->axis(QCPAxis::atLeft);
    if (most > 0) axis->setRange(steady(axis->range(), QCPRange(0, most * 1.3)));
}

void StripPlots::write() {
    const auto newest = [](const Series* series, std::size_t channel) {
        return series == nullptr || series->empty() ? std::nanf("") : series->value(series->size() - 1, channel);
    };
    const QStringList axes{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
        strips_[kAcceleration].caption->setWord(1 + i, acceleration_[i]->visible() ? axes[int(i)] : QString());
    }
    const auto* force = shown().samples(StreamKind::Force);
    // One form for all values: digits that do not jump.
    strips_[kForce].caption->setWord(1,
                                     quantityText(double(newest(force, 0)), strips_[kForce].unit, ColumnFormat{0, 2}));
    const auto* taxels = shown().samples(StreamKind::Taxels);
    strips_[kTaxels].caption->setWord(1, taxels == nullptr ? QString() : tr("%1 of them").arg(taxels->channels()));
    strips_[kSpectrum].caption->setWord(1, spectrogram_->scaleText());
    const auto& frames = shown().frames();
    strips_[kIndices].caption->setWord(1, indexText(tr("— roughness R"), newest(&frames, LiveHistory::kRoughness)));
    strips_[kIndices].caption->setWord(2, indexText(tr("┄ pressure P"), newest(&frames, LiveHistory::kPressure)));
    auto& trains = *strips_[kTrains].caption;
    trains.setWord(1, tr("— command"));
    trains.setWord(2, tr("▮ delivered"));
    trains.setWord(3, measuredAt_.isEmpty() ? QString() : tr("○ read back"));
    trains.setWord(4, scoped_->data()->isEmpty() ? QString() : tr("◇ oscilloscope"));
    trains.setWord(5, failedAt_.isEmpty() ? QString() : tr("✕ not delivered"));
}

}  // namespace tacto::gui
