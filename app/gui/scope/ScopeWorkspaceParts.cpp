// How the oscilloscope's workspace is laid out, its tools, and what is connected to what.
#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QShortcut>
#include <QSplitter>
#include <QStackedWidget>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"
#include "app/gui/scope/AcquisitionPanel.h"
#include "app/gui/scope/LanePanel.h"
#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/ScopeView.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/SpectrumPanel.h"
#include "app/gui/scope/ViewPanel.h"

namespace tacto::gui {

namespace {

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
    // The tab key follows the order of creation: tools, screen, controls, measurements.
    buildMenu();
    auto* tools = buildTools();
    view_ = new ScopeView(this);
    auto* controls = buildControls();
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

/// The view loses the focus while it is taken down, and says so: by then nobody is here to listen.
ScopeWorkspace::~ScopeWorkspace() { disconnect(view_, nullptr, this, nullptr); }

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
    auto* lanes = new LanePanel(*view_, this);
    viewPanel_ = new ViewPanel(*view_, this);
    acquisition_ = new AcquisitionPanel(this);
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
    section(tr("Lanes"), lanes);
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

void ScopeWorkspace::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    benchChanged();
}

}  // namespace tacto::gui
