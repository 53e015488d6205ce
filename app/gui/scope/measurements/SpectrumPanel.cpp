#include "app/gui/scope/measurements/SpectrumPanel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QScrollBar>
#include <QSettings>
#include <QTableWidget>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <qcustomplot.h>

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/model/ScopeLanes.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"
#include "core/base/Words.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kMinSamples = 16;
constexpr double kPeakOverMedian = 10;  ///< 20 dB; noise alone reaches 10 or 12

constexpr std::size_t kMaxNamed = 6;
constexpr double kDecades = 5;       ///< of the level axis, unless it is linear
constexpr double kMinShare = 1e-12;  ///< of the highest level: a level of 0 has no logarithm
constexpr Word<LevelScale> kLevelScales[] = {
    {"log", LevelScale::Logarithmic}, {"dB", LevelScale::Decibel}, {"linear", LevelScale::Linear}};

double decibels(double rms) { return 20 * std::log10(rms); }

void numberLinearly(QCPAxis& axis) {
    axis.setScaleType(QCPAxis::stLinear);
    axis.setTicker(QSharedPointer<QCPAxisTicker>::create());
    axis.setNumberFormat("gb");
    axis.setNumberPrecision(6);
}

void numberInPowers(QCPAxis& axis, int subTicks) {
    auto ticker = QSharedPointer<QCPAxisTickerLog>::create();
    ticker->setSubTickCount(subTicks);
    axis.setScaleType(QCPAxis::stLogarithmic);
    axis.setTicker(ticker);
    axis.setNumberFormat("eb");  // each number as a power of ten
    axis.setNumberPrecision(0);
}

/// The name of a window, and what the window is good for.
std::pair<QString, QString> wordsOf(SpectralWindow window) {
    switch (window) {
        case SpectralWindow::Rectangular:
            return {QObject::tr("Rectangular"),
                    QObject::tr("The finest lines; levels are right only where whole periods are on the screen.")};
        case SpectralWindow::Hann:
            return {QObject::tr("Hann"),
                    QObject::tr("For most signals. Halfway between two lines a level reads up to 1.4 dB low.")};
        case SpectralWindow::BlackmanHarris:
            return {QObject::tr("Blackman–Harris"),
                    QObject::tr("For small lines beside large ones: nothing leaks above −92 dB.")};
        case SpectralWindow::FlatTop:
            break;
    }
    return {QObject::tr("Flat top"),
            QObject::tr("For levels: right within 0.01 dB at any frequency, but its lines are wide.")};
}

}  // namespace

SpectrumPanel::SpectrumPanel(QWidget* parent)
    : QWidget(parent),
      channel_(new QComboBox(this)),
      window_(new QComboBox(this)),
      levels_(new QComboBox(this)),
      log_(new QCheckBox(tr("Log frequency"), this)),
      listed_(new QCheckBox(tr("Peak list"), this)),
      note_(new ElidedLabel(this)),
      plot_(new QCustomPlot(this)),
      list_(new QTableWidget(0, 3, this)),
      graph_(plot_->addGraph()),
      peaks_(plot_->addGraph()) {
    channel_->setAccessibleName(tr("Channel of the spectrum"));
    channel_->setToolTip(tr("The lane whose visible part is transformed."));
    window_->setAccessibleName(tr("Window of the spectrum"));
    window_->setToolTip(tr("What the samples are weighted with before they are transformed."));
    for (const auto window : kSpectralWindows) {
        const auto [title, use] = wordsOf(window);
        window_->addItem(title, qtext(nameOf(window)));
        window_->setItemData(window_->count() - 1, use, Qt::ToolTipRole);
    }
    levels_->setAccessibleName(tr("Levels of the spectrum"));
    levels_->setToolTip(tr("How the levels are spread over the axis. dB are relative to 1 in the lane's unit."));
    levels_->addItem(tr("Log levels"), "log");
    levels_->addItem(tr("dB"), "dB");
    levels_->addItem(tr("Linear levels"), "linear");
    log_->setToolTip(tr("Decades of frequency instead of equal steps."));
    listed_->setToolTip(tr("The peaks with frequency and level, highest first."));
    listed_->setChecked(true);
    list_->setAccessibleName(tr("Peaks of the spectrum"));
    makeReadOnly(*list_);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    connect(listed_, &QCheckBox::toggled, list_, &QWidget::setVisible);
    connect(levels_, &QComboBox::currentIndexChanged, this, [this] {
        setLevelAxis();
        draw();
    });
    connect(channel_, &QComboBox::activated, this, &SpectrumPanel::showModel);
    connect(window_, &QComboBox::activated, this, &SpectrumPanel::showModel);
    connect(log_, &QCheckBox::toggled, this, [this] {
        setFrequencyAxis();
        draw();
    });
    setTone(*note_, Tone::Quiet);
    setTextSize(*note_, TextSize::Small);
    auto* line = new QHBoxLayout;
    line->setContentsMargins(8, 0, 8, 0);
    line->addWidget(new QLabel(tr("Spectrum of"), this));
    for (QWidget* each : std::initializer_list<QWidget*>{channel_, window_, levels_, log_, listed_})
        line->addWidget(each);
    line->addWidget(note_, 1);
    auto* layout = columnIn(*this, 4);
    layout->addLayout(line);
    auto* below = new QHBoxLayout;
    below->addWidget(plot_, 1);
    below->addWidget(list_);
    layout->addLayout(below, 1);
    plot_->setAccessibleName(tr("Spectrum"));
    plot_->setMinimumHeight(fontMetrics().height() * 7);
    plot_->setNotAntialiasedElements(QCP::aeAll);
    plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    plot_->axisRect()->setRangeDrag(Qt::Horizontal);
    plot_->axisRect()->setRangeZoom(Qt::Horizontal);
    plot_->setToolTip(
        tr("The height of a line is the RMS of a sine of that frequency. The wheel zooms the frequency."));
    addPlotMenu(*plot_, "spectrum");
    watermark_ = addWatermark(*plot_->axisRect());
    watermark_->setVisible(false);
    peaks_->setLineStyle(QCPGraph::lsNone);
    for (std::size_t i = 0; i < kMaxNamed; ++i) {
        auto* name = new QCPItemText(plot_);
        name->setClipToAxisRect(false);
        name->setPositionAlignment(Qt::AlignHCenter | Qt::AlignBottom);
        name->setPadding(QMargins(3, 0, 3, 6));
        name->setVisible(false);
        names_.push_back(name);
    }
    connect(plot_->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &SpectrumPanel::namePeaks);
    connect(plot_, &QCustomPlot::afterLayout, this, &SpectrumPanel::fitLevels);
    setFrequencyAxis();
    setLevelAxis();
    restyle();
    onLookChange(*this, [this] {
        restyle();
        plot_->replot(QCustomPlot::rpQueuedReplot);
        showModel();  // with the new colour of the lane
    });
    onEvent(*this, QEvent::Show, [this] { showModel(); });
}

SpectrumPanel::~SpectrumPanel() = default;

QString SpectrumPanel::lane() const { return channel_->currentData().toString(); }

SpectralWindow SpectrumPanel::window() const {
    return kSpectralWindows[static_cast<std::size_t>(std::max(0, window_->currentIndex()))];
}

bool SpectrumPanel::logarithmic() const { return log_->isChecked(); }

LevelScale SpectrumPanel::levelScale() const {
    return valueFor(kLevelScales, levels_->currentData().toString().toStdString()).value_or(LevelScale::Logarithmic);
}

void SpectrumPanel::show(const TracePtr& trace, double from_s, double to_s, const QColor& colour) {
    colour_ = colour;
    unit_ = trace ? trace->unit : QString();
    spectrum_ = {};
    if (trace) calculate(*trace, from_s, to_s);
    draw();
}

void SpectrumPanel::calculate(const Trace& trace, double from_s, double to_s) {
    const auto index = [&](double t) {
        const double at = (t - trace.start_s) * trace.rate_hz;
        return static_cast<std::size_t>(std::clamp(std::ceil(at), 0.0, static_cast<double>(trace.size())));
    };
    std::size_t first = index(from_s);
    const std::size_t last = index(to_s);
    const std::size_t seen = last > first ? last - first : 0;
    if (seen < kMinSamples) {
        spectrum_.note = tr("Fewer than %1 samples are on the screen: zoom out.").arg(kMinSamples);
        return;
    }
    // A power of two is fast to transform at any zoom, and the next frame can reuse the transform.
    const std::size_t length = std::min(std::bit_floor(seen), kMaxSamples);
    first += (seen - length) / 2;
    if (trace.pyramid.over(first, first + length).gap) {
        spectrum_.note = tr("Samples are missing on the screen: zoom into a part without gaps.");
        return;
    }
    if (!transform_ || transform_->length() != length || transformRate_hz_ != trace.rate_hz ||
        transformWindow_ != window()) {
        auto shape = samplesOf(window(), length);
        bins_ = equivalentNoiseBandwidth(shape);
        transform_ = std::make_unique<PowerSpectrum>(std::move(shape), 1, trace.rate_hz);
        transformRate_hz_ = trace.rate_hz;
        transformWindow_ = window();
    }
    std::vector<double> samples(length);
    const auto begin = trace.samples->begin() + static_cast<std::ptrdiff_t>(first);
    std::copy(begin, begin + static_cast<std::ptrdiff_t>(length), samples.begin());
    const double mean = std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(length);
    for (auto& x : samples) x -= mean;  // an offset would hide the lowest frequencies
    const double* axis = samples.data();
    transform_->transform({&axis, 1});
    const double width = transform_->binWidth_hz();
    for (std::size_t k = 1; k <= length / 2; ++k) {
        spectrum_.hz.push_back(static_cast<double>(k) * width);
        spectrum_.rms.push_back(std::sqrt(transform_->density(k) * width * bins_));
    }
    spectrum_.samples = length;
    spectrum_.bandwidth_hz = width * bins_;
    findPeaks(trace.unit);
}

void SpectrumPanel::findPeaks(const QString& unit) {
    const double width = transform_->binWidth_hz();
    for (const auto& peak : spectralPeaks(spectrum_.rms, 2 * mainLobe(window()), kPeakOverMedian, kMaxPeaks)) {
        spectrum_.peaks.push_back({(peak.bin + 1) * width, peak.level});  // the first line is bin 1
    }
    // The line to name: the highest peak, or the highest line if there is no peak.
    const auto line = std::max_element(spectrum_.rms.begin(), spectrum_.rms.end()) - spectrum_.rms.begin();
    const auto at = static_cast<std::size_t>(line);
    const auto top =
        spectrum_.peaks.empty() ? Spectrum::Peak{spectrum_.hz[at], spectrum_.rms[at]} : spectrum_.peaks.front();
    spectrum_.note =
        tr("Highest %1 at %2 · %3 samples, a line every %4, %5 wide (%6 lines)")
            .arg(quantityText(top.rms, unit, 3), quantityText(top.hz, "Hz"))
            .arg(spectrum_.samples)
            .arg(quantityText(width, "Hz", 3), quantityText(spectrum_.bandwidth_hz, "Hz", 3), decimalText(bins_, 2));
}

void SpectrumPanel::setFrequencyAxis() {
    auto& axis = *plot_->xAxis;
    if (logarithmic()) {
        numberInPowers(axis, 8);
    } else {
        numberLinearly(axis);
    }
    shownTop_hz_ = 0;  // the old zoom does not fit the new axis
}

void SpectrumPanel::setLevelAxis() {
    levelScale() == LevelScale::Logarithmic ? numberInPowers(*plot_->yAxis, 0) : numberLinearly(*plot_->yAxis);
}

double SpectrumPanel::placed(double rms) const {
    const double level = std::max(rms, kMinShare * highest_);
    return levelScale() == LevelScale::Decibel ? decibels(level) : level * levelFactor_;
}

void SpectrumPanel::listPeaks() {
    list_->setHorizontalHeaderLabels({tr("Frequency"), tr("RMS"), tr("dB re 1 %1").arg(unit_)});
    int wide = 2 * list_->frameWidth() + list_->verticalScrollBar()->sizeHint().width();
    const char* const widest[] = {"000.0 kHz", "00.0 mV", "−00.0"};  // numbers that jump cannot be read
    for (int column = 0; column < 3; ++column) {
        list_->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
        const int number = QFontMetrics(list_->font()).horizontalAdvance(widest[column]) + scaledPx(16);
        list_->setColumnWidth(column, std::max(number, list_->horizontalHeader()->sectionSizeHint(column)));
        wide += list_->columnWidth(column);
    }
    list_->setFixedWidth(wide);
    list_->setRowCount(static_cast<int>(spectrum_.peaks.size()));
    for (int row = 0; row < list_->rowCount(); ++row) {
        const auto& peak = spectrum_.peaks[static_cast<std::size_t>(row)];
        const QString texts[] = {quantityText(peak.hz, "Hz"), quantityText(peak.rms, unit_, 3),
                                 decimalText(decibels(peak.rms), 1)};
        for (int column = 0; column < 3; ++column) {
            auto* item = new QTableWidgetItem(texts[column]);
            item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            list_->setItem(row, column, item);
        }
    }
}

void SpectrumPanel::draw() {
    note_->setText(spectrum_.note);
    note_->setToolTip(spectrum_.note);
    // If there are more lines than pixels, each pixel shows the highest, so that no peak is lost.
    const auto count = spectrum_.hz.size();
    const double columns = std::max(200, plot_->width());
    const auto next = [&](std::size_t at) {
        const double step = static_cast<double>(count) / columns;
        const double grown = logarithmic()
                                 ? (static_cast<double>(at) + 1) * std::pow(static_cast<double>(count), 1 / columns)
                                 : static_cast<double>(at) + step;
        return std::clamp(static_cast<std::size_t>(grown), at + 1, count);
    };
    QVector<double> hz, rms;
    for (std::size_t at = 0; at < count;) {
        const auto end = next(at);
        const auto from = spectrum_.rms.begin() + static_cast<std::ptrdiff_t>(at);
        const auto top = std::max_element(from, spectrum_.rms.begin() + static_cast<std::ptrdiff_t>(end));
        hz << spectrum_.hz[static_cast<std::size_t>(top - spectrum_.rms.begin())];
        rms << *top;
        at = end;
    }
    const double top_hz = count == 0 ? 0 : spectrum_.hz.back();
    const bool other = count > 0 && std::abs(shownTop_hz_ - top_hz) > 0.01 * top_hz;
    const auto unit = axisUnit(logarithmic() ? 1 : top_hz / 2, "Hz");
    for (auto& f : hz) f *= unit.factor;
    highest_ = rms.isEmpty() ? 0 : *std::max_element(rms.begin(), rms.end());
    const auto level = highest_ > 0 ? axisUnit(highest_, unit_) : AxisUnit{1, unit_};
    levelFactor_ = level.factor;
    for (auto& value : rms) value = placed(value);
    graph_->setData(hz, rms, true);
    plot_->xAxis->setLabel(tr("Frequency (%1)").arg(unit.unit));
    plot_->yAxis->setLabel(levelScale() == LevelScale::Decibel ? tr("RMS (dB re 1 %1)").arg(unit_)
                           : level.unit.isEmpty()              ? tr("RMS")
                                                               : tr("RMS (%1)").arg(level.unit));
    peaks_->data()->clear();
    for (const auto& peak : spectrum_.peaks) peaks_->addData(peak.hz * unit.factor, placed(peak.rms));
    listPeaks();
    if (!hz.isEmpty()) {
        if (other) {
            shownTop_hz_ = top_hz;
            plot_->xAxis->setRange(logarithmic() ? spectrum_.hz.front() * unit.factor : 0, top_hz * unit.factor);
        }
        fitLevels();
    }
    restyle();
    namePeaks();
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

/// Leaves room for the names above the highest peak.
void SpectrumPanel::fitLevels() {
    if (!(highest_ > 0)) return;
    const double name = QFontMetrics(textFont(TextSize::Small)).height() + 8;
    const double height = std::max<double>(plot_->axisRect()->height(), 2 * name);
    const double above = name / (height - name), top = placed(highest_);
    auto& axis = *plot_->yAxis;
    switch (levelScale()) {
        case LevelScale::Logarithmic:
            return axis.setRange(top * std::pow(10, -kDecades), top * std::pow(10, kDecades * above));
        case LevelScale::Decibel:
            return axis.setRange(top - 20 * kDecades, top + 20 * kDecades * above);
        case LevelScale::Linear:
            return axis.setRange(0, top * (1 + above));
    }
}

/// Names the highest peaks first; leaves out a name that would overlap another.
void SpectrumPanel::namePeaks() {
    const QFontMetrics metrics(textFont(TextSize::Small));
    const auto unit = axisUnit(logarithmic() ? 1 : shownTop_hz_ / 2, "Hz");
    std::vector<std::pair<double, double>> taken;
    const auto range = plot_->xAxis->range();
    for (std::size_t i = 0; i < names_.size(); ++i) {
        auto* name = names_[i];
        name->setVisible(false);
        if (i >= spectrum_.peaks.size()) continue;
        const auto& peak = spectrum_.peaks[i];
        const double key = peak.hz * unit.factor;
        if (!range.contains(key)) continue;
        const auto text =
            tr("%1 · %2").arg(quantityText(peak.hz, "Hz"), levelScale() == LevelScale::Decibel
                                                               ? tr("%1 dB").arg(decimalText(decibels(peak.rms), 1))
                                                               : quantityText(peak.rms, unit_, 3));
        const double half = 0.5 * metrics.size(0, text).width() + 4;
        const double at = plot_->xAxis->coordToPixel(key);
        // No name may stick out of the plot at the side.
        const QRect area = plot_->axisRect()->rect();
        const auto side = at - half < area.left()    ? Qt::AlignLeft
                          : at + half > area.right() ? Qt::AlignRight
                                                     : Qt::AlignHCenter;
        const double left = side == Qt::AlignLeft ? at : side == Qt::AlignRight ? at - 2 * half : at - half;
        const double right = left + 2 * half;
        const bool free = std::none_of(taken.begin(), taken.end(),
                                       [&](const auto& other) { return right > other.first && left < other.second; });
        if (!free) continue;
        taken.emplace_back(left, right);
        name->setText(text);
        name->position->setCoords(key, placed(peak.rms));
        name->setPositionAlignment(Qt::AlignBottom | side);
        name->setVisible(true);
    }
}

QStringList SpectrumPanel::namedPeaks() const {
    QStringList texts;
    for (const auto* name : names_) {
        if (name->visible()) texts << name->text();
    }
    return texts;
}

void SpectrumPanel::restyle() {
    stylePlot(*plot_);
    graph_->setPen(QPen(colour_, 1));
    const auto ink = legible(colour_.isValid() ? colour_ : colours().text, colours().base);
    plot_->yAxis->setLabelColor(ink);
    plot_->yAxis->setTickLabelColor(ink);
    list_->setFont(digits(textFont(TextSize::Small)));
    list_->verticalHeader()->setDefaultSectionSize(QFontMetrics(list_->font()).height() + scaledPx(6));
    peaks_->setScatterStyle(
        QCPScatterStyle(QCPScatterStyle::ssTriangleInverted, QPen(colours().text, 1), QBrush(colours().base), 7));
    for (auto* name : names_) {
        name->setFont(textFont(TextSize::Small));
        name->setColor(colours().text);
    }
}

void SpectrumPanel::save(QSettings& settings) const {
    settings.setValue("fft/window", window_->currentData());
    settings.setValue("fft/log", logarithmic());
    settings.setValue("fft/levels", levels_->currentData());
    settings.setValue("fft/peaks", listed_->isChecked());
}

void SpectrumPanel::restore(const QSettings& settings) {
    const int known = window_->findData(settings.value("fft/window").toString());
    if (known >= 0) window_->setCurrentIndex(known);
    log_->setChecked(rememberedFlag(settings, "fft/log").value_or(false));
    if (const int scale = levels_->findData(settings.value("fft/levels").toString()); scale >= 0)
        levels_->setCurrentIndex(scale);
    listed_->setChecked(rememberedFlag(settings, "fft/peaks").value_or(true));
}

void SpectrumPanel::follow(const ScopeModel& model) {
    model_ = &model;
    connect(&model, &ScopeModel::lanesChanged, this, [this] {
        const auto now = lane();
        channel_->clear();
        for (const auto& l : model_->lanes()) channel_->addItem(l.title, l.key);
        channel_->setCurrentIndex(std::max(0, channel_->findData(now)));
        showModel();
    });
    connect(&model, &ScopeModel::viewChanged, this, &SpectrumPanel::showModel);
}

void SpectrumPanel::showModel() {
    if (model_ == nullptr || isHidden()) return;
    const auto key = lane();
    const auto* its = model_->lane(key);
    const double zero = model_->zero_s();
    const auto& view = model_->viewport();
    watermark_->setVisible(model_->shown() && model_->shown()->capture->simulated);
    show(model_->trace(key), view.left_s + zero, view.right_s() + zero,
         its == nullptr ? colours().text : laneColour(*model_, *its));
}

}  // namespace tacto::gui

#include "moc_SpectrumPanel.cpp"
