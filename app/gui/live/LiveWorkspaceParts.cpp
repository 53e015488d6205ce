// How the live workspace is laid out.
#include <QHBoxLayout>
#include <QScrollArea>
#include <QSplitter>
#include <QVBoxLayout>

#include "app/gui/live/CommandPanel.h"
#include "app/gui/live/DrivePanel.h"
#include "app/gui/live/LiveWorkspace.h"
#include "app/gui/live/RigPanel.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/live/TactilePlane.h"
#include "app/gui/live/TaxelMap.h"
#include "app/gui/look/Look.h"

namespace tacto::gui {

LiveWorkspace::LiveWorkspace(BenchDesk& desk, QWidget* parent) : QWidget(parent), desk_(desk) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    stack_ = new QStackedWidget(this);
    layout->addWidget(stack_);
    stack_->addWidget(buildEmpty());
    auto* opening = new QLabel(tr("Opening…"), stack_);
    opening->setAlignment(Qt::AlignCenter);
    stack_->addWidget(opening);
    stack_->addWidget(buildBench());
    connect(&desk_, &BenchDesk::changed, this, &LiveWorkspace::begin);
    connect(&desk_, &BenchDesk::captured, this, [this](const std::shared_ptr<const Capture>& capture) {
        if (capture && !capture->untriggered) readCapture(*capture);  // one that shows a train, not just the signal
    });
    connect(&desk_, &BenchDesk::failed, this, [this] {
        if (desk_.activity() == Activity::Opening) pendingSpeed_.reset();
    });
    begin();
}

QWidget* LiveWorkspace::buildEmpty() {
    auto* empty = new QWidget(stack_);
    auto* column = new QVBoxLayout(empty);
    column->addStretch();
    auto* what = new EmptyState(tr("No device is open. Here you see what a fingertip feels, and drive the stimulator "
                                   "with it or by hand."),
                                tr("Open the simulated bench"), empty);
    connect(what, &EmptyState::nextStep, this, &LiveWorkspace::openSimulated);
    what->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    column->addWidget(what);
    auto* recording = new QPushButton(tr("Open a &recording…"), empty);
    recording->setToolTip(
        tr("The recording.json of a recorded fingertip: it is replayed into the simulated stimulator."));
    connect(recording, &QPushButton::clicked, this, &LiveWorkspace::chooseRecording);
    column->addWidget(recording, 0, Qt::AlignCenter);
    auto* example = new QPushButton(tr("Replay the &example"), empty);
    example->setToolTip(tr("A real fingertip sliding over linen at 20 mm/s, from a public data set."));
    connect(example, &QPushButton::clicked, this, &LiveWorkspace::replayExample);
    column->addWidget(example, 0, Qt::AlignCenter);
    column->addStretch();
    return empty;
}

QWidget* LiveWorkspace::buildBench() {
    auto* bench = new QWidget(stack_);
    auto* layout = new QVBoxLayout(bench);
    layout->setContentsMargins(6, 6, 6, 6);
    auto* split = new QSplitter(Qt::Horizontal, bench);
    split->setChildrenCollapsible(false);
    strips_ = new StripPlots(history_, split);
    strips_->setMinimumWidth(fontMetrics().averageCharWidth() * 40);
    split->addWidget(strips_);
    split->addWidget(buildSide());
    split->setStretchFactor(0, 1);
    split->setStretchFactor(1, 0);
    layout->addWidget(split, 1);
    layout->addWidget(buildFoot());
    return bench;
}

QWidget* LiveWorkspace::buildSide() {
    auto* area = new QScrollArea;
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* side = new QWidget(area);
    auto* layout = new QVBoxLayout(side);
    layout->setContentsMargins(6, 0, 6, 0);
    plane_ = new TactilePlane(side);
    layout->addWidget(plane_, 1);
    command_ = new CommandPanel(side);
    layout->addWidget(command_);
    drive_ = new DrivePanel(desk_, side);
    layout->addWidget(drive_);
    taxels_ = new TaxelMap(side);
    layout->addWidget(taxels_);
    rig_ = new RigPanel(desk_, side);
    connect(rig_, &RigPanel::replayAgain, this, &LiveWorkspace::replayAgain);
    layout->addWidget(rig_);
    auto* profile = new QPushButton(tr("Encoding pro&file…"), side);
    profile->setToolTip(tr("How R and P become amplitude and interval, and the shape of a pulse."));
    connect(profile, &QPushButton::clicked, this, &LiveWorkspace::editProfile);
    layout->addWidget(profile);
    area->setWidget(side);
    area->setMinimumWidth(side->minimumSizeHint().width() + fontMetrics().averageCharWidth() * 4);
    return area;
}

QWidget* LiveWorkspace::buildFoot() {
    auto* foot = new QWidget(stack_);
    auto* row = new QHBoxLayout(foot);
    row->setContentsMargins(0, 0, 0, 0);
    auto* window = new QComboBox(foot);
    for (const int seconds : {2, 5, 10, 30}) window->addItem(tr("%1 s").arg(seconds), seconds);
    window->setCurrentIndex(2);
    window->setToolTip(tr("How much time the plots show."));
    window->setAccessibleName(tr("Window"));
    connect(window, &QComboBox::currentIndexChanged, this,
            [this, window] { strips_->setWindow(window->currentData().toDouble()); });
    freeze_ = new QPushButton(tr("Free&ze the picture"), foot);
    freeze_->setCheckable(true);
    freeze_->setToolTip(tr("The plots stand still, to be dragged and zoomed; output and recording go on."));
    connect(freeze_, &QPushButton::toggled, strips_, &StripPlots::setFrozen);
    health_ = new QLabel(foot);
    health_->setObjectName("sensorHealth");
    health_->setAccessibleName(tr("Sensor health"));
    health_->setToolTip(
        tr("Age of the newest sample, places where samples are missing, samples that came too fast to be "
           "kept; then the flags of R and P. Old samples drive no train."));
    health_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    health_->setWordWrap(true);
    auto* label = new QLabel(tr("&Window"), foot);
    label->setBuddy(window);
    row->addWidget(label);
    row->addWidget(window);
    row->addWidget(freeze_);
    row->addSpacing(fontMetrics().averageCharWidth() * 2);
    row->addWidget(health_, 1);
    return foot;
}

}  // namespace tacto::gui
