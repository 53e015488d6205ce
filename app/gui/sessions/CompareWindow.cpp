#include "app/gui/sessions/CompareWindow.h"

#include <QHeaderView>
#include <QSplitter>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"
#include "app/gui/look/PlotPicture.h"
#include "app/gui/look/Text.h"
#include "app/report/FigureDrawing.h"
#include "core/base/JsonText.h"
#include "core/session/SessionReader.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kDrawnPoints = 4000;

void flatten(const nlohmann::json& value, const QString& at, QMap<QString, QString>& into) {
    if (value.is_object()) {
        for (const auto& [key, part] : value.items()) {
            if (key == "trials" || key == "people") continue;  // one by one they say nothing here
            flatten(part, at.isEmpty() ? qtext(key) : at + "." + qtext(key), into);
        }
    } else if (value.is_array()) {
        int index = 0;
        for (const auto& part : value) {
            const auto named = part.is_object() && part.contains("name") && part["name"].is_string();
            flatten(part, at + "." + (named ? qtext(part["name"].get<std::string>()) : QString::number(index)), into);
            ++index;
        }
    } else {
        into[at] = value.is_number_float() ? QString::number(value.get<double>(), 'g', 6) : qtext(value.dump());
    }
}

QMap<QString, QString> facts(const ReadSession& session) {
    QMap<QString, QString> all;
    flatten(session.about.parameters, QObject::tr("parameter"), all);
    if (const auto profile = parseJson(session.about.profileJson, "the profile")) {
        flatten(*profile, QObject::tr("profile"), all);
    }
    for (const auto& device : session.about.devices)
        all[QObject::tr("device %1").arg(qtext(device.role))] = qtext(device.uri);
    all[QObject::tr("protocol")] = qtext(session.about.protocol);
    all[QObject::tr("seed")] = QString::number(session.about.seed);
    all[QObject::tr("program")] = qtext(session.about.programVersion);
    for (const auto& verdict : session.verdicts) {
        all[QObject::tr("verdict")] = qtext(verdict.verdict);
        flatten(verdict.results, QObject::tr("result"), all);
    }
    return all;
}

double feature(const SessionTrial& trial, const char* key) {
    const auto at = trial.measured.find(key);
    return at != trial.measured.end() && at->is_number() ? at->get<double>() : std::nan("");
}

}  // namespace

QList<QStringList> CompareWindow::differences(const ReadSession& first, const ReadSession& second) {
    const auto a = facts(first), b = facts(second);
    auto keys = a.keys() + b.keys();
    keys.removeDuplicates();
    std::sort(keys.begin(), keys.end());
    QList<QStringList> rows;
    for (const auto& key : keys) {
        if (a.value(key) != b.value(key)) rows << QStringList{key, a.value(key, "–"), b.value(key, "–")};
    }
    return rows;
}

CompareWindow::CompareWindow(std::shared_ptr<const ReadSession> first, std::shared_ptr<const ReadSession> second,
                             QWidget* parent)
    : QDialog(parent), sessions_{std::move(first), std::move(second)} {
    const QString names[] = {qtext(sessions_[0]->path.stem().string()), qtext(sessions_[1]->path.stem().string())};
    setWindowTitle(tr("Compare %1 with %2").arg(names[0], names[1]));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(explanation(
        tr("Hollow marks and the first trace: %1. Filled marks and the second trace: %2.").arg(names[0], names[1]),
        this));
    auto* tabs = new QTabWidget(this);
    plane_ = new QCustomPlot(tabs);
    plane_->setAccessibleName(tr("Trials of both"));
    addPlotMenu(*plane_, "trials");
    plane_->xAxis->setLabel(tr("interval (s)"));
    plane_->yAxis->setLabel(tr("amplitude (V)"));
    tabs->addTab(plane_, tr("&Trials"));
    auto* page = new QWidget(tabs);
    auto* column = new QVBoxLayout(page);
    stream_ = new QComboBox(page);
    stream_->setAccessibleName(tr("Stream"));
    for (const auto& info : sessions_[0]->streams) {
        const auto same = std::any_of(sessions_[1]->streams.begin(), sessions_[1]->streams.end(),
                                      [&](const auto& other) { return other.stream == info.stream; });
        if (same) stream_->addItem(qtext(info.stream.name));
    }
    column->addWidget(stream_);
    streams_ = new QCustomPlot(page);
    streams_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    streams_->setAccessibleName(tr("The stream of both"));
    addPlotMenu(*streams_, "streams");
    column->addWidget(streams_, 1);
    tabs->addTab(page, tr("&Streams"));
    auto* table = new QTableWidget(tabs);
    const auto rows = differences(*sessions_[0], *sessions_[1]);
    table->setColumnCount(3);
    table->setHorizontalHeaderLabels({tr("What differs"), names[0], names[1]});
    table->setRowCount(int(rows.size()));
    for (int r = 0; r < int(rows.size()); ++r) {
        for (int c = 0; c < 3; ++c) table->setItem(r, c, new QTableWidgetItem(rows[r][c]));
    }
    table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    tabs->addTab(table, tr("&Differences (%1)").arg(rows.size()));
    layout->addWidget(tabs, 1);
    connect(stream_, &QComboBox::currentIndexChanged, this, &CompareWindow::drawStream);
    drawTrials();
    drawStream();
    if (plane_->graphCount() == 0) tabs->setCurrentIndex(1);
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
                const auto look = conditionLook(name, order[name]);
                graph = plane_->addGraph();
                graph->setName(QString("%1, %2").arg(name, s == 0 ? tr("first") : tr("second")));
                graph->setLineStyle(QCPGraph::lsNone);
                graph->setScatterStyle(QCPScatterStyle(look.marker, QPen(look.color, 1.5),
                                                       s == 0 ? QBrush(Qt::NoBrush) : QBrush(look.color),
                                                       s == 0 ? 10 : 6));
            }
            const double x = feature(trial, "interval_s"), y = feature(trial, "amplitude_v");
            if (std::isfinite(x) && std::isfinite(y)) graph->addData(x, y);
        }
    }
    if (plane_->graphCount() == 0) {
        auto* none = new QCPItemText(plane_);
        none->position->setType(QCPItemPosition::ptAxisRectRatio);
        none->position->setCoords(0.5, 0.5);
        none->setText(tr("Neither session holds a trial."));
        none->setColor(colours().quiet);
    }
    stylePlot(*plane_);
    plane_->legend->setVisible(plane_->graphCount() > 0);
    plane_->legend->setTextColor(colours().text);
    plane_->legend->setBrush(QBrush(colours().base));
    plane_->rescaleAxes();
    plane_->xAxis->scaleRange(1.2);
    plane_->yAxis->scaleRange(1.2);
}

void CompareWindow::drawStream() {
    if (stream_->count() == 0) return;
    const auto name = stream_->currentText().toStdString();
    auto samples = std::make_shared<std::array<SampleBlock, 2>>();
    std::array<std::pair<std::filesystem::path, int>, 2> where;
    std::size_t columns = 1;
    for (std::size_t s = 0; s < 2; ++s) {
        for (const auto& info : sessions_[s]->streams) {
            if (info.stream.name != name) continue;
            where[s] = {sessions_[s]->path, info.id};
            columns = info.stream.columns.size();
        }
    }
    background_.start(
        [samples, where](const WorkPort&) -> Result<void> {
            for (std::size_t s = 0; s < 2; ++s) {
                const auto reader = SessionReader::open(where[s].first);
                if (!reader) return failure(reader);
                auto read = reader->samples(where[s].second);
                if (!read) return failure(read);
                (*samples)[s] = std::move(*read);
            }
            return {};
        },
        [this, samples, columns, label = stream_->currentText()](const Result<void>& done) {
            if (done) overlay((*samples)[0], (*samples)[1], columns, label);
        });
}

/// Both from their own beginning; the difference below, where the second has a sample at the same time.
void CompareWindow::overlay(const SampleBlock& a, const SampleBlock& b, std::size_t columns, const QString& label) {
    streams_->clearGraphs();
    const auto shown = [&](const std::vector<double>& t, const std::vector<double>& values, const QString& name,
                           const QPen& pen) {
        QVector<double> x, y;
        for (const auto i : visiblePoints(values, kDrawnPoints)) {
            x << t[i] - t.front();
            y << values[i];
        }
        auto* graph = streams_->addGraph();
        graph->setName(name);
        graph->setData(x, y, true);
        graph->setPen(pen);
    };
    const auto column = [&](const SampleBlock& block) {
        std::vector<double> values(block.samples());
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = block.values[i * columns];
        return values;
    };
    if (a.samples() == 0 || b.samples() == 0) return;
    const auto va = column(a), vb = column(b);
    shown(a.t_s, va, tr("first"), QPen(colours().voltage));
    shown(b.t_s, vb, tr("second"), QPen(colours().current, 1, Qt::DashLine));
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
    if (!t.empty()) shown(t, difference, tr("first less second"), QPen(colours().math));
    stylePlot(*streams_);
    streams_->legend->setVisible(true);
    streams_->legend->setTextColor(colours().text);
    streams_->legend->setBrush(QBrush(colours().base));
    streams_->xAxis->setLabel(tr("time from the first sample (s)"));
    streams_->yAxis->setLabel(label);
    streams_->rescaleAxes();
    streams_->replot();
}

}  // namespace tacto::gui
