// Measured pulses as small multiples: voltage above current, all on the same scales for comparison.
#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

using Trace = WaveformsFigure::Trace;

constexpr std::size_t kColumns = 4;
constexpr std::size_t kWavePoints = 350;  // number of stretches with drawn extremes; a column is 150 units wide

bool measured(const Trace& trace) { return !trace.voltage_v.empty() || !trace.current_a.empty(); }

double peakOf(const std::vector<double>& values) {
    double peak = 0;
    for (const double value : values) {
        if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
    }
    return peak;
}

QCPRange extremesOf(const std::vector<double>& values, double factor, QCPRange range) {
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        range.lower = std::min(range.lower, value * factor);
        range.upper = std::max(range.upper, value * factor);
    }
    return range;
}

/// Returns the samples from the first to the last that stands out, with a margin: otherwise a pulse of 500 µs in a
/// record of 10 ms would be a line.
std::pair<std::size_t, std::size_t> activeSpan(const Trace& trace) {
    const auto& values = trace.voltage_v.empty() ? trace.current_a : trace.voltage_v;
    const double threshold = 0.1 * peakOf(values);
    const auto stands = [&](double value) { return std::abs(value) > threshold; };
    const auto first = std::find_if(values.begin(), values.end(), stands);
    if (first == values.end()) return {0, values.size()};
    const auto last = std::find_if(values.rbegin(), values.rend(), stands).base();
    const auto margin = std::max<std::ptrdiff_t>(5, (last - first) * 3 / 10);
    return {static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - values.begin() - margin)),
            static_cast<std::size_t>(std::min<std::ptrdiff_t>(std::ssize(values), last - values.begin() + margin))};
}

struct Scales {
    AxisUnit time, voltage, current;
    QCPRange voltageRange, currentRange;
    double span_s = 0;
};

class WaveformsSheet {
public:
    WaveformsSheet(const std::vector<const Trace*>& traces, bool simulated)
        : traces_(traces), columns_(std::min(kColumns, traces.size())) {
        const std::size_t bands = (traces.size() + columns_ - 1) / columns_;
        sheet_ = std::make_unique<PlotSheet>(kSheetWidth, static_cast<int>(bands) * 200, simulated);
        sheet_->plot().plotLayout()->setColumnSpacing(0);
        fitScales();
    }

    std::unique_ptr<PlotSheet> draw() {
        for (std::size_t i = 0; i < traces_.size(); ++i) {
            const int column = static_cast<int>(i % columns_);
            const int row = static_cast<int>(i / columns_) * 3;
            const bool labelled = column == 0;
            sheet_->addTitle(row, column, traces_[i]->label, true);
            drawChannel(row + 1, column, *traces_[i], true, labelled);
            drawChannel(row + 2, column, *traces_[i], false, labelled);
        }
        // The column with the axis labels is wider by their width.
        if (columns_ > 1) sheet_->plot().plotLayout()->setColumnStretchFactor(0, 1.0 + 0.05 * double(columns_));
        return std::move(sheet_);
    }

private:
    void fitScales() {
        double voltage = 0, current = 0;
        for (const auto* trace : traces_) {
            voltage = std::max(voltage, peakOf(trace->voltage_v));
            current = std::max(current, peakOf(trace->current_a));
            const auto [begin, end] = activeSpan(*trace);
            scales_.span_s = std::max(scales_.span_s, double(end - begin) / trace->rate_hz);
        }
        scales_.time = axisUnit(scales_.span_s * 0.5, "s");
        scales_.voltage = axisUnit(voltage, "V");
        scales_.current = axisUnit(current, "A");
        QCPRange volts(0, 0), amps(0, 0);
        for (const auto* trace : traces_) {
            volts = extremesOf(trace->voltage_v, scales_.voltage.factor, volts);
            amps = extremesOf(trace->current_a, scales_.current.factor, amps);
        }
        scales_.voltageRange = padded(volts.lower, volts.upper, 0.08);
        scales_.currentRange = padded(amps.lower, amps.upper, 0.08);
    }

    void drawChannel(int row, int column, const Trace& trace, bool isVoltage, bool labelled) {
        const auto& values = isVoltage ? trace.voltage_v : trace.current_a;
        const AxisUnit& unit = isVoltage ? scales_.voltage : scales_.current;
        auto* axes = sheet_->addAxes(row, column);
        axes->setMinimumMargins(QMargins(4, 3, 10, 3));
        auto* time = axes->axis(QCPAxis::atBottom);
        auto* level = axes->axis(QCPAxis::atLeft);
        level->setRange(isVoltage ? scales_.voltageRange : scales_.currentRange);
        level->setTickLabels(labelled);
        level->setTicker(QSharedPointer<PlainTicker>::create(4));
        time->setTicker(QSharedPointer<PlainTicker>::create(columns_ > 2 ? 3 : 6));
        time->setTickLabels(!isVoltage);
        if (!isVoltage) time->setLabel(axisTitle("Time", scales_.time.unit));
        if (labelled) {
            level->setLabel(axisTitle(isVoltage ? "Voltage" : "Current", unit.unit));
            axes->setMarginGroup(QCP::msLeft, marginGroup());
        }
        const auto [begin, end] = activeSpan(trace);
        // Every column spans the same time, so that widths can be compared.
        const double start = trace.start_s + double(begin) / trace.rate_hz;
        const double slack = scales_.span_s - double(end - begin) / trace.rate_hz;
        time->setRange((start - slack / 2) * scales_.time.factor,
                       (start - slack / 2 + scales_.span_s) * scales_.time.factor);
        if (values.empty()) {
            level->setTicks(false);
            sheet_->addNote(axes, isVoltage ? "voltage was\nnot captured" : "current was\nnot captured", {0.5, 0.5})
                ->setColor(ink::kQuiet);
            return;
        }
        sheet_->watermark(axes, columns_ > 2 ? 14 : 20);
        auto* graph = new QCPGraph(time, level);
        graph->setPen(QPen(isVoltage ? ink::kVoltage : ink::kCurrent, 1.4, isVoltage ? Qt::SolidLine : Qt::DashLine,
                           Qt::FlatCap, Qt::RoundJoin));
        graph->setAdaptiveSampling(false);
        const auto shown = std::span(values).subspan(begin, std::min(end, values.size()) - begin);
        QVector<double> x, y;
        for (const std::size_t i : visiblePoints(shown, kWavePoints)) {
            x << (trace.start_s + double(begin + i) / trace.rate_hz) * scales_.time.factor;
            y << shown[i] * unit.factor;
        }
        graph->setData(x, y, true);
    }

    QCPMarginGroup* marginGroup() {
        if (margins_ == nullptr) margins_ = new QCPMarginGroup(&sheet_->plot());
        return margins_;
    }

    std::vector<const Trace*> traces_;
    std::size_t columns_;
    std::unique_ptr<PlotSheet> sheet_;
    QCPMarginGroup* margins_ = nullptr;
    Scales scales_;
};

}  // namespace

std::unique_ptr<PlotSheet> drawWaveforms(const WaveformsFigure& figure, bool simulated) {
    std::vector<const Trace*> traces;
    for (const auto& trace : figure.captures) {
        if (measured(trace) && trace.rate_hz > 0 && traces.size() < kWaveformsShown) traces.push_back(&trace);
    }
    if (traces.empty()) {
        return emptySheet(figure.captures.empty() ? "No waveform was captured." : "The captures hold no samples.",
                          simulated);
    }
    return WaveformsSheet(traces, simulated).draw();
}

}  // namespace tacto
