#include "app/gui/scope/SpectrumPanel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <qcustomplot.h>

#include "app/gui/look/Look.h"
#include "app/gui/scope/ScopeView.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kFewest = 16;
/// A sine's power spreads over this many bins of a Hann window.
constexpr double kHannBins = 1.5;

}  // namespace

SpectrumPanel::SpectrumPanel(QWidget* parent)
    : QWidget(parent),
      channel_(new QComboBox(this)),
      note_(new QLabel(this)),
      plot_(new QCustomPlot(this)),
      graph_(plot_->addGraph()) {
    channel_->setAccessibleName(tr("Channel of the spectrum"));
    channel_->setToolTip(tr("The lane whose visible part is transformed."));
    connect(channel_, &QComboBox::activated, this, &SpectrumPanel::laneChosen);
    note_->setForegroundRole(QPalette::PlaceholderText);
    auto* line = new QHBoxLayout;
    line->addWidget(new QLabel(tr("Spectrum of"), this));
    line->addWidget(channel_);
    line->addWidget(note_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    layout->addLayout(line);
    layout->addWidget(plot_, 1);
    plot_->setAccessibleName(tr("Spectrum"));
    plot_->setMinimumHeight(fontMetrics().height() * 6);
    plot_->setNotAntialiasedElements(QCP::aeAll);
    plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    plot_->axisRect()->setRangeDrag(Qt::Horizontal);
    plot_->axisRect()->setRangeZoom(Qt::Horizontal);
    plot_->setToolTip(
        tr("The height of a line is the RMS of a sine of that frequency. The wheel zooms the frequency."));
    plot_->yAxis->setScaleType(QCPAxis::stLogarithmic);
    auto ticker = QSharedPointer<QCPAxisTickerLog>::create();
    ticker->setSubTickCount(0);
    plot_->yAxis->setTicker(ticker);
    plot_->yAxis->setNumberFormat("gb");
    plot_->yAxis->setNumberPrecision(0);
    stylePlot(*plot_);
}

SpectrumPanel::~SpectrumPanel() = default;

void SpectrumPanel::setLanes(const std::vector<LaneInfo>& lanes) {
    const auto chosen = lane();
    channel_->clear();
    for (const auto& l : lanes) channel_->addItem(l.title, l.key);
    channel_->setCurrentIndex(std::max(0, channel_->findData(chosen)));
}

QString SpectrumPanel::lane() const { return channel_->currentData().toString(); }

void SpectrumPanel::show(const TracePtr& trace, double from_s, double to_s, const QColor& colour) {
    colour_ = colour;
    spectrum_ = {};
    if (trace) calculate(*trace, from_s, to_s);
    draw(trace ? trace->unit : QString());
}

void SpectrumPanel::calculate(const Trace& trace, double from_s, double to_s) {
    const auto index = [&](double t) {
        const double at = (t - trace.start_s) * trace.rate_hz;
        return static_cast<std::size_t>(std::clamp(std::ceil(at), 0.0, static_cast<double>(trace.size())));
    };
    std::size_t first = index(from_s);
    const std::size_t last = index(to_s);
    const std::size_t seen = last > first ? last - first : 0;
    if (seen < kFewest) {
        spectrum_.note = tr("Fewer than %1 samples are on the screen: zoom out.").arg(kFewest);
        return;
    }
    // A power of two is quick whatever the zoom, and the same plan serves the next frame.
    const std::size_t length = std::min(std::bit_floor(seen), kMaxSamples);
    first += (seen - length) / 2;
    if (trace.pyramid.over(first, first + length).gap) {
        spectrum_.note = tr("Samples are missing on the screen: zoom into a part without gaps.");
        return;
    }
    if (!transform_ || transform_->length() != length || transformRate_hz_ != trace.rate_hz) {
        transform_ = std::make_unique<PowerSpectrum>(length, 1, trace.rate_hz);
        transformRate_hz_ = trace.rate_hz;
    }
    std::vector<double> samples(length);
    const auto begin = trace.samples->begin() + static_cast<std::ptrdiff_t>(first);
    std::copy(begin, begin + static_cast<std::ptrdiff_t>(length), samples.begin());
    const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(length);
    for (auto& x : samples) x -= mean;  // an offset would hide the lowest lines
    const double* axis = samples.data();
    transform_->transform({&axis, 1});
    const double width = transform_->binWidth_hz();
    for (std::size_t k = 1; k <= length / 2; ++k) {
        spectrum_.hz.push_back(static_cast<double>(k) * width);
        spectrum_.rms.push_back(std::sqrt(transform_->density(k) * width * kHannBins));
    }
    spectrum_.samples = length;
    const auto top = std::max_element(spectrum_.rms.begin(), spectrum_.rms.end()) - spectrum_.rms.begin();
    spectrum_.note = tr("Highest %1 at %2 · %3 samples, %4 a line")
                         .arg(quantityText(spectrum_.rms[static_cast<std::size_t>(top)], trace.unit),
                              quantityText(spectrum_.hz[static_cast<std::size_t>(top)], "Hz"))
                         .arg(length)
                         .arg(quantityText(width, "Hz", 3));
}

void SpectrumPanel::draw(const QString& unit) {
    note_->setText(spectrum_.note);
    // Of more lines than pixels the highest in each pixel: a peak must not fall between two.
    const auto columns = static_cast<std::size_t>(std::max(200, plot_->width()));
    const std::size_t group = std::max<std::size_t>(1, spectrum_.hz.size() / columns);
    QVector<double> hz, rms;
    for (std::size_t at = 0; at < spectrum_.hz.size(); at += group) {
        const auto from = spectrum_.rms.begin() + static_cast<std::ptrdiff_t>(at);
        const auto to = spectrum_.rms.begin() + static_cast<std::ptrdiff_t>(std::min(at + group, spectrum_.rms.size()));
        const auto top = std::max_element(from, to);
        hz << spectrum_.hz[static_cast<std::size_t>(top - spectrum_.rms.begin())] * 1e-3;
        rms << *top;
    }
    const bool other = graph_->data()->isEmpty() || hz.isEmpty() ||
                       std::abs((graph_->data()->constEnd() - 1)->key - hz.back()) > 0.01 * hz.back();
    graph_->setData(hz, rms, true);
    graph_->setPen(QPen(colour_, 1));
    plot_->xAxis->setLabel(tr("Frequency (kHz)"));
    plot_->yAxis->setLabel(unit.isEmpty() ? tr("RMS") : tr("RMS (%1)").arg(unit));
    if (!hz.isEmpty()) {
        if (other) plot_->xAxis->setRange(0, hz.back());
        const double top = *std::max_element(rms.begin(), rms.end());
        if (top > 0) plot_->yAxis->setRange(top * 1e-5, top * 2);
    }
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void SpectrumPanel::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::PaletteChange) return;
    stylePlot(*plot_);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace tacto::gui
