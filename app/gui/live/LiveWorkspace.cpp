#include "app/gui/live/LiveWorkspace.h"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QVBoxLayout>

#include "app/gui/live/DrivePanel.h"
#include "app/gui/live/ProfileEditor.h"
#include "app/gui/live/StripPlots.h"
#include "app/gui/live/TactilePlane.h"
#include "app/gui/live/TaxelMap.h"
#include "app/gui/look/Look.h"
#include "core/acquisition/Recording.h"

namespace tacto::gui {

LiveWorkspace::LiveWorkspace(BenchDesk& desk, QWidget* parent) : QWidget(parent), desk_(desk) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    stack_ = new QStackedWidget(this);
    layout->addWidget(stack_);

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
    recording->setToolTip(tr("A folder with recording.json: it is replayed into the simulated stimulator."));
    connect(recording, &QPushButton::clicked, this, &LiveWorkspace::chooseRecording);
    column->addWidget(recording, 0, Qt::AlignCenter);
    column->addStretch();
    stack_->addWidget(empty);
    stack_->addWidget(buildBench());
    connect(&desk_, &BenchDesk::changed, this, &LiveWorkspace::begin);
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
    taxels_ = new TaxelMap(side);
    layout->addWidget(taxels_);
    command_ = new QLabel(side);
    command_->setWordWrap(true);
    command_->setAccessibleName(tr("Command"));
    layout->addWidget(command_);
    drive_ = new DrivePanel(desk_, side);
    layout->addWidget(drive_);
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
    auto* freeze = new QPushButton(tr("Free&ze the picture"), foot);
    freeze->setCheckable(true);
    freeze->setToolTip(tr("The picture stands still; output and recording go on."));
    connect(freeze, &QPushButton::toggled, strips_, &StripPlots::setFrozen);
    health_ = new QLabel(foot);
    health_->setAccessibleName(tr("Sensor health"));
    auto* label = new QLabel(tr("&Window"), foot);
    label->setBuddy(window);
    row->addWidget(label);
    row->addWidget(window);
    row->addWidget(freeze);
    row->addSpacing(16);
    row->addWidget(health_, 1);
    return foot;
}

void LiveWorkspace::begin() {
    const auto open = desk_.open();
    stack_->setCurrentIndex(open ? 1 : 0);
    if (desk_.tap() != tap_) {
        tap_ = desk_.tap();
        history_.begin(open ? open->streams : std::vector<StreamInfo>{});
        strips_->begin(open && open->simulated());
        plane_->setSimulated(open && open->simulated());
        taxels_->clear();
        drive_->begin();
        if (open && open->source) strips_->setCommandUnit(open->source->drive == Drive::Current ? "mA" : "V");
    }
    plane_->setConditions(desk_.profile().encoding.conditions);
}

void LiveWorkspace::refresh(const Telemetry& telemetry, bool visible) {
    if (!tap_) return;
    history_.take(*tap_, telemetry);
    if (!visible || stack_->currentIndex() == 0) return;
    drive_->refresh(telemetry);
    strips_->redraw();
    plane_->show(history_.frames(), history_.now_s(), telemetry.roughness, telemetry.pressure);
    if (++frame_ % 3 != 0) return;  // ten times a second is as fast as one reads
    showHealth(telemetry);
    showCommand(telemetry);
    const auto* series = history_.samples(StreamKind::Taxels);
    if (series == nullptr || series->size() == 0) return;
    std::vector<float> newest;
    for (std::size_t c = 0; c < series->channels(); ++c) newest.push_back(series->value(series->size() - 1, c));
    const auto unit = symbolOf(history_.info(StreamKind::Taxels)->unit);
    taxels_->show(newest, QString::fromUtf8(unit.data(), qsizetype(unit.size())));
}

void LiveWorkspace::showHealth(const Telemetry& telemetry) {
    QStringList words;
    const auto open = desk_.open();
    if (open && open->streams.empty()) {
        words << tr("No fingertip is open.");
    } else if (!std::isfinite(telemetry.sensorAge_s)) {
        words << tr("No sample has come yet.");
    } else if (telemetry.sensorAge_s > 0.1) {
        words << tr("⚠ Stale: the newest sample is %1 old. No train is driven by it.")
                     .arg(quantityText(telemetry.sensorAge_s, "s", 2));
    } else {
        words << tr("Samples are fresh.");
    }
    if (telemetry.gaps > 0) words << tr("%n gap(s)", nullptr, int(telemetry.gaps));
    if (telemetry.samplesLost > 0) words << tr("%1 samples lost").arg(telemetry.samplesLost);
    if (!desk_.profile().roughness.calibrated) words << tr("uncalibrated R");
    health_->setText(words.join(" · "));
    auto colour = palette();
    if (telemetry.sensorAge_s > 0.1) colour.setColor(QPalette::WindowText, colours().amber);
    health_->setPalette(colour);
}

void LiveWorkspace::showCommand(const Telemetry& telemetry) {
    const auto number = [](double value) {
        return std::isfinite(value) ? QString::number(value, 'f', 2) : QString("–");
    };
    auto text = tr("R %1 · P %2").arg(number(telemetry.roughness), number(telemetry.pressure));
    text += "<br>" + (std::isfinite(telemetry.amplitude_v) ? tr("A %1 every %2")
                                                                 .arg(quantityText(telemetry.amplitude_v, "V", 3),
                                                                      quantityText(telemetry.interval_s, "s", 3))
                                                           : tr("no train is due"));
    if (std::isfinite(telemetry.amplitude_v) && std::isfinite(telemetry.impedance_ohm)) {
        text += tr(", %1 into %2")
                    .arg(quantityText(telemetry.amplitude_v / telemetry.impedance_ohm, "A", 3),
                         quantityText(telemetry.impedance_ohm, "ohm", 3));
    }
    text += "<br>" + tr("%1 delivered, %2 refused, %3 skipped")
                         .arg(telemetry.trainsDelivered)
                         .arg(telemetry.trainsRefused)
                         .arg(telemetry.trainsSkipped);
    if (telemetry.trainsRefused > 0) text += "<br>" + QString::fromUtf8(telemetry.lastRefusal.c_str()).toHtmlEscaped();
    command_->setText(text);
}

void LiveWorkspace::openSimulated() {
    LiveOrder order;
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = desk_.profile();
    desk_.openLive(order);
}

bool LiveWorkspace::openRecording(const QString& path) {
    // Reading it may take a while, on the desk's thread; here only whether there is something to read.
    const std::filesystem::path file = path.toStdString();
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::is_directory(file, error) ? file / "recording.json" : file, error)) {
        const auto recording = Recording::open(file);
        emit refusedRecording(recording ? QString() : QString::fromStdString(recording.error().message));
        return false;
    }
    LiveOrder order;
    order.uris.push_back(DeviceUri{"recording", path.toStdString(), {}});
    order.uris.push_back(*DeviceUri::parse("sim:"));
    order.profile = desk_.profile();
    desk_.openLive(order);
    return true;
}

void LiveWorkspace::chooseRecording() {
    auto* dialog = new QFileDialog(this, tr("Open a recording: its folder"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::Directory);
    connect(dialog, &QFileDialog::fileSelected, this, &LiveWorkspace::openRecording);
    dialog->open();
}

void LiveWorkspace::editProfile() { (new ProfileEditor(desk_, this))->show(); }

}  // namespace tacto::gui
