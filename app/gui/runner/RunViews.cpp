#include "app/gui/runner/RunViews.h"

#include <QScrollArea>
#include <QSplitter>

#include "app/gui/calibrate/CalibrationView.h"
#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/DisclosedPanel.h"
#include "app/gui/runner/LimitMatrixView.h"
#include "app/gui/runner/LoadRows.h"
#include "app/gui/runner/ResultHead.h"
#include "app/gui/runner/ResultTables.h"
#include "app/gui/runner/SheetView.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/PlotPicture.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/ToolRow.h"
#include "app/report/FigureDrawing.h"
#include "app/report/TableContent.h"

namespace tacto::gui {

namespace {

constexpr int kLogLines = 5000;           // lines shown; the session keeps all lines
constexpr int kBesideChars = 115;         // width in characters from which the waveform is next to the plot
constexpr int kDisclosedFromChars = 120;  // width from which the outputs are next to the tracing
constexpr int kTracedFromChars = 165;     // width from which the tracing is next to the limits
constexpr int kLimitsAbove = 8;           // limits that are in sight above the tracing
constexpr double kTracingShare = 0.35;    // the tracing's share of the height below the limits
constexpr int kRoomyLines = 34;           // with less height, the bar below is as low as its buttons
constexpr int kPageGap = 4, kViewSide = 16, kViewTop = 4, kBarPad = 12, kBarPadLow = 4;

TrialPlane::Features featuresOf(RunViews::Plot plot) {
    return plot == RunViews::Plot::Slides ? TrialPlane::Features::Slides : TrialPlane::Features::Trains;
}

}  // namespace

RunViews::RunViews(QWidget* parent) : QWidget(parent) {
    auto* column = columnIn(*this, 0);
    body_ = new QVBoxLayout;
    body_->setSpacing(kPageGap);
    column->addLayout(body_, 1);
    head_ = new ResultHead(this);
    connect(head_, &ResultHead::scriptErrorChosen, this, &RunViews::scriptErrorChosen);
    body_->addWidget(head_);
    views_ = new QStackedWidget(this);
    views_->addWidget(buildPlots());
    auto* area = new QScrollArea(views_);
    scrollDownOnly(*area);
    tables_ = new ResultTables(area);
    area->setWidget(tables_);
    for (auto* ground : {static_cast<QWidget*>(tables_), area->viewport()}) ground->setAutoFillBackground(false);
    views_->addWidget(area);
    auto* waveform = new QWidget(views_);
    columnIn(*waveform);
    views_->addWidget(waveform);
    log_ = new QPlainTextEdit(views_);
    log_->setReadOnly(true);
    log_->setTabChangesFocus(true);
    log_->setMaximumBlockCount(kLogLines);
    log_->setAccessibleName(tr("Log"));
    log_->setToolTip(tr("The script's own words; they are in the session too."));
    log_->setPlaceholderText(tr("What the script says while it runs."));
    views_->addWidget(log_);
    body_->addWidget(views_, 1);
    column->addWidget(buildBar());
    onEvent(*views_, QEvent::Resize, [this] { arrangeSoon(); });  // their size is known only after layout
    showResult(false);
    showPlot(Plot::Trials);
    onEvent(*this, QEvent::Resize, [this] { arrangeSoon(); });
}

/// Not within the event: a panel that leaves a splitter ends its handle, and while a new style is set Qt still goes
/// through the widgets that there were.
void RunViews::arrangeSoon() {
    if (std::exchange(arrangesSoon_, true)) return;
    QMetaObject::invokeMethod(
        this,
        [this] {
            arrangesSoon_ = false;
            arrange();
        },
        Qt::QueuedConnection);
}

QWidget* RunViews::buildPlots() {
    auto* holder = new QWidget(views_);
    plots_ = rowIn(*holder);
    plane_ = new TrialPlane(holder);
    plane_->addTitle();
    figured_ = new QWidget(holder);
    auto* figure = columnIn(*figured_);
    figureTitle_ =
        makeLabel({}, {.name = "figureTitle", .size = TextSize::Small, .strong = true, .wraps = true}, figured_);
    sheet_ = new SheetView(figured_);
    figure->addWidget(figureTitle_);
    figure->addWidget(sheet_, 1);
    loads_ = new LoadRows(holder);
    judged_ = new QSplitter(Qt::Vertical, holder);
    judged_->setObjectName("judgedLimits");
    judged_->setChildrenCollapsible(false);
    matrix_ = new LimitMatrixView(judged_);
    connect(matrix_, &LimitMatrixView::chosen, this, &RunViews::trace);
    connect(matrix_, &QTableWidget::cellActivated, this, [this](int, int column) {
        if (column > 0 && !disclosed_->isVisible()) showView(kWaveform);
    });
    disclosed_ = new DisclosedPanel(judged_);
    connect(judged_, &QSplitter::splitterMoved, this, [this] { dragged_ = true; });
    judged_->setStretchFactor(0, 1);
    judged_->setStretchFactor(1, 0);
    calibration_ = new CalibrationView(holder);
    connect(calibration_, &CalibrationView::plotOnlyWanted, this, &RunViews::plotOnlyWanted);
    none_ = makeLabel(tr("This protocol has no plot of its own: what it says is in the log, what it found in the "
                         "tables."),
                      {.wraps = true}, holder);
    none_->setAlignment(Qt::AlignCenter);
    setTone(*none_, Tone::Quiet);
    wave_ = new CaptureStrip(holder);
    plots_->addWidget(plane_, 3);
    plots_->addWidget(figured_, 3);
    plots_->addWidget(loads_, 3);
    plots_->addWidget(judged_, 3);
    plots_->addWidget(calibration_, 3);
    plots_->addWidget(none_, 3);
    plots_->addWidget(wave_, 2);
    return holder;
}

QWidget* RunViews::buildBar() {
    auto* holder = new QWidget(this);
    makeActionBar(*holder);
    bar_ = new QHBoxLayout(holder);
    next_ = new NextStepBar(holder);
    connect(next_, &NextStepBar::chosen, this, &RunViews::nextChosen);
    connect(next_, &NextStepBar::reportMenuWanted, this, &RunViews::reportMenuWanted);
    bar_->addWidget(next_);
    bar_->addStretch();
    viewRow_ = new QWidget(holder);
    auto* row = rowIn(*viewRow_, 0);
    addPictureTools(*row);
    choices_ = new QButtonGroup(this);
    const std::pair<QString, QString> views[] = {
        {tr("Plot"), tr("The main plot of this protocol.")},
        {tr("Tables"), tr("The numbers that the verdict was given.")},
        {tr("Waveform"), tr("The last train as the oscilloscope recorded it.")},
        {tr("Log"), tr("The script's own words.")}};
    for (const auto& [name, tip] : views) {
        auto* button = new QPushButton(name, viewRow_);
        button->setCheckable(true);
        button->setAutoDefault(false);
        button->setProperty("role", "segment");
        button->setProperty("first", choices_->buttons().empty());
        button->setToolTip(tip);
        choices_->addButton(button, int(choices_->buttons().size()));
        row->addWidget(button);
    }
    choices_->button(kPlot)->setChecked(true);
    connect(choices_, &QButtonGroup::idClicked, this, [this](int view) { showView(View(view)); });
    bar_->addWidget(viewRow_);
    return holder;
}

/// Adds picture tools, as in Touch and the oscilloscope. A calibration has them next to its title and plot chooser.
void RunViews::addPictureTools(QBoxLayout& row) {
    toolRow_ = new QWidget(viewRow_);
    auto* tools = new ToolRow(toolRow_);
    pictures_ = new PictureTools(toolRow_);
    pictures_->addTo(*tools);
    tools->addGap();
    pictures_->takeFrom([this] { return picture(); }, "result");
    connect(pictures_, &PictureTools::plotOnlyWanted, this, &RunViews::plotOnlyWanted);
    row.addWidget(toolRow_);
    for (QCustomPlot* plot : {static_cast<QCustomPlot*>(plane_), static_cast<QCustomPlot*>(wave_),
                              static_cast<QCustomPlot*>(&disclosed_->tracing())}) {
        captionPictures(*plot, [this, plot] {
            auto whole = caption();
            whole.lines << axesText(*plot);
            return whole;
        });
    }
    calibration_->captionPicturesBy([this] { return caption(); });
}

PictureCaption RunViews::caption() const {
    PictureCaption caption;
    const auto word = head_->word();
    caption.title = pictureTitle(word.isEmpty() ? title_ : title_ + QStringLiteral(" · ") + word, simulated_);
    caption.date = pictureDate(ended_.isValid() ? ended_ : QDateTime::currentDateTime());
    caption.lines << devices_;
    if (!word.isEmpty()) caption.lines << head_->reasons();
    return caption;
}

QWidget* RunViews::pictured() const {
    const bool judged = showsLimits();
    if (views_->currentIndex() == kWaveform)
        return judged ? static_cast<QWidget*>(&disclosed_->tracing()) : static_cast<QWidget*>(wave_);
    if (views_->currentIndex() != kPlot || plot_ == Plot::None) return nullptr;
    if (plot_ == Plot::Loads) return judged ? static_cast<QWidget*>(matrix_) : static_cast<QWidget*>(loads_);
    return hasFigure_ ? static_cast<QWidget*>(sheet_) : plane_;
}

Still RunViews::picture() const {
    auto* shown = pictured();
    if (shown == matrix_) return matrix_->picture(caption());
    if (auto* plot = qobject_cast<QCustomPlot*>(shown)) return *plot;
    return {*shown, caption()};
}

void RunViews::showPictureTools() {
    toolRow_->setVisible(plot_ != Plot::Calibration);
    for (auto* tool : {&pictures_->save(), &pictures_->copy()}) tool->setEnabled(pictured() != nullptr);
}

void RunViews::showView(View view) {
    views_->setCurrentIndex(view);
    choices_->button(view)->setChecked(true);
    showPictureTools();
}

void RunViews::showPlot(Plot plot) {
    if (plane_->features() != featuresOf(plot)) plane_->begin(false, featuresOf(plot));
    plot_ = plot;
    arrange();
}

void RunViews::showResult(bool result) {
    showsResult_ = result;
    head_->setVisible(result);
    next_->setVisible(result);
    choices_->button(kTables)->setVisible(result);
    if (!result && views_->currentIndex() == kTables) showView(kPlot);
    arrange();
}

/// Places the tracing of a judged run: next to the limits in a wide window, below them in a high one, otherwise in its
/// own view.
void RunViews::placeTracing(bool judged) {
    disclosed_->setVisible(judged);
    if (!judged) return;
    const int chars = fontMetrics().averageCharWidth();
    const bool high = views_->height() >= matrix_->heightOf(kLimitsAbove) + disclosed_->leastHeight();
    const auto place = width() >= chars * kTracedFromChars ? Tracing::Beside : high ? Tracing::Below : Tracing::OwnView;
    using Outputs = DisclosedPanel::Outputs;
    const bool roomy = place != Tracing::Beside && width() >= chars * kDisclosedFromChars;
    disclosed_->showOutputs(roomy                       ? Outputs::Beside
                            : place == Tracing::Below   ? Outputs::Nowhere
                            : place == Tracing::OwnView ? Outputs::BelowNarrow
                                                        : Outputs::Below);
    disclosed_->setContentsMargins(place == Tracing::Beside ? kViewSide : 0, 0, 0, 0);
    matrix_->setFillsHeight(place != Tracing::Below);
    const bool beside = place == Tracing::Beside;
    if (std::exchange(tracing_, place) != place) {
        dragged_ = false;
        if (place == Tracing::OwnView) return views_->widget(kWaveform)->layout()->addWidget(disclosed_);
        judged_->addWidget(disclosed_);
        judged_->setOrientation(beside ? Qt::Horizontal : Qt::Vertical);
    }
    if (place == Tracing::OwnView || dragged_) return;
    const int all = beside ? views_->width() : views_->height();
    const int wanted = std::max(int(all * kTracingShare), roomy ? disclosed_->wholeHeight() : 0);
    const int part = beside ? disclosed_->minimumSizeHint().width()
                            : std::clamp(wanted, disclosed_->leastHeight(), all - matrix_->heightOf(kLimitsAbove));
    judged_->setSizes({all - part, part});
}

/// Shows one main plot. The waveform is next to the plot if there is room, otherwise in its own view (always for a
/// calibration); hidden without an oscilloscope. A judged safety check shows its tracing instead.
void RunViews::arrange() {
    const bool tall = height() >= fontMetrics().height() * kRoomyLines;
    const int pad = tall ? kBarPad : kBarPadLow;
    body_->setContentsMargins(kViewSide, kViewTop, kViewSide, tall ? kViewTop * 2 : kViewTop);
    bar_->setContentsMargins(kViewSide, pad, kViewSide, pad);
    head_->setRoomy(tall || plot_ != Plot::Calibration);  // the residuals of a calibration need 300 px
    const bool judged = showsLimits();
    plane_->setVisible((plot_ == Plot::Trials && !hasFigure_) || plot_ == Plot::Slides);
    figured_->setVisible(plot_ == Plot::Trials && hasFigure_);
    calibration_->setVisible(plot_ == Plot::Calibration);
    judged_->setVisible(judged);
    placeTracing(judged);
    loads_->setVisible(plot_ == Plot::Loads && !judged);
    none_->setVisible(plot_ == Plot::None);
    const bool anywhere = plot_ != Plot::Slides && plot_ != Plot::None && !judged;
    const bool roomy = width() >= fontMetrics().averageCharWidth() * kBesideChars;
    const bool beside = anywhere && roomy && plot_ != Plot::Calibration;
    auto* own = views_->widget(kWaveform)->layout();
    if (beside && own->indexOf(wave_) >= 0) {
        own->removeWidget(wave_);
        plots_->addWidget(wave_, 2);
    } else if (!beside && plots_->indexOf(wave_) >= 0) {
        plots_->removeWidget(wave_);
        own->addWidget(wave_);
    }
    const bool ownView = judged ? tracing_ == Tracing::OwnView : anywhere && !beside;
    wave_->setVisible(anywhere);
    choices_->button(kPlot)->setText(judged ? tr("Limits") : tr("Plot"));
    choices_->button(kWaveform)->setText(judged ? tr("Tracing") : tr("Waveform"));
    choices_->button(kWaveform)->setVisible(ownView);
    if (!ownView && views_->currentIndex() == kWaveform) showView(kPlot);
    showPictureTools();
    const int across = 2 * kViewSide + next_->lineWidth() + viewRow_->minimumSizeHint().width() + bar_->spacing();
    bar_->setDirection(width() >= across ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
}

QString RunViews::word() const { return head_->word(); }

bool RunViews::showsLimits() const { return showsResult_ && plot_ == Plot::Loads && !matrix_->empty(); }

QWidget& RunViews::plotKind() { return calibration_->plotKind(); }

void RunViews::begin(Plot plot, const QString& title, const nlohmann::json& parameters) {
    title_ = title;
    ended_ = {};
    head_->clear();
    next_->show({});
    tables_->show({});
    session_.clear();
    hasFigure_ = false;
    matrix_->show({});
    disclosed_->clear();
    log_->clear();
    log_->setPlaceholderText(tr("What the script says while it runs."));
    plane_->begin(false, featuresOf(plot));
    loads_->begin();
    calibration_->begin(parameters);
    setDevices({}, false);
    wave_->show(nullptr);
    showPlot(plot);
    showView(plot == Plot::None ? kLog : kPlot);
}

void RunViews::setDevices(const std::vector<SessionDevice>& devices, bool simulated) {
    devices_ = deviceNames(devices);
    simulated_ = simulated;
    plane_->setSimulated(simulated);
    calibration_->setSimulated(simulated);
}

void RunViews::take(const RunFeed& feed) {
    for (const auto& line : feed.log) log_->appendPlainText(QString::fromStdString(line));
    for (const auto& trial : feed.trials) {
        plane_->add(trial);
        if (plot_ == Plot::Loads) loads_->add(trial);
        if (plot_ == Plot::Calibration) calibration_->add(trial);
    }
    calibration_->draw();
    if (!feed.captures.empty()) wave_->show(feed.captures.back(), tr("The last train"));
    if (plot_ == Plot::Loads)
        for (const auto& capture : feed.captures) disclosed_->take(capture);
}

void RunViews::trace(const QString& limit, const QString& load, const QString& unit) {
    struct Found {
        std::shared_ptr<const Capture> capture;
        QString trouble;
    };
    const bool ofVoltage = unit == "V";
    reading_.drop();  // drops the pending result for an earlier cell
    reading_.start(
        this,
        [session = session_, load, ofVoltage]() -> Found {
            auto capture = strongestOn(session, load.toStdString(), ofVoltage);
            if (!capture) return {nullptr, sentence(capture.error())};
            return {std::move(*capture), {}};
        },
        [this, limit, load, session = session_](const Found& found) {
            if (session != session_) return;  // another run has begun
            const auto title = !found.trouble.isEmpty() ? found.trouble
                               : found.capture          ? tr("%1 on %2: the strongest train").arg(limit, loadText(load))
                                               : tr("%1 on %2: no train was captured").arg(limit, loadText(load));
            disclosed_->showTracing(found.capture, title);
        });
}

QString RunViews::end(const FinishedRun& run) {
    log_->setPlaceholderText(tr("The script said nothing in this run."));
    session_ = run.result.session;
    ended_ = QDateTime::currentDateTime();
    setDevices(run.result.devices, run.result.simulated);
    QString odd;
    const auto shows = [&odd](auto&& show) {
        try {
            show();
        } catch (const nlohmann::json::exception& problem) {
            odd = tr("The results do not have the shape that is shown here (%1); the session holds them as they are.")
                      .arg(QString::fromUtf8(problem.what()));
        }
    };
    const auto& results = run.result.outcome.results;
    plane_->end();
    shows([&] { loads_->end(results); });
    shows([&] { matrix_->show(memberAt(results, "matrix")); });
    shows([&] { disclosed_->show(memberAt(results, "disclosed")); });
    shows([&] { calibration_->end(results); });
    shows([&] { tables_->show(results, tr("No figures: the run ended before it found any.")); });
    if (wave_->empty()) wave_->show(nullptr, tr("No train was captured in this run."));
    head_->show(run);
    shows([&] { next_->show(nextStepsAfter(run)); });
    showView(plot_ == Plot::None && !tables_->empty() ? kTables : kPlot);
    arrange();
    if (plot_ == Plot::Trials && !session_.empty()) showFigure(session_);
    return odd;
}

/// A drift is read from amplitudes over the trials: the plane of the trials shows where they were, not what was found.
void RunViews::showFigure(const std::filesystem::path& session) {
    reading_.start(
        this, [session] { return std::make_shared<const SessionFigure>(readFigure(session)); },
        [this, session](const std::shared_ptr<const SessionFigure>& found) {
            if (session != session_ || found->planeOfTrials || !found->figure) return;
            sheet_->show(drawFigure(*found->figure, simulated_));
            figureTitle_->setText(found->caption);
            nameWidget(*sheet_, "figure", found->caption);
            hasFigure_ = true;
            arrange();
        });
}

}  // namespace tacto::gui

#include "moc_RunViews.cpp"
