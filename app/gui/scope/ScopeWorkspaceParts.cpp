// How the oscilloscope's workspace is laid out, its tools and menus, saving and copying.
#include <QAction>
#include <QButtonGroup>
#include <QClipboard>
#include <QDragEnterEvent>
#include <QFile>
#include <QFileDialog>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
#include <QStackedWidget>
#include <QTemporaryDir>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"
#include "app/gui/scope/AcquisitionPanel.h"
#include "app/gui/scope/LanePanel.h"
#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/ScopeExport.h"
#include "app/gui/scope/ScopeView.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/SpectrumPanel.h"
#include "app/gui/scope/ViewPanel.h"

namespace tacto::gui {

namespace {

constexpr std::size_t kMostCopied = 200'000;  ///< samples a channel, as text on the clipboard

/// A column of controls that scrolls up and down and is always as wide as they are.
class ControlColumn final : public QScrollArea {
public:
    explicit ControlColumn(QWidget* parent) : QScrollArea(parent) {
        setWidgetResizable(true);
        setFrameShape(QFrame::NoFrame);
        setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
        setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    }
    QSize sizeHint() const override {
        const int width = widget() == nullptr ? 0 : widget()->minimumSizeHint().width();
        return {width + verticalScrollBar()->sizeHint().width(), QScrollArea::sizeHint().height()};
    }
    QSize minimumSizeHint() const override { return {sizeHint().width(), fontMetrics().height() * 6}; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
        return QScrollArea::eventFilter(watched, event);
    }
};

}  // namespace

ScopeWorkspace::ScopeWorkspace(BenchDesk& desk, QWidget* parent) : QWidget(parent), desk_(desk) {
    setAcceptDrops(true);
    view_ = new ScopeView(this);
    spectrum_ = new SpectrumPanel(this);
    table_ = new MeasurementTable(this);
    status_ = new QLabel(this);
    status_->setObjectName("scopeStatus");
    status_->setWordWrap(true);
    readout_ = new QLabel(this);
    readout_->setObjectName("cursorReadout");
    readout_->setFont(digits(font()));
    readout_->setWordWrap(true);
    readout_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    readout_->hide();
    buildMenu();
    auto* tools = buildTools();

    auto* plots = new QSplitter(Qt::Vertical, this);
    plots->setChildrenCollapsible(false);
    plots->addWidget(view_);
    plots->addWidget(spectrum_);
    plots->addWidget(table_);
    plots->setStretchFactor(0, 5);
    plots->setStretchFactor(1, 2);
    plots->setStretchFactor(2, 2);
    plots->setSizes({600, 200, 190});
    spectrum_->hide();

    auto* left = new QWidget(this);
    auto* column = new QVBoxLayout(left);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addWidget(tools);
    auto* statusLine = new QHBoxLayout;
    statusLine->addWidget(status_, 1);
    statusLine->addWidget(cancelOpen_);
    column->addLayout(statusLine);
    column->addWidget(readout_);
    column->addWidget(plots, 1);

    auto* whole = new QWidget(this);
    auto* row = new QHBoxLayout(whole);
    row->setContentsMargins(8, 8, 8, 8);
    row->addWidget(left, 1);
    auto* controls = buildControls();
    row->addWidget(controls);
    connect(controlsShown_, &QToolButton::toggled, controls, &QWidget::setVisible);

    stack_ = new QStackedWidget(this);
    stack_->addWidget(buildEmpty());
    stack_->addWidget(whole);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(stack_);

    connectView();
    connect(&desk_, &BenchDesk::changed, this, &ScopeWorkspace::benchChanged);
    connect(&desk_, &BenchDesk::captured, this, [this](std::shared_ptr<const Capture> capture) {
        if (running_) pipe_.take(std::move(capture));
    });
    connect(&pipe_, &CapturePipe::prepared, this, &ScopeWorkspace::take);
    connect(&pipe_, &CapturePipe::recalculated, this, [this](const ShownPtr& shown) {
        // A newer capture already has the new calculation.
        if (view_->shown() && view_->shown()->capture == shown->capture) view_->replaceMath(shown);
    });
    connect(&pipe_, &CapturePipe::openingChanged, this, &ScopeWorkspace::showState);
    connect(&pipe_, &CapturePipe::failed, this, [this](const QString& what) {
        problem_ = what;
        showState();
    });
    connect(&pipe_, &CapturePipe::saved, this, [this](const QString& path) {
        done_ = tr("Saved %1.").arg(path);
        showState();
    });
    acquisition_->setLevelHeld(true);
    for (const auto& [key, mode] : {std::pair{Qt::Key_A, ScopeMode::Auto}, std::pair{Qt::Key_N, ScopeMode::Normal},
                                    std::pair{Qt::Key_S, ScopeMode::Single}}) {
        auto* shortcut = new QShortcut(QKeySequence(key), this);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        connect(shortcut, &QShortcut::activated, this, [this, mode = mode] { setMode(mode); });
    }
    auto* undo = new QShortcut(QKeySequence::Undo, this);
    undo->setContext(Qt::WidgetWithChildrenShortcut);
    connect(undo, &QShortcut::activated, this, [this] { view_->undoZoom(); });
    benchChanged();
}

void ScopeWorkspace::connectView() {
    connect(view_, &ScopeView::cursorsChanged, this, &ScopeWorkspace::sayCursors);
    connect(view_, &ScopeView::viewChanged, this, [this] {
        undo_->setEnabled(view_->canUndo());
        sayCursors();
        showSpectrum();
    });
    connect(view_, &ScopeView::lanesChanged, this, [this] {
        spectrum_->setLanes(view_->lanes());
        showSpectrum();
    });
    connect(view_, &ScopeView::boxZoomEnded, this, [this] { box_->setChecked(false); });
    connect(view_, &ScopeView::triggerLevelChosen, this, [this](double level) {
        acquisition_->setLevel(level);
        if (running_) request();
        say();
    });
    connect(view_, &ScopeView::preTriggerChosen, acquisition_, &AcquisitionPanel::setPreTrigger);
    connect(acquisition_, &AcquisitionPanel::changed, this, [this] {
        if (running_) request();
        say();
    });
    connect(viewPanel_, &ViewPanel::wishChanged, this, [this] {
        pipe_.setWish(viewPanel_->wish());
        pipe_.recalculate(view_->shown());
    });
    connect(viewPanel_, &ViewPanel::spectrumToggled, this, &ScopeWorkspace::showSpectrum);
    connect(spectrum_, &SpectrumPanel::laneChosen, this, &ScopeWorkspace::showSpectrum);
    view_->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(view_, &QWidget::customContextMenuRequested, this,
            [this](const QPoint& at) { menu_->popup(view_->mapToGlobal(at)); });
}

QToolButton* ScopeWorkspace::tool(const QString& text, const QString& tip, bool checkable) {
    auto* button = new QToolButton(this);
    button->setText(text);
    button->setToolTip(tip);
    button->setCheckable(checkable);
    button->setFocusPolicy(Qt::StrongFocus);
    return button;
}

QWidget* ScopeWorkspace::buildTools() {
    // A tool bar folds what does not fit behind an arrow.
    auto* bar = new QToolBar(this);
    bar->setMovable(false);
    bar->layout()->setSpacing(3);
    bar->layout()->setContentsMargins(0, 0, 0, 0);
    run_ = new QPushButton(tr("Run"), this);
    run_->setToolTip(tr("Run takes captures; Hold keeps the picture. Neither touches the output: STOP does."));
    connect(run_, &QPushButton::clicked, this, [this] { running_ ? hold() : run(); });
    bar->addWidget(run_);
    modes_ = new QButtonGroup(this);
    const auto mode = [&](ScopeMode which, const QString& text, const QString& tip) {
        auto* button = tool(text, tip, true);
        modes_->addButton(button, static_cast<int>(which));
        button->setChecked(which == mode_);
        connect(button, &QToolButton::clicked, this, [this, which] { setMode(which); });
        bar->addWidget(button);
    };
    mode(ScopeMode::Auto, tr("Auto"), tr("A: the trigger level follows a fifth of the commanded amplitude."));
    mode(ScopeMode::Normal, tr("Normal"), tr("N: captures whenever the signal rises through the level set here."));
    mode(ScopeMode::Single, tr("Single"), tr("S: takes one capture and holds it."));
    mode(ScopeMode::Roll, tr("Roll"),
         tr("Captures one after the other on the session's time. A capture is a record "
            "around a trigger: what lies between them was not recorded and is hatched."));
    bar->addSeparator();
    auto* fit =
        tool(tr("Fit"), tr("Home or a double click: the whole record, every lane as large as it can be."), false);
    connect(fit, &QToolButton::clicked, this, [this] { view_->fit(); });
    undo_ = tool(tr("Undo zoom"), tr("Ctrl+Z: back to the view before."), false);
    connect(undo_, &QToolButton::clicked, this, [this] { view_->undoZoom(); });
    box_ = tool(tr("Box"), tr("The next drag draws a box that becomes the whole screen. Shift+drag does it at once."),
                true);
    connect(box_, &QToolButton::toggled, this, [this](bool on) { view_->setBoxZoom(on); });
    timeCursors_ = tool(tr("Time cursors"),
                        tr("Two cursors across time. They snap to edges; arrows nudge the one with "
                           "the filled tag, Ctrl+arrow jumps to the next edge, 1 and 2 choose."),
                        true);
    connect(timeCursors_, &QToolButton::toggled, this, [this](bool on) { view_->setTimeCursors(on); });
    levelCursors_ = tool(tr("Level cursors"),
                         tr("Two cursors across the active lane's level. They snap to where the "
                            "signal rests; up and down nudge, 3 and 4 choose."),
                         true);
    connect(levelCursors_, &QToolButton::toggled, this, [this](bool on) { view_->setLevelCursors(on); });
    for (auto* button : {fit, undo_, box_, timeCursors_, levelCursors_}) bar->addWidget(button);
    bar->addSeparator();
    auto* save = tool(tr("Save"), tr("Copies and saves the picture and its data, opens captures."), false);
    save->setPopupMode(QToolButton::InstantPopup);
    save->setMenu(menu_);
    bar->addWidget(save);
    controlsShown_ =
        tool(tr("Controls"), tr("Shows or hides the column at the right, to give the screen its room."), true);
    controlsShown_->setChecked(true);
    bar->addWidget(controlsShown_);
    cancelOpen_ = tool(tr("Cancel"), tr("Gives up reading. What is shown stays."), false);
    connect(cancelOpen_, &QToolButton::clicked, &pipe_, &CapturePipe::cancelOpen);
    return bar;
}

QWidget* ScopeWorkspace::buildControls() {
    acquisition_ = new AcquisitionPanel(this);
    viewPanel_ = new ViewPanel(*view_, this);
    auto* inside = new QWidget(this);
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(4, 0, 8, 0);
    column->setSpacing(6);
    const auto section = [&](const QString& title, QWidget* panel) {
        auto* name = new QLabel(title, this);
        auto bold = name->font();
        bold.setBold(true);
        name->setFont(bold);
        column->addWidget(name);
        column->addWidget(panel);
        column->addSpacing(6);
    };
    section(tr("Lanes"), new LanePanel(*view_, this));
    section(tr("View"), viewPanel_);
    section(tr("Trigger and record"), acquisition_);
    column->addStretch();
    auto* scroll = new ControlColumn(this);
    scroll->setWidget(inside);
    return scroll;
}

QWidget* ScopeWorkspace::buildEmpty() {
    auto* empty = new EmptyState(tr("The oscilloscope shows and measures what really arrives at the electrodes.\n"
                                    "No bench is open, and no capture is loaded."),
                                 tr("Open the simulated bench"), this);
    connect(empty, &EmptyState::nextStep, this, &ScopeWorkspace::openBenchWanted);
    auto* open = new QPushButton(tr("Open a capture…"), empty);
    open->setToolTip(tr("A CSV file with time_s and a column per channel, as this program saves them."));
    connect(open, &QPushButton::clicked, this, &ScopeWorkspace::askOpen);
    auto* column = static_cast<QVBoxLayout*>(empty->layout());
    column->insertWidget(column->count() - 1, open, 0, Qt::AlignCenter);
    return empty;
}

void ScopeWorkspace::buildMenu() {
    menu_ = new QMenu(this);
    menu_->setToolTipsVisible(true);
    menu_->addAction(tr("Open a capture…"), this, &ScopeWorkspace::askOpen);
    menu_->addSeparator();
    menu_->addAction(tr("Copy picture"), this, &ScopeWorkspace::copyPicture);
    menu_->addAction(tr("Copy visible data"), this, &ScopeWorkspace::copyData);
    menu_->addAction(tr("Copy measurements"), this,
                     [this] { QGuiApplication::clipboard()->setText(table_->asText()); });
    menu_->addSeparator();
    menu_->addAction(tr("Save picture as PNG…"), this, [this] { askSave(tr("PNG picture (*.png)"), "png"); });
    menu_->addAction(tr("Save picture as SVG…"), this, [this] { askSave(tr("SVG drawing (*.svg)"), "svg"); });
    menu_->addAction(tr("Save picture as PDF…"), this, [this] { askSave(tr("PDF document (*.pdf)"), "pdf"); });
    menu_->addAction(tr("Save visible data as CSV…"), this, [this] { askSave(tr("Capture (*.csv)"), "csv"); });
}

void ScopeWorkspace::askOpen() {
    const auto path =
        QFileDialog::getOpenFileName(this, tr("Open a capture"), {}, tr("Captures (*.csv);;All files (*)"));
    if (!path.isEmpty()) openCaptureFile(path);
}

void ScopeWorkspace::askSave(const QString& filter, const QString& ending) {
    auto path = QFileDialog::getSaveFileName(this, tr("Save"), "scope." + ending, filter);
    if (path.isEmpty()) return;
    if (!path.endsWith("." + ending, Qt::CaseInsensitive)) path += "." + ending;
    saveAs(path);
}

void ScopeWorkspace::saveAs(const QString& path) {
    problem_.clear();
    done_.clear();
    if (path.endsWith(".csv", Qt::CaseInsensitive)) {
        const double zero = view_->zero_s();
        pipe_.save(view_->shown(), view_->viewport().left_s + zero, view_->viewport().right_s() + zero, path);
        return;
    }
    if (const auto wrong = savePicture(*view_, path)) {
        problem_ = *wrong;
    } else {
        done_ = tr("Saved %1.").arg(path);
    }
    showState();
}

void ScopeWorkspace::copyPicture() {
    QGuiApplication::clipboard()->setImage(pictureOf(*view_, 2));
    done_ = tr("The picture is on the clipboard.");
    showState();
}

void ScopeWorkspace::copyData() {
    const auto& shown = view_->shown();
    if (!shown) return;
    const double from = view_->viewport().left_s + view_->zero_s(), to = view_->viewport().right_s() + view_->zero_s();
    done_.clear();
    problem_.clear();
    const QTemporaryDir folder;
    const auto path = folder.filePath("copied.csv");
    if ((std::min(to, shown->end_s()) - std::max(from, shown->capture->start_s)) * shown->capture->rate_hz >
        static_cast<double>(kMostCopied)) {
        problem_ = tr("More than %1 samples are on the screen, too many to copy: zoom in, or save them as CSV.")
                       .arg(kMostCopied);
    } else if (const auto wrong = saveData(*shown, from, to, path)) {
        problem_ = *wrong;
    } else if (QFile file(path); file.open(QIODevice::ReadOnly)) {
        QGuiApplication::clipboard()->setText(QString::fromUtf8(file.readAll()));
        done_ = tr("The visible data are on the clipboard.");
    }
    showState();
}

void ScopeWorkspace::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    benchChanged();
}

void ScopeWorkspace::dragEnterEvent(QDragEnterEvent* event) {
    const auto urls = event->mimeData()->urls();
    if (!urls.isEmpty() && urls.first().toLocalFile().endsWith(".csv", Qt::CaseInsensitive)) {
        event->acceptProposedAction();
    }
}

void ScopeWorkspace::dropEvent(QDropEvent* event) { openCaptureFile(event->mimeData()->urls().first().toLocalFile()); }

}  // namespace tacto::gui
