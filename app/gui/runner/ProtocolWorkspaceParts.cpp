// How ProtocolWorkspace is put together.
#include <QApplication>
#include <QGroupBox>
#include <QShortcut>
#include <QSplitter>
#include <QVBoxLayout>

#include "app/gui/calibrate/CalibrationView.h"
#include "app/gui/calibrate/WiringPage.h"
#include "app/gui/look/ExposureTable.h"
#include "app/gui/look/Look.h"
#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/LoadRows.h"
#include "app/gui/runner/NotesPanel.h"
#include "app/gui/runner/ParameterForm.h"
#include "app/gui/runner/PromptPanel.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/runner/ResultPanel.h"
#include "app/gui/runner/RunPanel.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/runner/WiringPanel.h"

namespace tacto::gui {

namespace {

constexpr int kPreviewAfter_ms = 150;
constexpr int kLogLines = 5000;  // shown; all of them are in the session
constexpr int kPathChars = 48;
constexpr int kBesideChars = 95;  // plots stand side by side from this width on

}  // namespace

ProtocolWorkspace::ProtocolWorkspace(BenchDesk& desk, const QString& protocol, QWidget* parent)
    : QWidget(parent),
      desk_(desk),
      fixed_(protocol),
      reading_([this](const auto& source, const auto& declaration) { declared(source, declaration); }) {
    auto* layout = new QVBoxLayout(this);
    prompt_ = new PromptPanel(desk_.operatorDesk(), this);
    layout->addWidget(prompt_);
    auto* split = new QSplitter(Qt::Horizontal, this);
    split->setChildrenCollapsible(false);
    split->addWidget(buildPath());
    auto* right = new QSplitter(Qt::Vertical, split);
    right->setChildrenCollapsible(false);
    right->addWidget(buildPlots());
    right->addWidget(buildTabs());
    right->setStretchFactor(0, 2);
    right->setStretchFactor(1, 3);
    split->addWidget(right);
    split->setStretchFactor(1, 1);
    layout->addWidget(split, 1);
    buildKeys();

    connect(&desk_, &BenchDesk::finished, this, [this](const std::shared_ptr<const FinishedRun>& run) { ended(*run); });
    connect(&desk_, &BenchDesk::changed, this, [this] {
        previewLater_.start();
        const auto open = desk_.open();
        if (!running_ || !open) return;
        plane_->setSimulated(open->simulated());
        calibration_->setSimulated(open->simulated());
    });
    connect(&desk_.operatorDesk(), &OperatorDesk::asked, this, [this](const OperatorQuestion& question) {
        if (!running_) return;  // the other workspace's run
        prompt_->ask(question);
        QApplication::alert(window());
        emit attentionWanted();
    });
    connect(&desk_.operatorDesk(), &OperatorDesk::closed, prompt_, &PromptPanel::close);
    previewLater_.setSingleShot(true);
    previewLater_.setInterval(kPreviewAfter_ms);
    connect(&previewLater_, &QTimer::timeout, this, &ProtocolWorkspace::preview);
    fillChooser({});
}

void ProtocolWorkspace::buildKeys() {
    const auto key = [this](const QKeySequence& keys, auto act) {
        auto* shortcut = new QShortcut(keys, this, nullptr, nullptr, Qt::WidgetWithChildrenShortcut);
        connect(shortcut, &QShortcut::activated, this, act);
    };
    key(Qt::Key_F5, [this] { runAsked(); });
}

QWidget* ProtocolWorkspace::buildPath() {
    auto* path = new QWidget;
    auto* layout = new QVBoxLayout(path);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(buildHead(path));
    steps_ = new StepList({tr("Wiring"), tr("Settings"), tr("Run"), tr("Result")}, path);
    connect(steps_, &StepList::chosen, this, &ProtocolWorkspace::goTo);
    layout->addWidget(steps_);
    before_ = new QScrollArea(path);
    before_->setWidgetResizable(true);
    before_->setFrameShape(QFrame::NoFrame);
    before_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* body = new QWidget(before_);
    auto* column = new QVBoxLayout(body);
    column->setContentsMargins(0, 0, fontMetrics().averageCharWidth(), 0);
    wiring_ = new WiringPanel(body);
    auto* settings = new QGroupBox(tr("Settings"), body);
    auto* inner = new QVBoxLayout(settings);
    form_ = new ParameterForm(settings);
    inner->addWidget(form_);
    column->addWidget(wiring_);
    column->addWidget(settings);
    notes_ = new NotesPanel(body);
    column->addWidget(notes_);
    column->addStretch();
    connect(form_, &ParameterForm::edited, this, &ProtocolWorkspace::judge);
    connect(wiring_, &WiringPanel::edited, this, &ProtocolWorkspace::judge);
    before_->setWidget(body);
    layout->addWidget(before_, 1);
    panel_ = new RunPanel(path);
    connect(panel_, &RunPanel::runWanted, this, &ProtocolWorkspace::runAsked);
    connect(panel_, &RunPanel::confirmed, this, &ProtocolWorkspace::runNow);
    connect(panel_, &RunPanel::stopWanted, this, [this] { desk_.stop("operator (Stop)"); });
    connect(panel_, &RunPanel::pauseWanted, this, [this](bool pause) {
        paused_ = pause;
        pause ? desk_.pause() : desk_.resume();
    });
    connect(panel_, &RunPanel::lineWanted, this, [this](int line, const QString& why) { edit(source_, line, why); });
    layout->addWidget(panel_);
    path->setMinimumWidth(fontMetrics().averageCharWidth() * kPathChars);
    return path;
}

QWidget* ProtocolWorkspace::buildHead(QWidget* parent) {
    auto* head = new QWidget(parent);
    auto* column = new QVBoxLayout(head);
    column->setContentsMargins(0, 0, 0, 0);
    purpose_ = new QLabel(head);
    purpose_->setTextFormat(Qt::PlainText);
    purpose_->setObjectName("purpose");
    purpose_->setWordWrap(true);
    auto font = purpose_->font();
    font.setBold(true);
    purpose_->setFont(font);
    auto* row = new QHBoxLayout;
    const auto button = [&](const QString& text, const QString& tip, auto act) {
        auto* made = new QPushButton(text, head);
        made->setAutoDefault(false);
        made->setToolTip(tip);
        connect(made, &QPushButton::clicked, this, act);
        row->addWidget(made);
    };
    if (fixed_.isEmpty()) {
        chooser_ = new QComboBox(head);
        chooser_->setObjectName("chooser");
        chooser_->setAccessibleName(tr("Protocol"));
        chooser_->setToolTip(tr("Protocols that came with the program, and the lab's own."));
        connect(chooser_, &QComboBox::currentIndexChanged, this,
                [this] { choose(chooser_->currentData().toString()); });
        row->addWidget(chooser_, 1);
        button(tr("Ed&it…"), tr("Opens the script. Shipped ones are read-only: save a copy."),
               [this] { edit(source_, 0, {}); });
        button(tr("&New…"), tr("A protocol of your own, from a small template."), [this] { edit({}, 0, {}); });
        column->addLayout(row);
        column->addWidget(purpose_);
    } else {
        row->addWidget(purpose_, 1);
        button(tr("Scr&ipt…"), tr("Shows how it is done: the script of this protocol, and its reference."),
               [this] { edit(source_, 0, {}); });
        column->addLayout(row);
    }
    return head;
}

QWidget* ProtocolWorkspace::buildPlots() {
    auto* holder = new QWidget;
    plots_ = new QHBoxLayout(holder);
    plots_->setContentsMargins(0, 0, 0, 0);
    plane_ = new TrialPlane(holder);
    loads_ = new LoadRows(holder);
    loads_->hide();
    calibration_ = new CalibrationView(holder);
    calibration_->hide();
    wave_ = new CaptureStrip(holder);
    plots_->addWidget(plane_, 3);
    plots_->addWidget(loads_, 3);
    plots_->addWidget(calibration_, 4);
    plots_->addWidget(wave_, 2);
    return holder;
}

QWidget* ProtocolWorkspace::buildTabs() {
    tabs_ = new QTabWidget;
    worstPage_ = new QWidget(tabs_);
    auto* column = new QVBoxLayout(worstPage_);
    worstSays_ = new QLabel(worstPage_);
    worstSays_->setTextFormat(Qt::PlainText);
    worstSays_->setObjectName("worstCase");
    worstSays_->setWordWrap(true);
    column->addWidget(worstSays_);
    worst_ = new ExposureTable(worstPage_);
    worst_->setAccessibleName(tr("Worst case against the limits"));
    worst_->setToolTip(
        tr("The strongest command into 80 to 120 % of the declared load, from an ideal voltage source. "
           "Hatched: not evaluated, and never a pass."));
    column->addWidget(worst_, 1);
    tabs_->addTab(worstPage_, tr("&Worst case"));
    drawing_ = new WiringPage(tabs_);
    tabs_->setTabVisible(tabs_->addTab(drawing_, tr("W&iring")), false);
    log_ = new QPlainTextEdit(tabs_);
    log_->setReadOnly(true);
    log_->setTabChangesFocus(true);
    log_->setMaximumBlockCount(kLogLines);
    log_->setAccessibleName(tr("Log"));
    log_->setToolTip(tr("The script's own words; they are in the session too."));
    log_->setPlaceholderText(tr("What the script says while it runs."));
    tabs_->addTab(log_, tr("&Log"));
    result_ = new ResultPanel(tabs_);
    connect(result_, &ResultPanel::reportWanted, this, &ProtocolWorkspace::openReport);
    connect(result_, &ResultPanel::scriptErrorChosen, this,
            [this](int line, const QString& why) { edit(source_, line, why); });
    tabs_->addTab(result_, tr("Resul&t"));
    document_ = new QPdfDocument(this);
    pdf_ = new QPdfView(tabs_);
    pdf_->setObjectName("reportView");
    pdf_->setAccessibleName(tr("Report"));
    pdf_->setDocument(document_);
    pdf_->setPageMode(QPdfView::PageMode::MultiPage);
    pdf_->setZoomMode(QPdfView::ZoomMode::FitToWidth);
    const int report = tabs_->addTab(pdf_, tr("Repo&rt"));
    tabs_->setTabEnabled(report, false);
    tabs_->setTabToolTip(report, tr("The report of the last run: \"Open the report\" under Result shows it here."));
    return tabs_;
}

TrialPlane::Features ProtocolWorkspace::featuresOf(Plot plot) {
    return plot == Plot::Slides ? TrialPlane::Features::Slides : TrialPlane::Features::Trains;
}

void ProtocolWorkspace::showPlot(Plot plot) {
    loads_->setVisible(plot == Plot::Loads);
    calibration_->setVisible(plot == Plot::Calibration);
    plane_->setVisible(plot == Plot::Trials || plot == Plot::Slides);
    if (plane_->features() != featuresOf(plot)) plane_->begin(false, featuresOf(plot));
    plot_ = plot;
    placeWave();
}

void ProtocolWorkspace::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    placeWave();
}

/// Beside the trials where there is room, else a tab: a plot too narrow to read is no help. A calibration has two
/// of its own. Nowhere in a run without an oscilloscope.
void ProtocolWorkspace::placeWave() {
    const int room = width() - fontMetrics().averageCharWidth() * kPathChars;
    const bool roomy = room >= fontMetrics().averageCharWidth() * kBesideChars;
    const bool anywhere = plot_ != Plot::Slides && plot_ != Plot::None;
    const bool beside = anywhere && plot_ != Plot::Calibration && roomy;
    const int tab = tabs_->indexOf(wave_);
    if (tab >= 0 && (beside || !anywhere)) tabs_->removeTab(tab);
    const bool isBeside = plots_->indexOf(wave_) >= 0;
    if (isBeside && !beside) plots_->removeWidget(wave_);
    if (beside && !isBeside) plots_->addWidget(wave_, 2);
    if (anywhere && !beside && tab < 0) tabs_->insertTab(tabs_->indexOf(log_), wave_, tr("Wave&form"));
    // A tab shows its page itself.
    if (beside || !anywhere) wave_->setVisible(beside);
}

}  // namespace tacto::gui
