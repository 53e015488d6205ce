#include "app/gui/sessions/CompareWindow.h"

#include <QTextBrowser>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/sessions/Differences.h"
#include "app/gui/sessions/SessionPreview.h"
#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/PlotLegend.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/FigureDrawing.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

namespace {

constexpr int kPlotChars = 30;  // width in characters at which a plot is readable

double feature(const SessionTrial& trial, const char* key) {
    const auto at = trial.measured.find(key);
    return at != trial.measured.end() && at->is_number() ? at->get<double>() : std::nan("");
}

QString differencesHtml(const QList<Difference>& all) {
    if (all.isEmpty()) return "<p>" + CompareWindow::tr("The two sessions do not differ.") + "</p>";
    QString html;
    std::optional<Difference::About> part;
    for (const auto& [about, sentence] : all) {
        if (part != about)
            html += "<h3>" +
                    (about == Difference::About::Found ? CompareWindow::tr("What was found")
                                                       : CompareWindow::tr("What was used")) +
                    "</h3>";
        part = about;
        html += "<p>" + sentence.toHtmlEscaped() + "</p>";
    }
    return html;
}

}  // namespace

CompareWindow::CompareWindow(std::shared_ptr<const ReadSession> first, std::shared_ptr<const ReadSession> second,
                             QWidget* parent)
    : QDialog(parent), sessions_{std::move(first), std::move(second)} {
    const auto beganOf = [](const ReadSession& session) {
        return QDateTime::fromString(qtext(session.about.wallStart), Qt::ISODate).toLocalTime();
    };
    const auto nameOf = [&](const ReadSession& session) {
        const auto began = beganOf(session);
        const auto sample = qtext(session.labels.sample);
        return QString("%1, %2%3")
            .arg(procedureText(session.about.protocol), beganText(began),
                 sample.isEmpty() ? sample : tr(", sample %1").arg(sample));
    };
    QString names[] = {nameOf(*sessions_[0]), nameOf(*sessions_[1])};
    if (names[0] == names[1]) {
        for (int s = 0; s < 2; ++s) names[s] += beganOf(*sessions_[s]).toString(":ss");
    }
    setWindowTitle(tr("Compare %1 with %2").arg(names[0], names[1]));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(
        explanation(tr("First, hollow marks and the solid trace: %1. Second, filled marks and the dashed trace: %2.")
                        .arg(names[0], names[1]),
                    this));
    auto* tabs = new QTabWidget(this);
    plane_ = new QCustomPlot(tabs);
    plane_->setAccessibleName(tr("Trials of both"));
    addPlotMenu(*plane_, "trials");
    putLegendAbove(*plane_);
    wrapLegend(*plane_);
    plane_->setMinimumWidth(fontMetrics().averageCharWidth() * kPlotChars);  // the width within which the legend wraps
    plane_->xAxis->setLabel(tr("Interval (s)"));
    plane_->yAxis->setLabel(tr("Amplitude (V)"));
    tabs->addTab(plane_, tr("&Trials"));
    auto* page = new QWidget(tabs);
    auto* column = new QVBoxLayout(page);
    stream_ = new QComboBox(page);
    stream_->setAccessibleName(tr("Stream"));
    for (const auto& info : sessions_[0]->streams) {
        const auto same = std::any_of(sessions_[1]->streams.begin(), sessions_[1]->streams.end(),
                                      [&](const auto& other) { return other.stream == info.stream; });
        for (std::size_t c = 0; same && c < info.stream.columns.size(); ++c) {
            const auto name = titled(qtext(info.stream.name));
            const auto title = columnTitle(info.stream, c);
            const bool only = info.stream.columns.size() == 1;
            stream_->addItem(only ? name : QString("%1: %2").arg(name, title), QVariant::fromValue(drawn_.size()));
            drawn_.push_back({info.stream, c, only ? name : title, columnUnit(info.stream, c)});
        }
    }
    column->addWidget(stream_);
    streams_ = new QCustomPlot(page);
    streams_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    streams_->setAccessibleName(tr("The stream of both"));
    addPlotMenu(*streams_, "streams");
    putLegendAbove(*streams_);
    column->addWidget(streams_, 1);
    tabs->addTab(page, tr("&Streams"));
    const bool simulated = sessions_[0]->about.simulated || sessions_[1]->about.simulated;
    marks_ = std::make_unique<MarkLines>(*streams_);
    connect(streams_->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &CompareWindow::drawMarks);
    addWatermark(*plane_->axisRect())->setVisible(simulated);
    addWatermark(*streams_->axisRect(), WatermarkPlace::InFront)->setVisible(simulated);
    const auto found = differencesOf(*sessions_[0], *sessions_[1]);
    auto* said = new QTextBrowser(tabs);
    nameWidget(*said, "differences", tr("Differences"));
    said->setTabChangesFocus(true);
    said->setHtml(differencesHtml(found));
    tabs->insertTab(0, said, tr("&Differences (%1)").arg(found.size()));
    tabs->setCurrentIndex(0);
    layout->addWidget(tabs, 1);
    connect(stream_, &QComboBox::currentIndexChanged, this, &CompareWindow::drawStream);
    drawTrials();
    drawStream();
    onLookChange(*this, [this] { colour(); });
    resize(fontMetrics().averageCharWidth() * 120, fontMetrics().height() * 36);
}

void CompareWindow::drawTrials() {
    QMap<QString, int> order;
    for (int s = 0; s < 2; ++s) {
        QMap<QString, QCPGraph*> graphs;
        for (const auto& trial : sessions_[s]->trials) {
            const auto name = qtext(trial.condition);
            if (!order.contains(name)) order[name] = int(order.size());
            auto*& graph = graphs[name];
            if (graph == nullptr) {
                graph = plane_->addGraph();
                graph->setName(QString("%1, %2").arg(name, s == 0 ? tr("first") : tr("second")));
                graph->setLineStyle(QCPGraph::lsNone);
                trials_.push_back({graph, name, order[name], s == 0});
            }
            const double x = feature(trial, "interval_s"), y = feature(trial, "amplitude_v");
            if (std::isfinite(x) && std::isfinite(y)) graph->addData(x, y);
        }
    }
    if (plane_->graphCount() == 0) {
        noTrials_ = new QCPItemText(plane_);
        noTrials_->position->setType(QCPItemPosition::ptAxisRectRatio);
        noTrials_->position->setCoords(0.5, 0.5);
        noTrials_->setText(tr("Neither session holds a trial."));
        for (auto* axis : {plane_->xAxis, plane_->yAxis}) {
            axis->setTicks(false);
            axis->setTickLabels(false);
            axis->grid()->setVisible(false);
        }
    }
    plane_->legend->setVisible(plane_->graphCount() > 0);
    colourTrials();
    plane_->rescaleAxes();
    plane_->xAxis->scaleRange(1.2);
    plane_->yAxis->scaleRange(1.2);
}

/// Applies the current theme and text size, also to everything coloured below.
void CompareWindow::colour() {
    colourTrials();
    colourStreams();
    for (auto* plot : {plane_, streams_}) plot->replot(QCustomPlot::rpQueuedReplot);
}

void CompareWindow::colourTrials() {
    stylePlot(*plane_);
    if (noTrials_ != nullptr) {
        noTrials_->setColor(colours().quiet);
        noTrials_->setFont(textFont(TextSize::Body));
    }
    for (const auto& [graph, condition, number, first] : trials_) {
        const auto style = conditionInTheme(condition, number);
        graph->setScatterStyle(QCPScatterStyle(style.marker, QPen(style.color, 1.5),
                                               first ? QBrush(Qt::NoBrush) : QBrush(style.color), first ? 10 : 6));
    }
    fitLegend(*plane_);
}

void CompareWindow::colourStreams() {
    stylePlot(*streams_);
    const QPen pens[] = {QPen(colours().voltage), QPen(colours().current, 1, Qt::DashLine), QPen(colours().third)};
    for (int i = 0; i < streams_->graphCount(); ++i) streams_->graph(i)->setPen(pens[i]);
    marks_->colour();
    fitLegend(*streams_);
}

void CompareWindow::drawStream() {
    if (stream_->count() == 0) return;
    const auto& drawn = drawn_[stream_->currentData().toULongLong()];
    std::array<std::pair<std::filesystem::path, int>, 2> where;
    for (std::size_t s = 0; s < 2; ++s) {
        for (const auto& info : sessions_[s]->streams) {
            if (info.stream == drawn.stream) where[s] = {sessions_[s]->path, info.id};
        }
    }
    using Samples = std::array<SampleBlock, 2>;
    background_.take(
        [where](const WorkPort&) -> Result<Samples> {
            Samples samples;
            for (std::size_t s = 0; s < 2; ++s) {
                const auto reader = SessionReader::open(where[s].first);
                if (!reader) return failure(reader);
                auto read = reader->samples(where[s].second);
                if (!read) return failure(read);
                samples[s] = std::move(*read);
            }
            return samples;
        },
        [this, drawn](const Result<Samples>& samples) {
            if (samples) overlay((*samples)[0], (*samples)[1], drawn);
        });
}

/// Draws each stream from its own beginning, and below them the difference at the times that both have.
void CompareWindow::overlay(const SampleBlock& a, const SampleBlock& b, const Drawn& drawn) {
    streams_->clearGraphs();
    const auto shown = [&](std::vector<double> t, const std::vector<double>& values, const QString& name) {
        for (const double from = t.front(); double& at_s : t) at_s -= from;
        addCurve(*streams_, streams_->yAxis, t, values, name);
    };
    const auto column = [&](const SampleBlock& block) {
        std::vector<double> values(block.samples());
        const auto columns = drawn.stream.columns.size();
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = block.values[i * columns + drawn.column];
        return values;
    };
    if (a.samples() == 0 || b.samples() == 0) return;
    auto va = column(a), vb = column(b);
    Reach reach;
    for (const auto* values : {&va, &vb}) std::ranges::for_each(*values, [&](double v) { reach.include(v); });
    const auto unit = axisUnit(reach.magnitude(), drawn.unit);
    for (auto* values : {&va, &vb}) std::ranges::for_each(*values, [&](double& v) { v *= unit.factor; });
    shown(a.t_s, va, tr("first"));
    shown(b.t_s, vb, tr("second"));
    std::vector<double> t, difference;
    std::size_t j = 0;
    for (std::size_t i = 0; i < va.size(); ++i) {
        const double at = a.t_s[i] - a.t_s.front();
        while (j + 1 < vb.size() &&
               std::abs(b.t_s[j + 1] - b.t_s.front() - at) <= std::abs(b.t_s[j] - b.t_s.front() - at))
            ++j;
        if (std::abs(b.t_s[j] - b.t_s.front() - at) > 0.01) continue;
        t.push_back(a.t_s.front() + at);
        difference.push_back(va[i] - vb[j]);
    }
    if (!t.empty()) shown(t, difference, tr("first less second"));
    streams_->legend->setVisible(true);
    colourStreams();
    streams_->xAxis->setLabel(tr("Time from the first sample (s)"));
    streams_->yAxis->setLabel(axisTitle(drawn.title, unit.unit));
    begins_s_ = {a.t_s.front(), b.t_s.front()};
    streams_->rescaleAxes();
    drawMarks();
    streams_->replot();
}

/// Draws the marks of both sessions; like the traces, each counts from the first sample of its stream.
void CompareWindow::drawMarks() {
    std::vector<PlotMark> marks;
    for (std::size_t s = 0; s < 2 && streams_->graphCount() > 0; ++s) {
        for (const auto& [at_s, word] : operatorMarks(*sessions_[s]))
            marks.push_back({at_s - begins_s_[s], (s == 0 ? tr("first: ") : tr("second: ")).toStdString() + word});
    }
    marks_->draw(marks, {streams_->axisRect()});
}

}  // namespace tacto::gui

#include "moc_CompareWindow.cpp"
