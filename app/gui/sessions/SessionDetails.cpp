#include "app/gui/sessions/SessionDetails.h"

#include <QHeaderView>
#include <QTimer>
#include <algorithm>
#include <map>

#include "app/gui/sessions/SessionOverview.h"
#include "app/gui/sessions/SessionPreview.h"
#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/PlotLegend.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/RecordColumns.h"
#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/VerdictBlock.h"
#include "app/report/FigureDrawing.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "core/base/JsonText.h"
#include "core/base/QuantityText.h"
#include "core/dsp/RoughnessFlags.h"

namespace tacto::gui {

namespace {

constexpr int kPlotLines = 10;  // height of a readable plot in lines of text
constexpr int kMinStreams = 2;  // rows
constexpr int kCommand = 2;     // column of captures_

QTableWidget* makeTable(QWidget* parent, const QString& name) {
    auto* table = new QTableWidget(parent);
    table->setAccessibleName(name);
    makeReadOnly(*table);
    table->setSelectionBehavior(QAbstractItemView::SelectRows);
    table->horizontalHeader()->setHighlightSections(false);
    table->setWordWrap(false);
    return table;
}

/// Says in place of the rows why there are none.
void sayIfEmpty(QTableWidget& table, const QString& why) {
    auto* note = table.findChild<QLabel*>("whyEmpty");
    if (note == nullptr) {
        note = makeLabel({}, {.name = "whyEmpty", .tone = Tone::Quiet, .wraps = true, .plain = true}, table.viewport());
        note->setAlignment(Qt::AlignCenter);
        columnIn(*table.viewport())->addWidget(note);
    }
    const bool empty = table.rowCount() == 0;
    table.horizontalHeader()->setVisible(!empty);
    note->setVisible(empty);
    note->setText(empty ? why : QString());
}

using As = ResultColumn::As;
using nlohmann::json;

void fill(QTableWidget& table, const std::vector<ResultColumn>& columns, const json& records) {
    fillRecordTable(table, columns, records);
    fitRecordTable(table);
}

/// Returns a setting in words: a list in sequence, a record as "rows 3, columns 4". Never JSON.
QString settingWords(const json& value, const QString& unit) {
    if (value.is_number()) return settingText(value.get<double>(), unit);
    if (value.is_boolean()) return value.get<bool>() ? SessionDetails::tr("yes") : SessionDetails::tr("no");
    if (value.is_string()) return withOhmSigns(qtext(value.get<std::string>()));
    QStringList parts;
    for (const auto& [key, member] : value.items()) {
        const auto column = value.is_array() ? ColumnName{{}, unit} : columnName(qtext(key));
        const auto words = settingWords(member, column.unit);
        const auto within = member.is_structured() ? '(' + words + ')' : words;
        parts << (column.title.isEmpty() ? within : column.title.toLower() + ' ' + within);
    }
    return parts.isEmpty() ? QString("–") : parts.join(", ");
}

/// Returns the words used in the list of sessions.
QString beganWords(const std::string& wallStart) {
    const auto began = QDateTime::fromString(qtext(wallStart), Qt::ISODate).toLocalTime();
    return began.isValid() ? beganText(began) : QString("–");
}

/// Returns for each unit the prefix that suits all its columns, which share an axis.
std::map<QString, AxisUnit> axisUnitsOf(const SessionStream& stream, const SampleBlock& samples) {
    std::map<QString, Reach> reached;
    const auto columns = stream.columns.size();
    for (std::size_t c = 0; c < columns; ++c) {
        auto& reach = reached[columnUnit(stream, c)];
        for (std::size_t i = 0; i < samples.samples(); ++i) reach.include(samples.values[i * columns + c]);
    }
    std::map<QString, AxisUnit> units;
    for (const auto& [unit, reach] : reached) units[unit] = axisUnit(reach.magnitude(), unit);
    return units;
}

/// Returns the quantity of the columns in the stream's own unit; the list of streams above shows its name.
QString quantityOf(const SessionStream& stream) { return qtext(stream.unit.empty() ? stream.name : stream.kind); }

std::string shownUnitText(const std::string& unit) { return unit.empty() ? std::string("–") : writtenUnit(unit); }

}  // namespace

SessionDetails::SessionDetails(const ShippedLimits& limits, QWidget* parent) : QTabWidget(parent), limits_(limits) {
    setWhatsThis(tr("What the selected session holds. The left and right arrow keys change the page."));
    setDocumentMode(true);
    afterLookChange(*this, [this] { fitLook(); });
    fitTabs();
    overview_ = new SessionOverview(this);
    connect(overview_, &SessionOverview::labelsSaved, this, &SessionDetails::labelsSaved);
    connect(overview_, &SessionOverview::labelsRefused, this, &SessionDetails::labelsRefused);
    about_ = new QTextBrowser(this);
    about_->setAccessibleName(tr("About the session"));
    trials_ = makeTable(this, tr("Trials"));
    split_ = new QSplitter(Qt::Vertical, this);
    split_->setChildrenCollapsible(false);
    connect(split_, &QSplitter::splitterMoved, this, [this] { splitByHand_ = true; });
    streams_ = makeTable(split_, tr("Streams"));
    streams_->setObjectName("streamsTable");
    plot_ = new QCustomPlot(split_);
    plot_->setAccessibleName(tr("The chosen stream"));
    plot_->setObjectName("chosenStream");
    plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    plot_->axisRect()->setRangeZoom(Qt::Horizontal);
    plot_->axisRect()->setRangeDrag(Qt::Horizontal);
    plot_->xAxis->setLabel(tr("Time (s)"));
    addPlotMenu(*plot_, "stream");
    putLegendAbove(*plot_);
    wrapLegend(*plot_);
    watermark_ = addWatermark(*plot_->axisRect(), WatermarkPlace::InFront);
    watermark_->setVisible(false);
    marks_ = std::make_unique<MarkLines>(*plot_);
    // After a drag or zoom, each mark's word moves with its time.
    connect(plot_->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &SessionDetails::drawMarks);
    colour();
    addAll(*split_, {streams_, plot_});
    split_->setStretchFactor(0, 0);
    split_->setStretchFactor(1, 1);
    captures_ = makeTable(this, tr("Captures"));
    captures_->setToolTip(tr("Double click or Return opens a capture in the oscilloscope."));
    addTab(overview_, tr("Overview"));
    addTab(trials_, tr("Trials"));
    addTab(split_, tr("Streams"));
    addTab(captures_, tr("Captures"));
    addTab(about_, tr("About"));
    connect(captures_, &QTableWidget::cellActivated, this, [this] {
        if (const auto seq = chosenCapture()) emit captureActivated(*seq);
    });
    connect(streams_, &QTableWidget::currentCellChanged, this, [this](int row) {
        if (session_ && row >= 0 && row < int(session_->streams.size()))
            emit streamChosen(session_->streams[std::size_t(row)].id);
    });
    connect(this, &QTabWidget::currentChanged, this, [this] {
        fitStreams();  // a page not shown before had no height
        chooseStream();
    });
    say(tr("Choose a session at the left."));
}

/// Shows all tabs if the visible width allows: see fitPanes() of the workspace.
void SessionDetails::fitTabs() { tabBar()->setUsesScrollButtons(widthInSight(*this) < tabBar()->sizeHint().width()); }

/// Applies theme and text size.
void SessionDetails::fitLook() {
    fitTabs();
    for (auto* table : {trials_, streams_, captures_}) fitRecordTable(*table);
    plot_->setMinimumHeight(fontMetrics().height() * kPlotLines);
    fitStreams();
    colour();
    fitLegend(*plot_);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

/// Shows all streams if they leave the plot the larger part; otherwise as many as fit into half the height.
void SessionDetails::fitStreams() {
    const int row = streams_->verticalHeader()->defaultSectionSize();
    const int head = streams_->horizontalHeader()->height() + 2 * streams_->frameWidth();
    streams_->setMinimumHeight(head + kMinStreams * row);
    if (splitByHand_) return;
    const int all = split_->height() - split_->handleWidth();
    const int rows = std::clamp((all / 2 - head) / row, kMinStreams, std::max(kMinStreams, streams_->rowCount()));
    const int upper = head + rows * row;
    split_->setSizes({upper, all - upper});
}

void SessionDetails::resizeEvent(QResizeEvent* event) {
    QTabWidget::resizeEvent(event);
    fitTabs();
    fitStreams();
}

void SessionDetails::say(const QString& why) {
    session_.reset();
    overview_->say(why);
    about_->setHtml("<p>" + why.toHtmlEscaped() + "</p>");
    for (auto* table : {trials_, streams_, captures_}) {
        table->setRowCount(0);
        sayIfEmpty(*table, why);
    }
    plot_->hide();
    clearStream();
    setCurrentIndex(0);
}

/// Chooses the first stream if none is chosen, but only once the page is visible, as reading takes time.
void SessionDetails::chooseStream() {
    if (currentWidget() == split_ && streams_->rowCount() > 0 && streams_->currentRow() < 0)
        streams_->setCurrentCell(0, 0);
}

void SessionDetails::clearStream() {
    plot_->clearGraphs();
    removeAxes();
    drawMarks();
    plot_->replot();
}

QString SessionDetails::aboutHtml() const {
    const auto& about = session_->about;
    QString html = QString("<h3>%1</h3>").arg(qtext(session_->path.filename().string()).toHtmlEscaped());
    if (about.simulated) html += "<p><b>" + tr("SIMULATED") + "</b></p>";
    for (const auto& verdict : session_->verdicts) {
        const auto found = verdict.verdict == "none" ? tr("no verdict") : qtext(verdict.verdict);
        html += QString("<p><b>%1: %2</b>")
                    .arg(procedureText(verdict.subject).toHtmlEscaped(), verdictText(found).toHtmlEscaped());
        for (const auto& reason : verdict.reasons)
            html += "<br>" + sentence(withoutScriptPlace(qtext(reason))).toHtmlEscaped();
        html += "</p>";
    }
    QStringList marks;
    for (const auto& mark : session_->marks) marks << qtext(flagSentence(mark)).toHtmlEscaped();
    if (!marks.isEmpty()) html += "<p>" + marks.join("<br>") + "</p>";
    html += "<table cellpadding=\"3\">";
    const auto row = [&](const QString& name, const QString& value) {
        html += QString("<tr><td><b>%1</b></td><td>%2</td></tr>").arg(name, value.toHtmlEscaped());
    };
    row(tr("Procedure"), procedureText(about.protocol));
    row(tr("Began"), beganWords(about.wallStart));
    row(tr("Ended"), session_->closed      ? tr("in order")
                     : session_->elsewhere ? tr("not yet: another program is recording it")
                                           : tr("not in order: a crash, or still being recorded"));
    for (const auto& [key, value] : about.parameters.items()) {
        const auto declared = session_->settings.find(key);
        const bool known = declared != session_->settings.end();
        const auto column = columnName(qtext(key));
        const auto unit = known ? qtext(textOr(declared->second, "unit")) : column.unit;
        const auto shown = known ? qtext(textOr(declared->second, "shown")) : QString();  // words of a choice
        row(known ? qtext(textOr(declared->second, "label")) : column.title,
            shown.isEmpty() ? settingWords(value, unit) : shown);
    }
    for (const auto& signature : session_->signatures) row(tr("Signed"), qtext(sentenceOf(signature)));
    row(tr("Seed"), QString::number(about.seed));
    row(tr("Output mode"), qtext(about.mode));
    for (const auto& device : about.devices) {
        row(titled(qtext(device.role)),
            QString("%1 · %2%3")
                .arg(qtext(device.name), qtext(device.uri),
                     device.serial.empty() ? QString() : tr(" · serial %1").arg(qtext(device.serial))));
    }
    for (const auto& set : about.limitSets) {
        const auto known = std::ranges::find(limits_.sets, set.id, &LimitSet::id);
        row(tr("Limits"),
            tr("%1 · SHA-256 %2…")
                .arg(qtext(known != limits_.sets.end() ? known->title : set.id), qtext(set.sha256.substr(0, 16))));
    }
    row(tr("Encoding profile"), tr("SHA-256 %1…").arg(qtext(about.profileSha256.substr(0, 16))));
    row(tr("Program"), qtext(about.programVersion));
    row(tr("Chain head"), qtext(session_->head));
    return html + "</table>";
}

void SessionDetails::show(std::shared_ptr<const ReadSession> session) {
    const int again = session_ && session_->path == session->path ? streams_->currentRow() : -1;
    session_ = std::move(session);
    overview_->show(session_);
    about_->setHtml(aboutHtml());
    const auto known = [](double value) { return std::isfinite(value) && value > 0 ? json(value) : json(nullptr); };
    auto trials = json::array(), streams = json::array(), captures = json::array();
    for (const auto& trial : session_->trials)
        trials.push_back({{"number", trial.number},
                          {"at", toSeconds(trial.at)},
                          {"condition", conditionText(trial.condition).toStdString()},
                          {"measured", trial.measured}});
    for (const auto& stream : session_->streams)
        streams.push_back({{"name", titled(qtext(stream.stream.name)).toStdString()},
                           {"unit", shownUnitText(stream.stream.unit)},
                           {"rate", known(stream.stream.rate_hz)},
                           {"samples", stream.samples},
                           {"channels", stream.stream.columns.size()}});
    for (const auto& capture : session_->captures)
        captures.push_back({{"number", captures.size() + 1},
                            {"load", capture.load.toStdString()},
                            {"command", capture.command.toStdString()},
                            {"trial", capture.trial ? json(*capture.trial) : json(nullptr)},
                            {"at", toSeconds(capture.at)},
                            {"samples", capture.samples},
                            {"rate", known(capture.rate_hz)}});
    std::vector<ResultColumn> ofTrials{
        {"Trial", "number", As::Number}, {"At", "at", As::Number, "s"}, {"Condition", "condition"}};
    for (const auto& column : {ResultColumn{"Amplitude", "measured.amplitude_v", As::Number, "V"},
                               ResultColumn{"Interval", "measured.interval_s", As::Number, "s"},
                               ResultColumn{"Width", "measured.width_s", As::Number, "s"}}) {
        // A quantity that no trial measured gets no column.
        if (std::ranges::any_of(trials, [&](const json& trial) { return memberAt(trial, column.at).is_number(); }))
            ofTrials.push_back(column);
    }
    fill(*trials_, ofTrials, trials);
    streams_->setCurrentCell(-1, -1);
    fill(*streams_,
         {{"Stream", "name"},
          {"Unit", "unit"},
          {"Rate", "rate", As::Number, "Hz"},
          {"Samples", "samples", As::Number},
          {"Channels", "channels", As::Number}},
         streams);
    clearStream();
    fill(*captures_,
         {{"Capture", "number", As::Number},
          {"Load", "load"},
          {"Command", "command"},
          {"Trial", "trial", As::Number},
          {"At", "at", As::Number, "s"},
          {"Samples", "samples", As::Number},
          {"Rate", "rate", As::Number, "S/s"}},
         captures);
    captures_->horizontalHeader()->setSectionResizeMode(kCommand, QHeaderView::Stretch);  // elided where room is short
    if (captures_->rowCount() > 0) captures_->setCurrentCell(0, 0);
    plot_->setVisible(streams_->rowCount() > 0);
    const auto has = [this](Role role) {
        return std::ranges::any_of(session_->about.devices, [role](const auto& device) { return device.is(role); });
    };
    sayIfEmpty(*trials_, session_->about.protocol.empty() || session_->about.protocol == "live"
                             ? tr("No trial: it was driven live, and only protocols make trials.")
                             : tr("No trial: the run made none before it ended."));
    sayIfEmpty(*streams_, has(Role::Sensor) ? tr("No stream: the fingertip sent nothing before the end.")
                                            : tr("No stream: no fingertip was connected."));
    sayIfEmpty(*captures_, has(Role::Oscilloscope) ? tr("No capture: the oscilloscope was not triggered, or not armed.")
                                                   : tr("No capture: no oscilloscope was connected."));
    fitStreams();
    // Waits until the session's reader has finished: it reads one thing at a time.
    QTimer::singleShot(0, this, [this, again] {
        if (again >= 0 && again < streams_->rowCount()) streams_->setCurrentCell(again, 0);
        chooseStream();
    });
}

std::optional<std::int64_t> SessionDetails::chosenCapture() const {
    const int row = captures_->currentRow();
    if (!session_ || row < 0 || row >= int(session_->captures.size())) return std::nullopt;
    return session_->captures[std::size_t(row)].seq;
}

/// Returns the axis for a unit: the first unit has the left axis, each further unit one at the right.
QCPAxis& SessionDetails::axisFor(const QString& unit) {
    for (const auto& [of, axis] : axes_)
        if (of == unit) return *axis;
    auto* axis = axes_.empty()       ? plot_->yAxis
                 : axes_.size() == 1 ? plot_->yAxis2
                                     : plot_->axisRect()->addAxis(QCPAxis::atRight);
    axis->setVisible(true);
    axis->setTicks(true);
    axis->setTickLabels(true);
    axes_.emplace_back(unit, axis);
    return *axis;
}

void SessionDetails::removeAxes() {
    for (std::size_t i = 2; i < axes_.size(); ++i) plot_->axisRect()->removeAxis(axes_[i].second);
    axes_.clear();
    plot_->yAxis->setLabel({});
    plot_->yAxis2->setLabel({});
    plot_->yAxis2->setTicks(false);  // only an edge of the frame
    plot_->yAxis2->setTickLabels(false);
}

void SessionDetails::showStream(const SessionStreamInfo& info, const SampleBlock& samples) {
    clearStream();
    const auto columns = info.stream.columns.size();
    const auto units = axisUnitsOf(info.stream, samples);
    for (std::size_t c = 0; c < columns; ++c) {
        const auto& unit = units.at(columnUnit(info.stream, c));
        std::vector<double> values(samples.samples());
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = unit.factor * samples.values[i * columns + c];
        auto& axis = axisFor(columnUnit(info.stream, c));
        const auto title = columnTitle(info.stream, c);
        addCurve(*plot_, &axis, samples.t_s, values, title);
        const bool shared = !axis.label().isEmpty();
        axis.setLabel(axisTitle(shared ? quantityOf(info.stream) : title, unit.unit));
    }
    watermark_->setVisible(session_ && session_->about.simulated);
    plot_->legend->setVisible(columns > 1);
    plot_->rescaleAxes();
    drawMarks();
    colour();
    fitLegend(*plot_);
    plot_->replot();
}

void SessionDetails::drawMarks() {
    const bool drawn = session_ && plot_->graphCount() > 0;
    marks_->draw(drawn ? operatorMarks(*session_) : std::vector<PlotMark>{}, {plot_->axisRect()});
}

void SessionDetails::colour() {
    stylePlot(*plot_);
    marks_->colour();
    const QColor of[] = {colours().voltage, colours().current, colours().third, colours().amber};
    const Qt::PenStyle styles[] = {Qt::SolidLine, Qt::DashLine, Qt::DotLine};
    for (int i = 0; i < plot_->graphCount(); ++i) plot_->graph(i)->setPen(QPen(of[i % 4], 1, styles[i / 4 % 3]));
}

}  // namespace tacto::gui

#include "moc_SessionDetails.cpp"
