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
    controls_ = buildControls();
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

    plots_ = new QSplitter(Qt::Vertical, this);
    plots_->setChildrenCollapsible(false);
    plots_->addWidget(view_);
    plots_->addWidget(spectrum_);
    plots_->addWidget(table_);
    plots_->setStretchFactor(0, 5);
    plots_->setStretchFactor(1, 2);
    plots_->setStretchFactor(2, 2);
    plots_->setSizes({600, 200, 190});
    spectrum_->hide();

    auto* left = new QWidget(this);
    auto* column = new QVBoxLayout(left);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    auto* statusLine = new QHBoxLayout;
    statusLine->addWidget(status_, 1);
    statusLine->addWidget(cancelOpen_);
    column->addLayout(statusLine);
    column->addWidget(readout_);
    column->addWidget(plots_, 1);

    auto* whole = new QWidget(this);
    auto* rows = new QVBoxLayout(whole);
    rows->setContentsMargins(8, 8, 8, 8);
    rows->setSpacing(4);
    rows->addWidget(tools);
    auto* row = new QHBoxLayout;
    row->addWidget(left, 1);
    row->addWidget(controls_);
    rows->addLayout(row, 1);
    connect(controlsShown_, &QToolButton::clicked, this, [this](bool on) {
        controlsWanted_ = on;
        controlsForced_ = on;
        fitControls();
    });

    stack_ = new QStackedWidget(this);
    stack_->addWidget(buildEmpty());
    stack_->addWidget(whole);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSizeConstraint(QLayout::SetNoConstraint);  // see minimumSizeHint()
    layout->addWidget(stack_);

    connectView();
    connect(&desk_, &BenchDesk::changed, this, &ScopeWorkspace::benchChanged);
    connect(&desk_, &BenchDesk::captured, this, [this](std::shared_ptr<const Capture> capture) {
        if (running_) pipe_.take(std::move(capture));
    });
    connect(&desk_, &BenchDesk::scopeStopped, this, &ScopeWorkspace::stopped);
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
    restore();
    benchChanged();
}

/// The view loses the focus while it is taken down, and says so: by then this object is gone.
ScopeWorkspace::~ScopeWorkspace() {
    save();
    disconnect(view_, nullptr, this, nullptr);
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
    scroll->setObjectName("scopeControls");
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

/// Without the column at the right, which goes where there is no room for it: large text must not make the window
/// larger than its screen.
QSize ScopeWorkspace::minimumSizeHint() const {
    return {view_->minimumWidth() + fontMetrics().averageCharWidth() * 4, fontMetrics().height() * 16};
}

void ScopeWorkspace::fitControls() {
    const int needed = view_->minimumWidth() + controls_->sizeHint().width() + fontMetrics().averageCharWidth() * 4;
    const bool room = width() >= needed;
    if (room) controlsForced_ = false;
    const bool on = controlsWanted_ && (room || controlsForced_);
    controlsShown_->setChecked(on);
    controls_->setVisible(on);
}

void ScopeWorkspace::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fitControls();
}

void ScopeWorkspace::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::FontChange || controls_ == nullptr) return;
    readout_->setFont(digits(font()));
    QMetaObject::invokeMethod(this, &ScopeWorkspace::fitControls, Qt::QueuedConnection);  // once all have the new font
}

void ScopeWorkspace::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    save();
}

void ScopeWorkspace::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    benchChanged();
}

}  // namespace tacto::gui
