// How ProtocolWorkspace is put together.
#include <QFileDialog>
#include <QFormLayout>
#include <QGroupBox>
#include <QScrollArea>
#include <QShortcut>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/gui/look/ExposureTable.h"
#include "app/gui/look/Look.h"
#include "app/gui/runner/CaptureStrip.h"
#include "app/gui/runner/ParameterForm.h"
#include "app/gui/runner/PromptPanel.h"
#include "app/gui/runner/ProtocolWorkspace.h"
#include "app/gui/runner/ResultPanel.h"
#include "app/gui/runner/ScriptEditor.h"
#include "app/gui/runner/StepList.h"
#include "app/gui/runner/TrialPlane.h"

namespace tacto::gui {

ProtocolWorkspace::ProtocolWorkspace(BenchDesk& desk, const QString& protocol, QWidget* parent)
    : QWidget(parent), desk_(desk), fixed_(protocol) {
    auto* layout = new QVBoxLayout(this);
    steps_ = new StepList({tr("Wiring"), tr("Settings"), tr("Run"), tr("Result")}, this);
    layout->addWidget(steps_);
    prompt_ = new PromptPanel(desk_.operatorDesk(), this);
    layout->addWidget(prompt_);
    auto* split = new QSplitter(Qt::Horizontal, this);
    split->setChildrenCollapsible(false);
    split->addWidget(buildSettings());
    auto* right = new QSplitter(Qt::Vertical, split);
    right->setChildrenCollapsible(false);
    auto* plots = new QWidget(right);
    auto* row = new QHBoxLayout(plots);
    row->setContentsMargins(0, 0, 0, 0);
    plane_ = new TrialPlane(plots);
    wave_ = new CaptureStrip(plots);
    row->addWidget(plane_, 3);
    row->addWidget(wave_, 2);
    right->addWidget(plots);
    right->addWidget(buildTabs());
    right->setStretchFactor(0, 1);
    right->setStretchFactor(1, 1);
    split->addWidget(right);
    split->setStretchFactor(1, 1);
    layout->addWidget(split, 1);

    for (const auto& [keys, act] : {std::pair(QKeySequence(Qt::Key_F5), &ProtocolWorkspace::run)}) {
        auto* shortcut = new QShortcut(keys, this, nullptr, nullptr, Qt::WidgetWithChildrenShortcut);
        connect(shortcut, &QShortcut::activated, this, act);
    }
    auto* cancel =
        new QShortcut(QKeySequence(Qt::SHIFT | Qt::Key_F5), this, nullptr, nullptr, Qt::WidgetWithChildrenShortcut);
    connect(cancel, &QShortcut::activated, this, [this] {
        if (running_) desk_.stop("operator (Shift+F5)");
    });
    connect(&desk_, &BenchDesk::finished, this, [this](std::shared_ptr<const FinishedRun> run) { ended(*run); });
    connect(&desk_, &BenchDesk::changed, this, [this] { previewLater_.start(); });
    previewLater_.setSingleShot(true);
    previewLater_.setInterval(150);
    connect(&previewLater_, &QTimer::timeout, this, &ProtocolWorkspace::preview);
    fillChooser({});
    preview();
}

QWidget* ProtocolWorkspace::buildSettings() {
    auto* area = new QScrollArea;
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* body = new QWidget(area);
    auto* layout = new QVBoxLayout(body);
    layout->setContentsMargins(0, 0, 8, 0);
    if (fixed_.isEmpty()) {
        chooser_ = new QComboBox(body);
        chooser_->setAccessibleName(tr("Protocol"));
        chooser_->setToolTip(tr("Protocols that came with the program, and the lab's own."));
        connect(chooser_, &QComboBox::currentIndexChanged, this,
                [this] { choose(chooser_->currentData().toString()); });
        auto* row = new QHBoxLayout;
        row->addWidget(chooser_, 1);
        auto* edit = new QPushButton(tr("&Edit…"), body);
        edit->setToolTip(tr("Opens the script. Shipped ones are read-only: save a copy."));
        connect(edit, &QPushButton::clicked, this, [this] { this->edit(0, {}); });
        auto* fresh = new QPushButton(tr("&New…"), body);
        fresh->setToolTip(tr("A protocol of your own, from a small template."));
        connect(fresh, &QPushButton::clicked, this, [this] {
            source_ = {};
            this->edit(0, {});
        });
        row->addWidget(edit);
        row->addWidget(fresh);
        layout->addLayout(row);
    }
    purpose_ = new QLabel(body);
    purpose_->setWordWrap(true);
    auto font = purpose_->font();
    font.setBold(true);
    purpose_->setFont(font);
    layout->addWidget(purpose_);
    auto* settings = new QGroupBox(tr("Settings"), body);
    auto* inner = new QVBoxLayout(settings);
    form_ = new ParameterForm(settings);
    connect(form_, &ParameterForm::edited, this, [this] { previewLater_.start(); });
    inner->addWidget(form_);
    layout->addWidget(settings);
    layout->addWidget(buildDevices(body));
    layout->addWidget(buildRun());
    layout->addStretch();
    area->setWidget(body);
    area->setMinimumWidth(fontMetrics().averageCharWidth() * 46);
    return area;
}

QWidget* ProtocolWorkspace::buildDevices(QWidget* parent) {
    auto* group = new QGroupBox(tr("Wiring and recording"), parent);
    auto* form = new QFormLayout(group);
    wiring_ = new QLabel(group);
    wiring_->setWordWrap(true);
    form->addRow(wiring_);
    devices_ = new QLineEdit("sim:", group);
    devices_->setObjectName("devices");
    devices_->setToolTip(
        tr("Devices as URIs, a space between: sim: fills what is missing; recording:FOLDER replays a "
           "fingertip; capture:FOLDER takes oscilloscope records from files."));
    form->addRow(tr("&Devices"), devices_);
    seed_ = new QSpinBox(group);
    seed_->setRange(0, 1'000'000'000);
    seed_->setValue(1);
    seed_->setToolTip(tr("Of everything random. The same seed on simulated devices gives the same bytes."));
    form->addRow(tr("S&eed"), seed_);
    realtime_ = new QCheckBox(tr("in &real time"), group);
    realtime_->setToolTip(tr("Simulated devices otherwise run as fast as they can. Hardware is always in real time."));
    form->addRow(QString(), realtime_);
    out_ = new QLineEdit(group);
    out_->setObjectName("out");
    out_->setPlaceholderText(tr("the sessions folder"));
    out_->setToolTip(
        tr("Folder for the session, its report and its captures as CSV. Empty: the sessions folder, "
           "without CSV files."));
    auto* choose = new QToolButton(group);
    choose->setText("…");
    choose->setToolTip(tr("Choose a folder."));
    connect(choose, &QToolButton::clicked, this, [this] {
        auto* dialog = new QFileDialog(this, tr("Folder for the run"));
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        dialog->setFileMode(QFileDialog::Directory);
        connect(dialog, &QFileDialog::fileSelected, out_, &QLineEdit::setText);
        dialog->open();
    });
    auto* row = new QHBoxLayout;
    row->addWidget(out_, 1);
    row->addWidget(choose);
    form->addRow(tr("&Output"), row);
    return group;
}

QWidget* ProtocolWorkspace::buildRun() {
    auto* holder = new QWidget;
    auto* layout = new QVBoxLayout(holder);
    layout->setContentsMargins(0, 0, 0, 0);
    trouble_ = new QLabel(holder);
    trouble_->setObjectName("runTrouble");
    trouble_->setWordWrap(true);
    auto red = trouble_->palette();
    red.setColor(QPalette::WindowText, colours().fault);
    trouble_->setPalette(red);
    trouble_->hide();
    layout->addWidget(trouble_);
    auto* row = new QHBoxLayout;
    run_ = new QPushButton(tr("R&un"), holder);
    run_->setObjectName("runButton");
    run_->setToolTip(tr("Opens the devices, arms on the declared load and runs (F5). Esc stops."));
    connect(run_, &QPushButton::clicked, this, &ProtocolWorkspace::run);
    pause_ = new QPushButton(holder);
    pause_->setToolTip(tr("Holds the output back; the script waits at its next step."));
    connect(pause_, &QPushButton::clicked, this, [this] {
        paused_ = !paused_;
        paused_ ? desk_.pause() : desk_.resume();
        showButtons();
    });
    stop_ = new QPushButton(tr("&Stop"), holder);
    stop_->setToolTip(tr("Output off; what was recorded so far is kept (Shift+F5)."));
    connect(stop_, &QPushButton::clicked, this, [this] { desk_.stop("operator (Stop)"); });
    for (auto* button : {run_, pause_, stop_}) {
        button->setAutoDefault(false);
        row->addWidget(button);
    }
    layout->addLayout(row);
    progress_ = new QProgressBar(holder);
    progress_->setAccessibleName(tr("Progress"));
    progress_->setRange(0, 1);
    progress_->setValue(0);
    progress_->setFormat(tr("not started"));
    layout->addWidget(progress_);
    left_ = new QLabel(holder);
    layout->addWidget(left_);
    return holder;
}

QWidget* ProtocolWorkspace::buildTabs() {
    tabs_ = new QTabWidget;
    auto* before = new QWidget(tabs_);
    auto* column = new QVBoxLayout(before);
    worstSays_ = new QLabel(before);
    worstSays_->setObjectName("worstCase");
    worstSays_->setWordWrap(true);
    column->addWidget(worstSays_);
    worst_ = new ExposureTable(before);
    worst_->setAccessibleName(tr("Worst case against the limits"));
    worst_->setToolTip(
        tr("The strongest command into 80 to 120 % of the declared load, from an ideal voltage source. "
           "Hatched: not evaluated, and never a pass."));
    column->addWidget(worst_, 1);
    tabs_->addTab(before, tr("&Worst case"));
    log_ = new QPlainTextEdit(tabs_);
    log_->setReadOnly(true);
    log_->setMaximumBlockCount(5000);  // lines; all of them are in the session
    log_->setPlaceholderText(tr("What the script says while it runs."));
    tabs_->addTab(log_, tr("&Log"));
    result_ = new ResultPanel(tabs_);
    connect(result_, &ResultPanel::reportReady, this, &ProtocolWorkspace::openReport);
    connect(result_, &ResultPanel::scriptErrorChosen, this,
            [this](int line) { edit(line, tr("The run ended here.")); });
    tabs_->addTab(result_, tr("Resul&t"));
    document_ = new QPdfDocument(this);
    pdf_ = new QPdfView(tabs_);
    pdf_->setDocument(document_);
    pdf_->setPageMode(QPdfView::PageMode::MultiPage);
    pdf_->setZoomMode(QPdfView::ZoomMode::FitToWidth);
    tabs_->addTab(pdf_, tr("Repo&rt"));
    tabs_->setTabEnabled(3, false);
    tabs_->setTabToolTip(3, tr("The report of the last run, once it is written and opened."));
    return tabs_;
}

}  // namespace tacto::gui
