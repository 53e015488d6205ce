#include "app/gui/live/DrivePanel.h"

#include <QGridLayout>
#include <QKeyEvent>
#include <cmath>

#include "app/gui/controller/FirstOutput.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/TypedSpin.h"
#include "core/encoding/Encoder.h"

namespace tacto::gui {

namespace {

constexpr int kSteps = 100;            // a slider's steps from 0 to 1
constexpr int kAnswerWithin_ms = 400;  // the bench takes a command at its next step, which comes later in slowed time

}  // namespace

DrivePanel::DrivePanel(BenchController& controller, QWidget* parent) : QWidget(parent), controller_(controller) {
    auto* layout = columnIn(*this, 8);
    sources_ = new QButtonGroup(this);
    off_ = new QPushButton(tr("Off"), this);
    off_->setToolTip(
        tr("No train is sent. Every stop, disarm and fault comes back to this. Arrows move, Return chooses."));
    byHand_ = new QPushButton(tr("By hand"), this);
    byHand_->setObjectName("driveByHand");
    byHand_->setToolTip(tr("R and P come from the two sliders. Arrows move, Return chooses."));
    finger_ = new QPushButton(tr("Fingertip"), this);
    finger_->setObjectName("driveFingertip");
    finger_->setToolTip(tr("R and P come from what the fingertip feels; without contact no train is sent."));
    auto* row = new QHBoxLayout;
    row->setSpacing(0);
    for (auto* button : {off_, byHand_, finger_}) {
        button->setCheckable(true);
        button->setAutoDefault(false);
        button->setProperty("role", "segment");
        sources_->addButton(button);
        row->addWidget(button, 1);
        button->installEventFilter(this);
        connect(button, &QPushButton::clicked, this, &DrivePanel::choose);
    }
    off_->setProperty("first", true);
    off_->setChecked(true);
    layout->addLayout(row);
    auto* grid = new QGridLayout;
    addIndex(*grid, roughness_, "driveRoughness", tr("R"), tr("Roughness R"),
             tr("Roughness, 0 smooth to 1 rough. Arrows step by 0.01, Page up and down by 0.1."));
    addIndex(*grid, pressure_, "drivePressure", tr("P"), tr("Pressure P"),
             tr("Pressure, 0 light to 1 firm. Arrows step by 0.01, Page up and down by 0.1."));
    layout->addLayout(grid);
    output_ = makeLabel({}, {.name = "driveOutput", .size = TextSize::Large}, this);
    layout->addWidget(output_);
    says_ = makeLabel({}, {.name = "driveSays", .wraps = true}, this);
    says_->setAlignment(Qt::AlignTop);
    setTone(*says_, Tone::Quiet);
    setTextSize(*says_, TextSize::Small);
    says_->setMinimumHeight(2 * QFontMetrics(textFont(TextSize::Small)).lineSpacing());  // keeps room for two lines
    layout->addWidget(says_);
    begin();
}

void DrivePanel::addIndex(QGridLayout& grid, Index& index, const char* objectName, const QString& label,
                          const QString& name, const QString& tip) {
    index.slider = new QSlider(Qt::Horizontal, this);
    index.box = new TypedSpin(this);
    index.slider->setRange(0, kSteps);
    index.slider->setSingleStep(1);
    index.slider->setPageStep(10);
    index.slider->setToolTip(tip);
    index.slider->setAccessibleName(name);
    index.box->setObjectName(objectName);
    index.box->setRange(0, 1);
    index.box->setDecimals(2);
    index.box->setButtonSymbols(QAbstractSpinBox::NoButtons);  // the slider next to the box replaces its buttons
    index.box->setAlignment(Qt::AlignRight);
    index.box->setSingleStep(0.01);
    index.box->setToolTip(tip);
    index.box->setAccessibleName(name);
    index.box->setKeyboardTracking(false);  // a number takes effect only once typed in full
    auto* text = new QLabel(label, this);
    text->setBuddy(index.box);
    const int row = grid.isEmpty() ? 0 : grid.rowCount();
    grid.addWidget(text, row, 0);
    grid.addWidget(index.slider, row, 1);
    grid.addWidget(index.box, row, 2);
    connect(index.slider, &QSlider::valueChanged, index.box,
            [box = index.box](int v) { box->setValue(double(v) / kSteps); });
    connect(index.box, &QDoubleSpinBox::valueChanged, this, [this, &index](double v) {
        const QSignalBlocker quiet(index.slider);
        index.slider->setValue(int(std::lround(v * kSteps)));
        auto hand = controller_.hand();
        hand.*index.its = v;
        controller_.setHand(hand);
        if (byHand_->isChecked()) drive();
    });
}

bool DrivePanel::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
    const auto buttons = sources_->buttons();
    const auto at = buttons.indexOf(qobject_cast<QAbstractButton*>(watched));
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (at < 0) return false;
    if (key == Qt::Key_Return || key == Qt::Key_Enter) {
        buttons[at]->click();
        return true;
    }
    const int step = key == Qt::Key_Right || key == Qt::Key_Down ? 1
                     : key == Qt::Key_Left || key == Qt::Key_Up  ? -1
                                                                 : 0;
    if (step == 0) return false;
    const auto to = at + step;
    if (to >= 0 && to < buttons.size() && buttons[to]->isEnabled()) buttons[to]->setFocus(Qt::TabFocusReason);
    return true;
}

void DrivePanel::begin() {
    const auto open = controller_.open();
    const bool live = controller_.activity() == Activity::Live;
    setEnabled(live);
    finger_->setEnabled(live && open && !open->streams.empty());
    finger_->setToolTip(open && open->streams.empty()
                            ? tr("No fingertip is open.")
                            : tr("R and P come from what the fingertip feels; without contact no train is sent."));
    asked_.reset();
    last_ = DriveSource::Off;
    off_->setChecked(true);
    // With another bench everything starts anew: the values set by hand belonged to the previous bench.
    if (const auto bench = controller_.tap(); bench != bench_.lock() || !bench) {
        bench_ = bench;
        was_.reset();
        controller_.setHand({});
    }
    showHand();
}

void DrivePanel::showHand() {
    for (const auto* index : {&roughness_, &pressure_})
        if (const double hand = controller_.hand().*index->its; index->box->value() != hand) showIndex(*index, hand);
}

/// Shows the index without sending a command to the bench.
void DrivePanel::showIndex(const Index& index, double value) {
    const QSignalBlocker quietSlider(index.slider), quietBox(index.box);
    index.slider->setValue(int(std::lround(value * kSteps)));
    index.box->setValue(value);
}

DriveSource DrivePanel::chosen() const {
    return byHand_->isChecked() ? DriveSource::Manual : finger_->isChecked() ? DriveSource::Sensor : DriveSource::Off;
}

/// "By hand" begins with the last values set by hand. If a train from the fingertip is being delivered now, it
/// continues with that train instead, so that the output does not jump.
void DrivePanel::choose() {
    const auto now = controller_.telemetry();
    const bool delivers = now.state == InterlockState::Armed || now.state == InterlockState::Delivering;
    const bool wasFinger = last_ == DriveSource::Sensor;  // the last source asked for, if the bench has not answered
    const bool takesOver =
        wasFinger && now.driving == DriveSource::Sensor && delivers && !now.paused && std::isfinite(now.amplitude_v);
    if (byHand_->isChecked() && now.driving != DriveSource::Manual && !takesOver) showHand();
    drive();
}

void DrivePanel::drive() {
    asked_ = last_ = chosen();
    askedAt_.start();
    controller_.drive(*asked_, roughness_.box->value(), pressure_.box->value());
}

void DrivePanel::follow(DriveSource driving) {
    if (asked_) {
        if (*asked_ != driving && askedAt_.elapsed() < kAnswerWithin_ms) return;
        asked_.reset();
    }
    last_ = driving;
    if (driving == chosen()) return;
    // setChecked() emits no click, so no command is sent to the bench.
    (driving == DriveSource::Manual ? byHand_ : driving == DriveSource::Sensor ? finger_ : off_)->setChecked(true);
}

QString DrivePanel::outputText(const Telemetry& telemetry) const {
    if (chosen() == DriveSource::Off || !std::isfinite(telemetry.amplitude_v)) return tr("Off");
    return trainText(telemetry.amplitude_v, telemetry.interval_s);
}

QString DrivePanel::trainText(double amplitude_v, double interval_s) const {
    const auto every = quantityText(interval_s, "s", 3);
    if (vibrates()) {
        const double share = Encoder(controller_.profile().encoding).massagerIntensity(Volts(amplitude_v));
        return tr("%1 of the strength every %2").arg(quantityText(100 * share, "%", 2), every);
    }
    return tr("%1 every %2").arg(quantityText(amplitude_v, "V", 3), every);
}

/// Says what a click on "By hand" would ask for.
QString DrivePanel::offWords() const {
    const auto nothing = was_ ? wasWords() : tr("Nothing drives the output.");
    if (controller_.activity() != Activity::Live) return nothing;
    const auto first = wouldByHand(controller_);
    if (!first) return nothing;
    return tr("%1 By hand asks for %2.").arg(nothing, trainText(first->amplitude.value(), first->interval.count()));
}

/// Returns, for example, "Was by hand, R 0.40, P 0.60."
QString DrivePanel::wasWords() const {
    const auto who = was_->source == DriveSource::Sensor ? tr("Was the fingertip") : tr("Was by hand");
    if (!std::isfinite(was_->roughness) || !std::isfinite(was_->pressure)) return who + '.';
    return tr("%1, R %2, P %3.").arg(who, decimalText(was_->roughness, 2), decimalText(was_->pressure, 2));
}

bool DrivePanel::vibrates() const {
    const auto open = controller_.open();
    return open && !open->source;
}

QString DrivePanel::words(const Telemetry& telemetry) const {
    const auto state = telemetry.state;
    if (controller_.activity() == Activity::Running)
        return tr("A protocol has the bench and drives the output itself.");
    if (off_->isChecked()) return offWords();
    if (state == InterlockState::Faulted) return tr("Nothing is delivered: there is a fault.");
    const bool armed = state == InterlockState::Armed || state == InterlockState::Delivering;
    if (state == InterlockState::Paused || (armed && telemetry.paused))
        return tr("Paused: nothing is delivered until resumed.");
    if (!armed) {
        const auto first = byHand_->isChecked() ? wouldByHand(controller_) : std::nullopt;
        return first ? tr("By hand asks for %1 once the output is armed.")
                           .arg(trainText(first->amplitude.value(), first->interval.count()))
                     : tr("Nothing is delivered until the output is armed.");
    }
    if (std::isfinite(telemetry.amplitude_v) && vibrates())
        return tr("The massager vibrates; nothing of it is read back.");
    if (std::isfinite(telemetry.amplitude_v)) {
        const double amps = telemetry.amplitude_v / telemetry.impedance_ohm;
        return std::isfinite(amps)
                   ? tr("%1 at %2, measured")
                         .arg(quantityText(amps, "A", 3), quantityText(telemetry.impedance_ohm, "ohm", 3))
                   : tr("The current is not known: no impedance was measured.");
    }
    if (finger_->isChecked() && telemetry.sensorFinished) return tr("The recording has ended: no train is sent.");
    if (finger_->isChecked() && telemetry.finger == FingerStanding::Stale)
        return tr("The fingertip’s samples are old: no train is sent.");
    if (finger_->isChecked() && telemetry.finger == FingerStanding::Implausible)
        return tr("The fingertip gives no readings: no train is sent.");
    if (finger_->isChecked() && !telemetry.contact) return tr("The fingertip touches nothing: no train is sent.");
    if (finger_->isChecked()) return tr("The fingertip gives no roughness: no train is sent.");
    return tr("No train is due.");
}

/// While the fingertip drives, the sliders show its values and cannot be moved; while nothing drives, they show the
/// values with which "By hand" would begin.
void DrivePanel::followFinger(const Telemetry& telemetry) {
    const bool finger = finger_->isChecked() && controller_.activity() == Activity::Live;
    for (const auto& [index, value] : {std::pair(&roughness_, telemetry.roughness), {&pressure_, telemetry.pressure}}) {
        index->slider->setEnabled(!finger);
        index->box->setEnabled(!finger);
        if (finger && std::isfinite(value)) showIndex(*index, value);
    }
    if (off_->isChecked()) showHand();
}

void DrivePanel::refresh(const Telemetry& telemetry) {
    if (controller_.activity() == Activity::Live) {
        follow(telemetry.driving);
        const auto now = orderedByHand(controller_, telemetry)
                             .value_or(DriveCommand{telemetry.driving, telemetry.roughness, telemetry.pressure});
        const bool known = std::isfinite(now.roughness) && std::isfinite(now.pressure);
        const bool another = !was_ || was_->source != telemetry.driving;
        if (telemetry.driving != DriveSource::Off && (known || another)) was_ = now;  // what is still known of it
    }
    followFinger(telemetry);
    const auto output = outputText(telemetry);
    if (output_->text() != output) output_->setText(output);
    const auto text = words(telemetry);
    if (says_->text() != text) says_->setText(text);
}

}  // namespace tacto::gui

#include "moc_DrivePanel.cpp"
