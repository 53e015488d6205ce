#include "app/gui/runner/CaptureStrip.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Theme.h"
#include "app/report/FigureDrawing.h"
#include "core/base/JsonText.h"
#include "core/session/SessionReader.h"
namespace tacto::gui {

namespace {
constexpr std::size_t kPoints = 2000;                        // more points than pixels; extremes are kept
constexpr double kVoltageReach = 1.15, kCurrentReach = 1.6;  // axis range divided by the range of the data
constexpr int kMargin = 15, kMarginAbove = 6;
}  // namespace

CaptureStrip::CaptureStrip(QWidget* parent) : QCustomPlot(parent) {
    setAccessibleName(tr("Last capture"));
    setToolTip(tr("The last train as the oscilloscope recorded it."));
    voltage_ = addGraph(xAxis, yAxis);
    current_ = addGraph(xAxis, yAxis2);
    xAxis->setLabel(tr("Time from the trigger (µs)"));
    yAxis->setLabel(tr("Voltage (V)"));
    yAxis2->setLabel(tr("Current (mA)"));
    yAxis2->setVisible(true);
    yAxis2->grid()->setVisible(false);
    for (auto* axis : {xAxis, yAxis, yAxis2}) axis->setNumberFormat("gb");
    watermark_ = addWatermark(*axisRect());
    empty_ = new QCPItemText(this);
    empty_->position->setType(QCPItemPosition::ptAxisRectRatio);
    empty_->position->setCoords(0.5, 0.5);
    plotLayout()->insertRow(0);
    title_ = new QCPTextElement(this);
    title_->setTextFlags(Qt::AlignLeft | Qt::AlignVCenter);
    plotLayout()->addElement(0, 0, title_);
    axisRect()->setMinimumMargins(QMargins(kMargin, kMarginAbove, kMargin, 0));
    addPlotMenu(*this, "train");
    setMinimumHeight(fontMetrics().height() * 10);
    show(nullptr);
    onLookChange(*this, [this] {
        colour();
        replot(QCustomPlot::rpQueuedReplot);
    });
}

void CaptureStrip::show(const std::shared_ptr<const Capture>& capture, const QString& title) {
    const bool titled = capture != nullptr && !title.isEmpty();
    title_->setText(titled ? title : QString());
    title_->setVisible(titled);
    plotLayout()->setRowSpacing(titled ? kMarginAbove : 0);
    title_->setMaximumSize(QWIDGETSIZE_MAX, titled ? QWIDGETSIZE_MAX : 0);
    empty_->setVisible(capture == nullptr);
    empty_->setText(title.isEmpty() ? tr("The last captured train\nappears here.") : title);
    watermark_->setVisible(capture && capture->simulated);
    voltage_->data()->clear();
    current_->data()->clear();
    for (std::size_t c = 0; capture && c < capture->channels.size(); ++c) {
        const auto& channel = capture->channels[c];
        auto* graph = channel.unit == "V" ? voltage_ : channel.unit == "A" ? current_ : nullptr;
        if (graph == nullptr) continue;
        const double scale = channel.unit == "A" ? 1e3 : 1;
        const double from = std::isfinite(capture->trigger_s) ? capture->trigger_s : capture->start_s;
        const std::vector<double> samples(channel.samples.begin(), channel.samples.end());
        QVector<double> x, y;
        for (const auto i : visiblePoints(samples, kPoints)) {
            x << (capture->start_s + double(i) / capture->rate_hz - from) * 1e6;
            y << samples[i] * scale;
        }
        graph->setData(x, y, true);
        graph->rescaleKeyAxis();
        graph->rescaleValueAxis();
        // On a resistor both traces have the same shape: the current is drawn smaller, so that both stay visible.
        graph->valueAxis()->scaleRange(graph == current_ ? kCurrentReach : kVoltageReach);
    }
    colour();
    replot(QCustomPlot::rpQueuedReplot);
}

void CaptureStrip::colour() {
    stylePlot(*this);
    const auto& c = colours();
    empty_->setColor(c.quiet);
    title_->setFont(textFont(TextSize::Small, QFont::DemiBold));
    title_->setTextColor(c.text);
    voltage_->setPen(QPen(c.voltage));
    current_->setPen(QPen(c.current, 1, Qt::DashLine));
    yAxis->setLabelColor(c.voltage);
    yAxis2->setLabelColor(c.currentText);
    thinTicks();
}

void CaptureStrip::thinTicks() {
    constexpr int kMaxTicks = 5, kApart = 3;  // rounding to a readable tick step may change it by half
    const QFontMetrics metrics(xAxis->tickLabelFont());
    const int digits = metrics.horizontalAdvance(QString::number(xAxis->range().upper, 'f', 0));
    const int widest = std::max(metrics.horizontalAdvance("−00000"), digits);
    xAxis->ticker()->setTickCount(std::clamp(width() / (kApart * widest), 1, kMaxTicks));
    // Title, digits and axis name need room above and below the frame.
    const int frame = height() - 3 * metrics.height();
    const int up = std::clamp(2 * frame / (3 * metrics.height()), 1, kMaxTicks);
    for (auto* axis : {yAxis, yAxis2}) axis->ticker()->setTickCount(up);
}

void CaptureStrip::resizeEvent(QResizeEvent* event) {
    thinTicks();  // must run before the base class draws
    QCustomPlot::resizeEvent(event);
}

double peakIn(const Capture& capture, std::string_view unit) {
    double peak = -1;
    for (const auto& channel : capture.channels) {
        if (channel.unit != unit) continue;
        for (const float sample : channel.samples)
            if (std::isfinite(sample)) peak = std::max(peak, std::abs(double(sample)));
        break;
    }
    return peak;
}

Result<std::shared_ptr<const Capture>> strongestOn(const std::filesystem::path& session, const std::string& load,
                                                   bool ofVoltage) {
    const auto reader = SessionReader::open(session);
    if (!reader) return failure(reader);
    const auto trials = reader->trials();
    if (!trials) return failure(trials);
    const auto captures = reader->captures();
    if (!captures) return failure(captures);
    std::set<int> ofLoad;
    for (const auto& trial : *trials) {
        if (textOr(trial.measured, "type") == "command" && textOr(trial.measured, "load") == load)
            ofLoad.insert(trial.number);
    }
    std::shared_ptr<const Capture> strongest;
    double most = -1;
    for (const auto& info : *captures) {
        if (!info.trial || !ofLoad.contains(*info.trial)) continue;
        auto capture = reader->capture(info.seq);
        if (!capture) return failure(capture);
        if (capture->untriggered) continue;
        const double amps = ofVoltage ? -1 : peakIn(*capture, "A");
        const double peak = amps >= 0 ? amps : peakIn(*capture, "V");
        if (!(peak > most)) continue;
        most = peak;
        strongest = std::make_shared<const Capture>(std::move(*capture));
    }
    return strongest;
}

}  // namespace tacto::gui

#include "moc_CaptureStrip.cpp"
