// A live run over time: roughness and pressure above, the encoded amplitude and the resulting trains below.
#include "app/report/FigureDrawing.h"
#include "app/report/Fonts.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"

namespace tacto {
namespace {

constexpr std::size_t kTimelinePoints = 700;  // about one per unit of width

void addSeries(QCPAxisRect* axes, QCPLegend* legend, const std::vector<double>& t, double timeFactor,
               const std::vector<double>& values, const QPen& pen, const QString& name, bool steps) {
    auto* graph = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
    graph->setPen(pen);
    graph->setName(name);
    graph->setAdaptiveSampling(false);
    if (steps) graph->setLineStyle(QCPGraph::lsStepLeft);
    QVector<double> x, y;
    for (const std::size_t i : visiblePoints(values, kTimelinePoints)) {
        if (!std::isfinite(t[i])) continue;
        x << t[i] * timeFactor;
        y << values[i];
    }
    graph->setData(x, y);
    if (legend != nullptr) graph->addToLegend(legend);
}

bool anyKnown(const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

QCPRange timeRange(const TimelineFigure& figure) {
    double low = kUnknown, high = kUnknown;
    const auto include = [&](double t) {
        if (!std::isfinite(t)) return;
        low = std::fmin(low, t);
        high = std::fmax(high, t);
    };
    for (const double t : figure.t_s) include(t);
    for (const auto& train : figure.trains) include(train.t_s);
    for (const auto& fault : figure.faults) include(fault.t_s);
    if (!std::isfinite(low)) return {0, 0};
    return padded(low, high, 0.01);
}

/// Draws delivered trains as bars from 0 and refused trains as crosses on the axis.
double addTrains(QCPAxisRect* axes, QCPLegend* legend, const TimelineFigure& figure) {
    double highest = 0;
    std::vector<double> t, a;
    QVector<double> refused, zeros;
    for (const auto& train : figure.trains) {
        if (!std::isfinite(train.t_s)) continue;
        if (train.refused) {
            refused << train.t_s;
            zeros << 0;
        } else if (std::isfinite(train.amplitude_v)) {
            t.push_back(train.t_s);
            a.push_back(train.amplitude_v);
            highest = std::max(highest, train.amplitude_v);
        }
    }
    if (!t.empty()) {
        auto* delivered = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
        delivered->setLineStyle(QCPGraph::lsImpulse);
        delivered->setPen(QPen(ink::kVoltage, t.size() > 150 ? 0.7 : 1.4));
        delivered->setName("train delivered");
        QVector<double> x, y;
        for (const std::size_t i : visiblePoints(a, kTimelinePoints)) {
            x << t[i];
            y << a[i];
        }
        delivered->setData(x, y);
        delivered->addToLegend(legend);
    }
    if (!refused.isEmpty()) {
        auto* crosses = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
        crosses->setLineStyle(QCPGraph::lsNone);
        crosses->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCross, QPen(ink::kText, 1.2), Qt::NoBrush, 6));
        crosses->setName("train refused");
        if (refused.size() > static_cast<qsizetype>(kTimelinePoints)) {
            const auto step = refused.size() / static_cast<qsizetype>(kTimelinePoints) + 1;
            QVector<double> fewer;
            for (qsizetype i = 0; i < refused.size(); i += step) fewer << refused[i];
            refused = fewer;
            zeros.resize(refused.size());
        }
        crosses->setData(refused, zeros);
        crosses->addToLegend(legend);
    }
    return highest;
}

void addFaults(PlotSheet& sheet, const std::vector<QCPAxisRect*>& plots, const TimelineFigure& figure) {
    int named = 0;
    for (const auto& fault : figure.faults) {
        if (!std::isfinite(fault.t_s)) continue;
        for (auto* axes : plots) {
            auto* line = new QCPGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
            line->setPen(QPen(ink::kFault, 1.2));
            const auto range = axes->axis(QCPAxis::atLeft)->range();
            line->setData({fault.t_s, fault.t_s}, {range.lower, range.upper});
        }
        if (plots.empty() || named >= 4) continue;  // the event table names all faults
        const auto range = plots.front()->axis(QCPAxis::atBottom)->range();
        const bool late = fault.t_s > range.center();
        auto* name = sheet.addNote(plots.front(), " " + fault.text + " ",
                                   {(fault.t_s - range.lower) / range.size(), 0.04 + 0.16 * named++},
                                   (late ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignTop);
        name->setColor(ink::kFault);
        name->setBrush(QColor(255, 255, 255, 200));
    }
}

}  // namespace

std::unique_ptr<PlotSheet> drawTimeline(const TimelineFigure& figure, bool simulated) {
    const QCPRange span = timeRange(figure);
    if (!(span.size() > 0)) return emptySheet("Nothing happened in this run: no frame, no train.", simulated);
    const bool inputs = anyKnown(figure.r) || anyKnown(figure.p);
    auto sheet = std::make_unique<PlotSheet>(kSheetWidth, 336, simulated);
    auto* margins = new QCPMarginGroup(&sheet->plot());
    std::vector<QCPAxisRect*> plots;

    auto* upper = sheet->addAxes(1, 0);
    auto* upperLegend = sheet->addLegend(0, 0, 4);
    upper->axis(QCPAxis::atLeft)->setRange(0, 1.02);
    upper->axis(QCPAxis::atLeft)->setLabel(axisTitle("Index", "0 to 1"));
    upper->axis(QCPAxis::atBottom)->setTickLabels(false);
    if (inputs) {
        sheet->watermark(upper);
        if (anyKnown(figure.r)) {
            addSeries(upper, upperLegend, figure.t_s, 1, figure.r, QPen(QColor(0xd5, 0x5e, 0x00), 1.2), "roughness R",
                      false);
        }
        if (anyKnown(figure.p)) {
            addSeries(upper, upperLegend, figure.t_s, 1, figure.p, QPen(ink::kVoltage, 1.2, Qt::DashLine), "pressure P",
                      false);
        }
        plots.push_back(upper);
    } else {
        sheet->explain(upper, "Neither roughness nor pressure was known in this run.");
    }

    auto* lower = sheet->addAxes(3, 0);
    auto* lowerLegend = sheet->addLegend(2, 0, 4);
    sheet->watermark(lower);
    double highest = addTrains(lower, lowerLegend, figure);
    if (anyKnown(figure.amplitude_v)) {
        for (const double a : figure.amplitude_v) highest = std::isfinite(a) ? std::max(highest, a) : highest;
        addSeries(lower, lowerLegend, figure.t_s, 1, figure.amplitude_v, QPen(ink::kQuiet, 1, Qt::DashLine),
                  "amplitude encoded", true);
    }
    lower->axis(QCPAxis::atLeft)->setRange(highest > 0 ? -0.05 * highest : 0, highest > 0 ? 1.1 * highest : 1);
    lower->axis(QCPAxis::atLeft)->setLabel(axisTitle("Amplitude", "V"));
    lower->axis(QCPAxis::atBottom)->setLabel(axisTitle("Time", "s"));
    lower->axis(QCPAxis::atBottom)->setTicker(QSharedPointer<PlainTicker>::create(8));
    upper->axis(QCPAxis::atBottom)->setTicker(QSharedPointer<PlainTicker>::create(8));
    if (lowerLegend->itemCount() == 0) {
        sheet->addNote(lower, "No train was delivered.", {0.5, 0.35})->setColor(ink::kQuiet);
    }
    plots.push_back(lower);
    for (auto* axes : {upper, lower}) {
        axes->axis(QCPAxis::atBottom)->setRange(span);
        axes->setMarginGroup(QCP::msLeft | QCP::msRight, margins);
    }
    addFaults(*sheet, plots, figure);
    PlotSheet::fitLegend(upperLegend);
    PlotSheet::fitLegend(lowerLegend);
    return sheet;
}

}  // namespace tacto
