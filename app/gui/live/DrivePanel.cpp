#include "app/gui/live/DrivePanel.h"

#include <QFormLayout>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {
constexpr int kSteps = 100;  // of a slider from 0 to 1
}

DrivePanel::DrivePanel(BenchDesk& desk, QWidget* parent) : QWidget(parent), desk_(desk) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* group = new QGroupBox(tr("Drive"), this);
    auto* inner = new QVBoxLayout(group);
    sources_ = new QButtonGroup(this);
    off_ = new QRadioButton(tr("O&ff"), group);
    off_->setToolTip(tr("No train is sent."));
    byHand_ = new QRadioButton(tr("By &hand"), group);
    byHand_->setToolTip(tr("R and P come from the two sliders."));
    finger_ = new QRadioButton(tr("From the fin&gertip"), group);
    finger_->setToolTip(tr("R and P come from what the fingertip feels; without contact no train is sent."));
    auto* row = new QHBoxLayout;
    for (auto* button : {off_, byHand_, finger_}) {
        sources_->addButton(button);
        row->addWidget(button);
        connect(button, &QRadioButton::clicked, this, &DrivePanel::drive);
    }
    row->addStretch();
    off_->setChecked(true);
    inner->addLayout(row);
    auto* grid = new QGridLayout;
    roughness_ = addIndex(*grid, 0, tr("&R"), tr("Roughness, 0 smooth to 1 rough: sets the amplitude."));
    pressure_ = addIndex(*grid, 1, tr("&P"), tr("Pressure, 0 light to 1 firm: sets the interval."));
    inner->addLayout(grid);
    says_ = new QLabel(group);
    says_->setWordWrap(true);
    says_->setForegroundRole(QPalette::PlaceholderText);
    inner->addWidget(says_);
    layout->addWidget(group);
    surfaces_ = buildSurfaces();
    layout->addWidget(surfaces_);
    pace_ = buildSpeed();
    layout->addWidget(pace_);
    begin();
}

DrivePanel::Index DrivePanel::addIndex(QGridLayout& grid, int row, const QString& name, const QString& tip) {
    Index index{new QSlider(Qt::Horizontal, this), new QDoubleSpinBox(this)};
    index.slider->setRange(0, kSteps);
    index.slider->setSingleStep(1);
    index.slider->setPageStep(10);
    index.slider->setToolTip(tip);
    index.slider->setAccessibleName(QString(name).remove('&'));
    index.box->setRange(0, 1);
    index.box->setDecimals(2);
    index.box->setSingleStep(0.01);
    index.box->setToolTip(tip);
    index.box->setAccessibleName(QString(name).remove('&'));
    auto* label = new QLabel(name, this);
    label->setBuddy(index.box);
    grid.addWidget(label, row, 0);
    grid.addWidget(index.slider, row, 1);
    grid.addWidget(index.box, row, 2);
    connect(index.slider, &QSlider::valueChanged, index.box,
            [box = index.box](int v) { box->setValue(double(v) / kSteps); });
    connect(index.box, &QDoubleSpinBox::valueChanged, this, [this, index](double v) {
        const QSignalBlocker quiet(index.slider);
        index.slider->setValue(int(std::lround(v * kSteps)));
        if (byHand_->isChecked()) drive();
    });
    return index;
}

QWidget* DrivePanel::buildSurfaces() {
    auto* group = new QGroupBox(tr("Under the simulated finger"), this);
    auto* form = new QFormLayout(group);
    material_ = new QComboBox(group);
    for (const auto* name : {"glass", "plastic", "paper", "denim", "P400", "P120", "P60"})
        material_->addItem(name, name);
    material_->insertItem(0, tr("nothing (lifted)"), "");
    material_->setCurrentIndex(0);
    material_->setToolTip(tr("The surface the finger slides over, from smooth to rough."));
    form->addRow(tr("S&urface"), material_);
    speed_ = new QDoubleSpinBox(group);
    speed_->setRange(0, 200);
    speed_->setValue(50);
    speed_->setSuffix(" mm/s");
    speed_->setToolTip(tr("Sliding speed. At 0 the finger rests and R is absent."));
    form->addRow(tr("Sp&eed"), speed_);
    force_ = new QDoubleSpinBox(group);
    force_->setRange(0.05, 10);
    force_->setSingleStep(0.1);
    force_->setValue(1);
    force_->setSuffix(" N");
    force_->setToolTip(tr("Normal force: more is firmer."));
    form->addRow(tr("F&orce"), force_);
    connect(material_, &QComboBox::currentIndexChanged, this, &DrivePanel::slide);
    connect(speed_, &QDoubleSpinBox::valueChanged, this, &DrivePanel::slide);
    connect(force_, &QDoubleSpinBox::valueChanged, this, &DrivePanel::slide);
    return group;
}

QWidget* DrivePanel::buildSpeed() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
    auto* label = new QLabel(tr("Time runs at"), holder);
    paceBox_ = new QComboBox(holder);
    for (const double pace : {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0}) paceBox_->addItem(tr("%1 ×").arg(pace), pace);
    paceBox_->setCurrentIndex(3);
    paceBox_->setToolTip(
        tr("Speed of simulated time against real time. Trains keep their interval in simulated time."));
    paceBox_->setAccessibleName(label->text());
    label->setBuddy(paceBox_);
    row->addWidget(label);
    row->addWidget(paceBox_);
    row->addStretch();
    connect(paceBox_, &QComboBox::currentIndexChanged, this,
            [this] { desk_.setSpeed(paceBox_->currentData().toDouble()); });
    return holder;
}

void DrivePanel::begin() {
    const auto open = desk_.open();
    finger_->setEnabled(open && !open->streams.empty());
    surfaces_->setVisible(open && open->surfaces);
    pace_->setVisible(open && open->paced);
    off_->setChecked(true);
    const QSignalBlocker quiet(material_);
    material_->setCurrentIndex(material_->findData("P120"));  // the twin's finger begins there
    paceBox_->setCurrentIndex(3);
}

void DrivePanel::drive() {
    const auto source = byHand_->isChecked()   ? DriveSource::Manual
                        : finger_->isChecked() ? DriveSource::Sensor
                                               : DriveSource::Off;
    desk_.drive(source, roughness_.box->value(), pressure_.box->value());
}

void DrivePanel::slide() {
    desk_.present(material_->currentData().toString().toStdString(), speed_->value(), force_->value());
}

void DrivePanel::refresh(const Telemetry& telemetry) {
    // The bench turns driving off with every stop, disarm and fault.
    const auto state = telemetry.state;
    const auto wasOn = seen_ != InterlockState::Disarmed && seen_ != InterlockState::Faulted &&
                       seen_ != InterlockState::Disconnected && seen_ != InterlockState::Checking;
    if (wasOn && (state == InterlockState::Disarmed || state == InterlockState::Faulted)) off_->setChecked(true);
    seen_ = state;
    const bool on = state == InterlockState::Armed || state == InterlockState::Delivering;
    if (off_->isChecked())
        says_->setText(tr("Nothing drives the output."));
    else if (!on)
        says_->setText(tr("Nothing is delivered until the output is armed."));
    else if (std::isfinite(telemetry.amplitude_v))
        says_->setText(
            tr("Commanded: %1 every %2")
                .arg(quantityText(telemetry.amplitude_v, "V", 3), quantityText(telemetry.interval_s, "s", 3)));
    else
        says_->setText(tr("Armed, and no train is due: nothing is felt."));
}

}  // namespace tacto::gui
