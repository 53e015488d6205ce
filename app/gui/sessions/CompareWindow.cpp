#include "app/gui/sessions/CompareWindow.h"

#include <QHeaderView>
#include <QScreen>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/runner/ResultTables.h"
#include "app/gui/sessions/SessionPreview.h"
#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/PlotLegend.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/FigureDrawing.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "core/base/JsonText.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

namespace {

constexpr int kFigureChars = 40, kFigureLines = 10;  // least size of the figure in characters and lines
constexpr int kBesideChars = 148;                    // width from which the figure is beside the tables
constexpr int kLines = 34;                           // height at first
constexpr int kTableShare = 62;                      // of width or height, in %
constexpr double kSameTime_s = 0.01;                 // samples of two streams this close are of the same time

/// Returns B less A at the times that both have.
std::pair<std::vector<double>, std::vector<double>> differenceOf(const std::vector<double>& ta,
                                                                 const std::vector<double>& va,
                                                                 const std::vector<double>& tb,
                                                                 const std::vector<double>& vb) {
    std::vector<double> t, difference;
    std::size_t j = 0;
    for (std::size_t i = 0; i < ta.size() && !tb.empty(); ++i) {
        while (j + 1 < tb.size() && std::abs(tb[j + 1] - ta[i]) <= std::abs(tb[j] - ta[i])) ++j;
        if (std::abs(tb[j] - ta[i]) > kSameTime_s) continue;
        t.push_back(ta[i]);
        difference.push_back(vb[j] - va[i]);
    }
    return {std::move(t), std::move(difference)};
}

/// Returns the first capture of each condition.
std::map<std::string, std::int64_t> capturesOf(const ReadSession& session) {
    std::map<int, std::string> conditions;
    for (const auto& trial : session.trials) conditions[trial.number] = trial.condition;
    std::map<std::string, std::int64_t> first;
    for (const auto& capture : session.captures)
        if (capture.trial && conditions.contains(*capture.trial))
            first.try_emplace(conditions[*capture.trial], capture.seq);
    return first;
}

}  // namespace

CompareWindow::CompareWindow(std::shared_ptr<const ReadSession> a, std::shared_ptr<const ReadSession> b,
                             QWidget* parent)
    : QDialog(parent), sessions_{std::move(a), std::move(b)} {
    const auto beganOf = [](const ReadSession& session) {
        return QDateTime::fromString(qtext(session.about.wallStart), Qt::ISODate).toLocalTime();
    };
    QString names[2];
    for (std::size_t s = 0; s < 2; ++s) {
        const auto& session = *sessions_[s];
        const auto sample = qtext(session.labels.sample);
        names[s] = QString("%1, %2%3")
                       .arg(procedureText(session.about.protocol), beganText(beganOf(session)),
                            sample.isEmpty() ? sample : tr(", sample %1").arg(sample));
    }
    if (names[0] == names[1])
        for (std::size_t s = 0; s < 2; ++s) names[s] += beganOf(*sessions_[s]).toString(":ss");
    setWindowTitle(tr("Compare %1 with %2").arg(names[0], names[1]));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(explanation(tr("A: %1. B: %2.").arg(names[0], names[1]), this));
    split_ = new QSplitter(this);
    split_->setChildrenCollapsible(false);
    auto* page = new ScrollingPage(split_);
    tables_ = new ResultTables(page->viewport());
    nameWidget(*tables_, "comparison", tr("What differs"));
    tables_->show(toJson(compareTwo(*sessions_[0], *sessions_[1])));
    page->hold(tables_);
    split_->addWidget(page);
    split_->addWidget(buildFigure(split_));
    layout->addWidget(split_, 1);
    offerCaptures();
    offerTrials();
    offerStreams();
    which_->setEnabled(!drawn_.empty());
    if (drawn_.empty()) which_->addItem(tr("Nothing that both hold can be drawn"));
    connect(which_, &QComboBox::currentIndexChanged, this, &CompareWindow::draw);
    draw();
    onLookChange(*this, [this] { colour(); });
    afterLookChange(*this, [this] { QTimer::singleShot(0, this, &CompareWindow::fit); });
    onEvent(*this, QEvent::Resize, [this] { fit(); });
    const QSize wanted(fontMetrics().averageCharWidth() * kBesideChars, fontMetrics().height() * kLines);
    resize(wanted.boundedTo(screen()->availableSize()));
}

/// Places the figure beside the tables, or below them in a narrow window; the names of quantities take the room that
/// numbers leave.
void CompareWindow::fit() {
    const bool beside = width() >= fontMetrics().averageCharWidth() * kBesideChars;
    const auto way = beside ? Qt::Horizontal : Qt::Vertical;
    if (!fitted_ || split_->orientation() != way) {
        fitted_ = true;
        split_->setOrientation(way);
        const int all = beside ? width() : height();
        split_->setSizes({all * kTableShare / 100, all * (100 - kTableShare) / 100});
    }
    for (auto* table : tables_->findChildren<QTableWidget*>()) {
        if (!table->horizontalHeaderItem(0)->text().startsWith("Quantity")) continue;
        table->horizontalHeader()->setStretchLastSection(false);
        table->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
    }
}

QWidget* CompareWindow::buildFigure(QWidget* parent) {
    auto* page = new QWidget(parent);
    auto* column = columnIn(*page);
    which_ = new QComboBox(page);
    nameWidget(*which_, "drawn", tr("Drawn of both"));
    column->addWidget(which_);
    plot_ = new QCustomPlot(page);
    nameWidget(*plot_, "both", tr("The same of both"));
    plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    plot_->setMinimumSize(fontMetrics().averageCharWidth() * kFigureChars, fontMetrics().height() * kFigureLines);
    addPlotMenu(*plot_, "compared");
    onEvent(*plot_, QEvent::Resize, [this] {  // fewer numbers where the axis is short
        plot_->yAxis->ticker()->setTickCount(std::clamp(plot_->height() / (4 * fontMetrics().height()), 2, 5));
        plot_->replot(QCustomPlot::rpQueuedReplot);
    });
    putLegendAbove(*plot_);
    column->addWidget(plot_, 1);
    marks_ = std::make_unique<MarkLines>(*plot_);
    connect(plot_->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &CompareWindow::drawMarks);
    addWatermark(*plot_->axisRect(), WatermarkPlace::InFront)
        ->setVisible(sessions_[0]->about.simulated || sessions_[1]->about.simulated);
    return page;
}

void CompareWindow::offer(Drawn drawn) {
    which_->addItem(drawn.title);
    drawn_.push_back(std::move(drawn));
}

void CompareWindow::offerTrials() {
    const auto holds = [](const auto& session) {
        return std::ranges::any_of(session->trials, [](const SessionTrial& trial) {
            return std::isfinite(numberOr(trial.measured, "interval_s")) &&
                   std::isfinite(numberOr(trial.measured, "amplitude_v"));
        });
    };
    if (holds(sessions_[0]) && holds(sessions_[1])) offer({.title = tr("Trials: amplitude against interval")});
}

void CompareWindow::offerStreams() {
    for (const auto& info : sessions_[0]->streams) {
        const auto& others = sessions_[1]->streams;
        const auto same = std::ranges::find_if(others, [&](const auto& other) { return other.stream == info.stream; });
        if (same == others.end() || info.samples == 0 || same->samples == 0) continue;
        for (std::size_t c = 0; c < info.stream.columns.size(); ++c) {
            const auto name = titled(qtext(info.stream.name));
            const bool only = info.stream.columns.size() == 1;
            offer({.source = Source::Stream,
                   .title = only ? name : QString("%1: %2").arg(name, columnTitle(info.stream, c)),
                   .unit = columnUnit(info.stream, c),
                   .at = {info.id, same->id},
                   .column = c});
        }
    }
}

void CompareWindow::offerCaptures() {
    const auto a = capturesOf(*sessions_[0]), b = capturesOf(*sessions_[1]);
    for (const auto& [condition, seq] : a) {
        const auto same = b.find(condition);
        if (same == b.end()) continue;
        const auto name = conditionText(condition);
        offer({.source = Source::Capture,
               .title = name.isEmpty() ? tr("First capture") : tr("Capture: %1").arg(name),
               .at = {seq, same->second}});
    }
}

Result<CompareWindow::Both> CompareWindow::read(const std::array<std::filesystem::path, 2>& paths, const Drawn& drawn) {
    Both both;
    for (std::size_t s = 0; s < 2; ++s) {
        auto& trace = both[s];
        const auto reader = SessionReader::open(paths[s]);
        if (!reader) return failure(reader);
        if (drawn.source == Source::Capture) {
            const auto capture = reader->capture(drawn.at[s]);
            if (!capture) return failure(capture);
            if (capture->channels.empty()) continue;
            const auto* voltage = channelOf(*capture, "voltage");
            const auto& channel = voltage != nullptr ? *voltage : capture->channels.front();
            const double from = std::isfinite(capture->trigger_s) ? capture->start_s - capture->trigger_s : 0;
            trace.y.assign(channel.samples.begin(), channel.samples.end());
            for (std::size_t i = 0; i < trace.y.size(); ++i)
                trace.t.push_back(from + static_cast<double>(i) / capture->rate_hz);
        } else {
            const auto block = reader->samples(int(drawn.at[s]));
            if (!block) return failure(block);
            if (block->samples() == 0) continue;
            const auto columns = block->values.size() / block->samples();
            trace.begins_s = block->t_s.front();
            for (std::size_t i = 0; i < block->samples(); ++i) {
                trace.t.push_back(block->t_s[i] - trace.begins_s);
                trace.y.push_back(block->values[i * columns + drawn.column]);
            }
        }
    }
    return both;
}

void CompareWindow::draw() {
    plot_->clearGraphs();
    plot_->legend->setVisible(false);
    drawMarks();
    if (drawn_.empty()) return colour();
    const auto drawn = drawn_[std::size_t(which_->currentIndex())];
    if (drawn.source == Source::Trials) return drawTrials();
    background_.take([drawn, paths = std::array{sessions_[0]->path, sessions_[1]->path}](
                         const WorkPort&) { return read(paths, drawn); },
                     [this, drawn](Result<Both> both) {
                         if (both) overlay(std::move(*both), drawn);
                     });
}

void CompareWindow::drawTrials() {
    for (std::size_t s = 0; s < 2; ++s) {
        auto* graph = plot_->addGraph();
        graph->setName(s == 0 ? tr("A") : tr("B"));
        graph->setLineStyle(QCPGraph::lsNone);
        for (const auto& trial : sessions_[s]->trials) {
            const double x = numberOr(trial.measured, "interval_s"), y = numberOr(trial.measured, "amplitude_v");
            if (std::isfinite(x) && std::isfinite(y)) graph->addData(x, y);
        }
    }
    plot_->xAxis->setLabel(tr("Interval (s)"));
    plot_->yAxis->setLabel(tr("Amplitude (V)"));
    plot_->legend->setVisible(true);
    plot_->rescaleAxes();
    plot_->xAxis->scaleRange(1.2);
    plot_->yAxis->scaleRange(1.2);
    colour();
}

/// Draws both traces from their beginnings or triggers, and of streams the difference at the times that both have.
void CompareWindow::overlay(Both both, const Drawn& drawn) {
    plot_->clearGraphs();
    if (both[0].t.empty() || both[1].t.empty()) return colour();
    const bool capture = drawn.source == Source::Capture;
    Reach reach, span;
    for (const auto& trace : both) {
        for (const double value : trace.y) reach.include(value);
        for (const double at : trace.t) span.include(at);
    }
    const auto unit = axisUnit(reach.magnitude(), capture ? QStringLiteral("V") : drawn.unit);
    const auto time = axisUnit(span.magnitude(), "s");
    for (std::size_t s = 0; s < 2; ++s) {
        for (double& value : both[s].y) value *= unit.factor;
        begins_s_[s] = both[s].begins_s;
    }
    auto difference = differenceOf(both[0].t, both[0].y, both[1].t, both[1].y);
    const auto shown = [&](std::vector<double> t, const std::vector<double>& y, const QString& name) {
        if (capture)
            for (double& at : t) at *= time.factor;
        addCurve(*plot_, plot_->yAxis, t, y, name);
    };
    shown(both[0].t, both[0].y, tr("A"));
    shown(both[1].t, both[1].y, tr("B"));
    if (!capture && !difference.first.empty()) shown(difference.first, difference.second, tr("B less A"));
    plot_->legend->setVisible(true);
    plot_->xAxis->setLabel(capture ? axisTitle(tr("Time from the trigger"), time.unit)
                                   : tr("Time from the first sample (s)"));
    plot_->yAxis->setLabel(axisTitle(capture ? tr("Voltage") : drawn.title.section(": ", -1), unit.unit));
    plot_->rescaleAxes();
    drawMarks();
    colour();
}

/// Draws the marks of both sessions on their streams; like the traces, each counts from its first sample.
void CompareWindow::drawMarks() {
    std::vector<PlotMark> marks;
    const bool stream = !drawn_.empty() && drawn_[std::size_t(which_->currentIndex())].source == Source::Stream;
    for (std::size_t s = 0; s < 2 && stream && plot_->graphCount() > 0; ++s) {
        for (const auto& [at_s, word] : operatorMarks(*sessions_[s]))
            marks.push_back({at_s - begins_s_[s], (s == 0 ? tr("A: ") : tr("B: ")).toStdString() + word});
    }
    marks_->draw(marks, {plot_->axisRect()});
}

/// Applies the current theme and text size.
void CompareWindow::colour() {
    stylePlot(*plot_);
    const QColor colourOf[] = {colours().voltage, colours().current, colours().third};
    for (int i = 0; i < plot_->graphCount(); ++i) {
        auto* graph = plot_->graph(i);
        const auto& of = colourOf[i];
        graph->setPen(QPen(of, 1, i == 1 ? Qt::DashLine : Qt::SolidLine));
        if (graph->lineStyle() == QCPGraph::lsNone)
            graph->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(of, 1.5),
                                                   i == 0 ? QBrush(Qt::NoBrush) : QBrush(of), i == 0 ? 10 : 6));
    }
    marks_->colour();
    fitLegend(*plot_);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace tacto::gui

#include "moc_CompareWindow.cpp"
