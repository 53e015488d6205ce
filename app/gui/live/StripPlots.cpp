#include "app/gui/live/StripPlots.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

/// The strips from top to bottom.
enum StripIndex : std::size_t { kAcceleration, kForce, kTaxels, kSpectrum, kIndices, kTrains, kStripCount };

/// Returns the stream shown in a strip of samples; the spectrum uses the acceleration stream.
constexpr StreamKind streamOf(StripIndex strip) noexcept {
    return strip == kForce ? StreamKind::Force : strip == kTaxels ? StreamKind::Taxels : StreamKind::Acceleration;
}

constexpr std::size_t kMaxTaxels = TapSample::kMaxChannels;
constexpr double kGapSteps = 2.5;  // sample steps; after a longer time a sample is missing
constexpr double kFrameGap_s = 0.1;
constexpr int kTextEvery = 4;  // text is updated every fourth picture, as fast as one can read
// Relative heights of the strips.
constexpr double kHeights[] = {1.1, 0.6, 0.6, 1.1, 0.9, 1.7};

/// Ticks in seconds before now, which stand still while the traces move.
class AgoTicker final : public QCPAxisTicker {
protected:
    QString getTickLabel(double tick, const QLocale& locale, QChar format, int precision) override {
        const double ago = tick - tickOrigin();
        return QCPAxisTicker::getTickLabel(std::abs(ago) < 1e-9 ? 0 : ago, locale, format, precision)
            .replace('-', QChar(0x2212));
    }
};

QColor axisColour(std::size_t axis) {
    const auto& c = colours();
    const QColor all[] = {c.voltage, c.current, c.third};
    return all[axis % 3];
}

QString indexText(float value) { return decimalText(double(value), 2); }

}  // namespace

StripPlots::StripPlots(const LiveHistory& history, QWidget* parent) : QCustomPlot(parent), history_(history) {
    setAccessibleName(tr("Live plots"));
    setToolTip(
        tr("Everything on one time axis, newest at the right. Hatched: no sample has come since. A frozen picture "
           "can be dragged, and zoomed with the wheel; a double click shows all of it, Ctrl+Z the view before."));
    addPlotMenu(*this, "live");
    connect(this, &QCustomPlot::mousePress, this, &StripPlots::rememberView);
    connect(this, &QCustomPlot::mouseWheel, this, &StripPlots::rememberView);
    connect(this, &QCustomPlot::mouseDoubleClick, this, &StripPlots::fit);
    setNotAntialiasedElements(QCP::aeAll);
    setNoAntialiasingOnDrag(true);
    layer("overlay")->setMode(QCPLayer::lmLogical);  // nothing lies above: this saves a buffer
    auto* unused = axisRect();
    const std::tuple<QString, StripAxis> kinds[kStripCount] = {
        {tr("Acceleration"), {1, false, 3}},  {tr("Force"), {0.5, true, 2}}, {tr("Taxels"), {0, false, 3}},
        {tr("Spectrum"), {0, true, 3, true}}, {tr("Indices"), {1, true, 2}}, {tr("Trains"), {0, true, 3}}};
    for (const auto& [title, axis] : kinds) strips_.emplace_back(*this, int(strips_.size()) + 1, title, axis);
    plotLayout()->remove(unused);
    plotLayout()->simplify();
    plotLayout()->setRowSpacing(1);
    auto* group = new QCPMarginGroup(this);
    for (std::size_t i = 0; i < strips_.size(); ++i) {
        strips_[i].axes().setMarginGroup(QCP::msLeft | QCP::msRight, group);
        plotLayout()->setRowStretchFactor(int(i), kHeights[i]);
        connect(&strips_[i].time(), qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &StripPlots::shareTime);
    }
    strips_.back().time().setTickLabels(true);
    strips_.back().time().setLabel(tr("Seconds before now"));
    ticker_ = QSharedPointer<AgoTicker>::create();
    ticker_->setTickCount(8);
    for (auto& strip : strips_) strip.time().setTicker(ticker_);
    const auto graphIn = [&](std::size_t strip) {
        return new RollingGraph(&strips_[strip].time(), &strips_[strip].values());
    };
    for (std::size_t i = 0; i < 3; ++i) acceleration_.push_back(graphIn(kAcceleration));
    force_.push_back(graphIn(kForce));
    for (std::size_t i = 0; i < kMaxTaxels; ++i) taxels_.push_back(graphIn(kTaxels));
    spectrogram_ = std::make_unique<Spectrogram>(strips_[kSpectrum].axes());
    roughness_ = graphIn(kIndices);
    pressure_ = graphIn(kIndices);
    pressure_->setDashed(true);
    boardRoughness_ = graphIn(kIndices);
    boardPressure_ = graphIn(kIndices);
    boardPressure_->setDashed(true);
    trains_ = std::make_unique<TrainGraphs>(strips_[kTrains]);
    fault_ = new QCPItemText(this);
    placeAcross(*fault_->position, strips_[kTrains].axes());
    fault_->setClipAxisRect(&strips_[kTrains].axes());
    fault_->setLayer("axes");
    fault_->setPadding(QMargins(8, 2, 8, 2));
    fault_->setVisible(false);
    begin(false, false, "V");
    onLookChange(*this, [this] { dress(); });
}

void StripPlots::begin(bool simulatedTouch, bool simulatedSource, const QString& commandUnit) {
    for (std::size_t i = 0; i < strips_.size(); ++i)
        strips_[i].setSimulated(i == kTrains ? simulatedSource : simulatedTouch);
    setFrozen(false);
    trains_->begin();
    for (const auto index : {kAcceleration, kForce, kTaxels}) {
        auto& strip = strips_[index];
        const auto* info = history_.info(streamOf(index));
        strip.setPresent(info != nullptr);
        if (info == nullptr) continue;
        const auto symbol = symbolOf(info->unit);
        const bool pascals = info->unit == StreamUnit::Pascal;
        strip.setUnit(pascals ? QString("kPa")
                              : QString::fromUtf8(symbol.data(), qsizetype(symbol.size())).replace("m/s2", "m/s²"));
    }
    spectrogram_->begin(history_.info(StreamKind::Acceleration));
    strips_[kSpectrum].setPresent(spectrogram_->top_hz() > 0);
    strips_[kSpectrum].setUnit("Hz");
    strips_[kIndices].setPresent(!history_.streams().empty());
    strips_[kTrains].setUnit(commandUnit);
    strips_[kTaxels].setFromZero(strips_[kTaxels].unit() == "kPa");  // counts may have any offset
    attach();
    dress();
}

void StripPlots::attach() {
    const auto give = [&](StreamKind kind, std::vector<RollingGraph*>& graphs) {
        const auto* series = shown().samples(kind);
        const auto* info = shown().info(kind);
        for (std::size_t c = 0; c < graphs.size(); ++c) {
            const bool has = series != nullptr && c < series->channels();
            graphs[c]->setScale(has && info->unit == StreamUnit::Pascal ? 1e-3 : 1);
            graphs[c]->show(has ? series : nullptr, c, has ? kGapSteps / info->rate_hz : 1);
            graphs[c]->setVisible(has);
        }
    };
    give(StreamKind::Acceleration, acceleration_);
    give(StreamKind::Force, force_);
    give(StreamKind::Taxels, taxels_);
    roughness_->show(&shown().frames(), LiveHistory::kRoughness, kFrameGap_s);
    pressure_->show(&shown().frames(), LiveHistory::kPressure, kFrameGap_s);
    boardRoughness_->show(&shown().boardFrames(), LiveHistory::kBoardRoughness, kFrameGap_s);
    boardPressure_->show(&shown().boardFrames(), LiveHistory::kBoardPressure, kFrameGap_s);
}

/// Applies the current theme and text size.
void StripPlots::dress() {
    const auto& c = colours();
    stylePlot(*this);
    for (auto& strip : strips_) strip.dress();
    for (std::size_t i = 0; i < acceleration_.size(); ++i) {
        acceleration_[i]->setPen(QPen(axisColour(i)));
        strips_[kAcceleration].caption().setSample(i, QPen(axisColour(i), 2));
    }
    force_.front()->setPen(QPen(c.text));
    auto faint = c.voltage;
    faint.setAlpha(110);
    for (auto* taxel : taxels_) taxel->setPen(QPen(faint));
    marks_.colour();
    roughness_->setPen(QPen(conditionInTheme("rough-high").color));
    pressure_->setPen(QPen(conditionInTheme("smooth-high").color));
    strips_[kIndices].caption().setSample(0, QPen(roughness_->pen().color(), 2));
    strips_[kIndices].caption().setSample(1, QPen(pressure_->pen().color(), 2, Qt::DashLine));
    for (auto* graph : {boardRoughness_, boardPressure_}) graph->setPen(QPen(c.third));
    strips_[kIndices].caption().setSample(2, QPen(c.third, 2));
    trains_->colour();
    const auto faulted = stateStyle(InterlockState::Faulted);
    fault_->setFont(textFont(TextSize::Small, QFont::DemiBold));
    fault_->setBrush(faulted.ground);
    fault_->setColor(faulted.ink);
    write();
    for (auto& strip : strips_) strip.layOut();
}

void StripPlots::setWindow(double seconds) {
    window_s_ = seconds;
    if (!frozen_) return;
    whole_ = QCPRange(frozen_->now_s() - seconds, frozen_->now_s());
    fit();
}

void StripPlots::setFrozen(bool frozen) {
    if (frozen == (frozen_ != nullptr)) return;
    frozen_ = frozen ? std::make_unique<LiveHistory>(history_) : nullptr;
    frozenAt_ = QDateTime::currentDateTime();
    setInteraction(QCP::iRangeDrag, frozen);
    setInteraction(QCP::iRangeZoom, frozen);
    strips_.back().time().setLabel(frozen ? tr("Seconds before the picture was frozen") : tr("Seconds before now"));
    whole_ = shownTime();
    views_.clear();
    attach();
    emit viewChanged();
}

void StripPlots::fit() {
    if (!frozen_) return;
    rememberView();
    shareTime(whole_);
    replot(QCustomPlot::rpQueuedReplot);
}

void StripPlots::rememberView() {
    if (frozen_ && (views_.empty() || views_.back() != shownTime())) views_.push_back(shownTime());
}

/// A click that did not move the view is not an undo step.
bool StripPlots::canUndo() const {
    return frozen_ && std::ranges::any_of(views_, [this](const QCPRange& view) { return view != shownTime(); });
}

void StripPlots::undoZoom() {
    if (!canUndo()) return;
    while (views_.back() == shownTime()) views_.pop_back();
    const auto before = views_.back();
    views_.pop_back();
    shareTime(before);
    replot(QCustomPlot::rpQueuedReplot);
}

void StripPlots::addScopeReading(double t_s, double amplitude) { trains_->addScopeReading(t_s, amplitude); }

QCPRange StripPlots::shownTime() const { return strips_.back().time().range(); }

const Strip& StripPlots::stripOf(StreamKind kind) const {
    return strips_[kind == StreamKind::Force ? kForce : kind == StreamKind::Taxels ? kTaxels : kAcceleration];
}

void StripPlots::redraw() {
    if (frozen_) return;
    // Moves in whole pixels, so that each column keeps its samples and the trace does not shimmer.
    const double pixel = window_s_ / std::max(1, strips_.back().axes().width());
    const double now = std::floor(history_.now_s() / pixel) * pixel;
    ticker_->setTickOrigin(now);
    shareTime(QCPRange(now - window_s_, now));
    if (frame_++ % kTextEvery == 0) write();
    replot(QCustomPlot::rpQueuedReplot);
}

void StripPlots::shareTime(const QCPRange& time) {
    if (std::exchange(sharing_, true)) return;
    for (auto& strip : strips_) strip.time().setRange(time);
    strips_[kAcceleration].fit(acceleration_, time);
    strips_[kForce].fit(force_, time);
    strips_[kTaxels].fit(taxels_, time);
    strips_[kIndices].values().setRange(-0.08, 1.08);
    if (const auto* series = shown().samples(StreamKind::Acceleration);
        series != nullptr && spectrogram_->top_hz() > 0) {
        strips_[kSpectrum].values().setRange(0, spectrogram_->top_hz());
        spectrogram_->update(*series, time, std::max(50, strips_[kSpectrum].axes().width() / 2));
    }
    for (const auto index : {kAcceleration, kForce, kTaxels})
        strips_[index].hatch(shown().samples(streamOf(index)), shown().now_s());
    trains_->draw(shown(), time);
    std::vector<QCPAxisRect*> rects;
    for (const auto& strip : strips_)
        if (strip.present()) rects.push_back(&strip.axes());
    marks_.draw(shown().marks(), rects);
    for (auto& strip : strips_) strip.thinTicks();
    markFault(time);
    sharing_ = false;
    if (frozen_) emit viewChanged();
}

/// Marks the fault's time in every strip. The trains' strip also shows, on the side with more room, the time of day and
/// the cause, and that the output is off if the shade has no room for these words.
void StripPlots::markFault(const QCPRange& time) {
    const auto& fault = shown().fault();
    const bool seen = fault && time.contains(fault->at_s);
    for (auto& strip : strips_) strip.markFault(seen ? fault->at_s : std::nan(""));
    fault_->setVisible(seen);
    if (!seen) return;
    const bool left = fault->at_s > time.center();
    const double share = (left ? fault->at_s - time.lower : time.upper - fault->at_s) / time.size();
    const auto why = qtext(fault->why.view());
    QStringList words{why.isEmpty() ? tr("fault") : why};
    if (fault->clock.isValid()) words.prepend(fault->clock.toString("HH:mm:ss"));
    if (!trains_->saysOff() && fault->until_s > time.upper) words.insert(words.size() - 1, tr("output off"));
    fault_->setText(QFontMetrics(fault_->font())
                        .elidedText(words.join(" · "), Qt::ElideRight,
                                    static_cast<int>(share * strips_[kTrains].axes().width()) - 16));
    fault_->setPositionAlignment(Qt::AlignTop | (left ? Qt::AlignRight : Qt::AlignLeft));
    fault_->position->setCoords(fault->at_s, 0);
}

void StripPlots::write() {
    const auto newest = [](const Series* series, std::size_t channel) {
        return series == nullptr || series->empty() ? std::nanf("") : series->value(series->size() - 1, channel);
    };
    const QStringList axes{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i)
        strips_[kAcceleration].caption().setKey(i, acceleration_[i]->visible() ? axes[int(i)] : QString());
    const auto* force = shown().samples(StreamKind::Force);
    // All values use one format, so that their digits do not jump.
    strips_[kForce].caption().setValue(
        quantityText(double(newest(force, 0)), strips_[kForce].unit(), ColumnFormat{0, 2}));
    const auto* taxels = shown().samples(StreamKind::Taxels);
    strips_[kTaxels].caption().setValue(taxels == nullptr ? QString() : taxelText(*taxels), true);
    strips_[kSpectrum].caption().setValue(spectrogram_->scaleText(), true);
    auto& indices = strips_[kIndices].caption();
    indices.setKey(0, tr("roughness R"), tr("R"));
    indices.setKey(1, tr("pressure P"), tr("P"));
    indices.setKey(2, shown().boardFrames().empty() ? QString() : tr("as the board encodes"), tr("board"));
    indices.setValue(indicesText());
    trains_->caption();
}

QString StripPlots::taxelText(const Series& taxels) const {
    if (taxels.empty()) return tr("%1 taxels").arg(taxels.channels());
    double sum = 0;
    for (std::size_t c = 0; c < taxels.channels(); ++c) sum += double(taxels.value(taxels.size() - 1, c));
    const auto unit = strips_[kTaxels].unit() == "kPa" ? QString("Pa") : strips_[kTaxels].unit();
    return tr("%1 taxels, mean %2").arg(taxels.channels()).arg(quantityText(sum / double(taxels.channels()), unit, 2));
}

/// R and P, and how far the board's are from them at most in what is shown.
QString StripPlots::indicesText() const {
    const auto& frames = shown().frames();
    const auto newest = [&](std::size_t column) {
        return frames.empty() ? std::nanf("") : frames.value(frames.size() - 1, column);
    };
    const auto text =
        tr("R %1 · P %2").arg(indexText(newest(LiveHistory::kRoughness)), indexText(newest(LiveHistory::kPressure)));
    const auto& board = shown().boardFrames();
    if (board.empty()) return text;
    float apart[2] = {std::nanf(""), std::nanf("")};
    const auto end = board.firstFrom(shownTime().upper);
    for (auto i = board.firstFrom(shownTime().lower); i < end; ++i) {
        apart[0] = std::fmax(apart[0], std::abs(board.value(i, LiveHistory::kAboveR)));
        apart[1] = std::fmax(apart[1], std::abs(board.value(i, LiveHistory::kAboveP)));
    }
    return tr("%1 · board within %2 and %3")
        .arg(text, decimalText(double(apart[0]), 4), decimalText(double(apart[1]), 4));
}

QString StripPlots::scalesText() const {
    const auto time = shownTime();
    const double ago_s = shown().now_s() - time.upper;
    QStringList parts{ago_s < time.size() / 100
                          ? tr("last %1").arg(settingText(time.size(), "s"))
                          : tr("%1, up to %2 before").arg(quantityText(time.size(), "s"), quantityText(ago_s, "s"))};
    for (const auto& strip : strips_)
        if (strip.present()) parts << strip.scaleText();
    return parts.join(QStringLiteral(" · "));
}

QString StripPlots::readingsText() const {
    QStringList parts;
    const auto add = [&](StripIndex strip, const QString& before) {
        const auto value = strips_[strip].caption().value();
        if (strips_[strip].present() && !value.isEmpty()) parts << before + value;
    };
    add(kForce, tr("Force "));
    add(kTaxels, {});
    add(kIndices, {});
    return parts.join(QStringLiteral(" · "));
}

QDateTime StripPlots::takenAt() const { return frozen_ ? frozenAt_ : QDateTime::currentDateTime(); }

}  // namespace tacto::gui

#include "moc_StripPlots.cpp"
