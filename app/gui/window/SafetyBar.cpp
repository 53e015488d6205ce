#include "app/gui/window/SafetyBar.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"
#include "core/safety/TrainCheck.h"

namespace tacto::gui {

namespace {

constexpr int kFlashFrames = 4;

QLabel* quietLabel(QWidget* parent) {
    auto* label = new QLabel("–", parent);
    auto font = label->font();
    font.setPointSizeF(font.pointSizeF() * 0.9);
    label->setFont(font);
    label->setMinimumWidth(1);
    return label;
}

/// The last pulse's measured net charge against what a person may receive. On bench loads it is only shown: amber
/// above the limit, red from ten times it (safety.md H5).
std::optional<ExposureRow> netCharge(const Telemetry& telemetry) {
    if (telemetry.trainsDelivered == 0) return std::nullopt;
    const auto present = [](double value) { return std::isnan(value) ? std::nullopt : std::optional(value); };
    const auto balance = chargeBalance(present(telemetry.imbalance), present(telemetry.imbalanceUncertainty));
    ExposureRow row;
    row.quantity = Quantity::NetCharge;
    row.unit = "%";
    row.value = telemetry.imbalance * 100;
    row.limit = kNetChargeLimit * 100;
    row.set = "a person";
    row.action = balance == ChargeBalance::Red ? LimitAction::Refuse : LimitAction::Warn;
    row.evaluated = balance != ChargeBalance::NotEvaluated;
    row.within = balance == ChargeBalance::Green;
    if (!row.evaluated) row.reason = "The read-back does not tell it to 0.5 % of the phase charge.";
    return row;
}

}  // namespace

SafetyBar::SafetyBar(BenchDesk& desk, const CalibrationBook& calibrations, QWidget* parent)
    : QFrame(parent), desk_(desk), calibrations_(calibrations) {
    setObjectName("safetyBar");
    setAccessibleName(tr("Safety bar"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(6, 6, 6, 6);
    row->setSpacing(8);

    shape_ = new QLabel(this);
    word_ = new QLabel(this);
    word_->setObjectName("interlockState");
    for (auto* label : {shape_, word_}) {
        auto font = label->font();
        font.setPointSizeF(font.pointSizeF() * 1.5);
        font.setBold(true);
        label->setFont(font);
    }
    shape_->setFixedWidth(shape_->fontMetrics().horizontalAdvance("●◌"));
    shape_->setAlignment(Qt::AlignCenter);
    word_->setMinimumWidth(word_->fontMetrics().horizontalAdvance("DISCONNECTED"));
    reason_ = quietLabel(this);
    auto* state = new QGridLayout;
    state->setHorizontalSpacing(4);
    state->setVerticalSpacing(0);
    state->addWidget(shape_, 0, 0, 2, 1);
    state->addWidget(word_, 0, 1);
    state->addWidget(reason_, 1, 1);
    row->addLayout(state);

    device_ = quietLabel(this);
    load_ = quietLabel(this);
    calibration_ = quietLabel(this);
    calibration_->setObjectName("calibrationAge");
    load_->setToolTip(
        tr("Impedance of the electrodes as last measured, and how long ago. Older than 5 s, it is "
           "measured again before the next train."));
    auto* facts = new QVBoxLayout;
    facts->setSpacing(0);
    for (auto* label : {device_, load_, calibration_}) facts->addWidget(label);
    row->addLayout(facts);
    row->addStretch(1);

    using Q = Quantity;
    const std::pair<QString, std::vector<Quantity>> wanted[] = {
        {tr("Peak"), {Q::CommandVoltage, Q::PeakVoltage, Q::PeakCurrent}},
        {tr("5 s RMS"), {Q::RmsCurrent5s, Q::RmsVoltage5s}},
        {tr("Energy"), {Q::PulseEnergy}},
        {tr("Density"), {Q::PowerDensity, Q::CurrentDensity}},
        {tr("Net charge"), {}},  // measured, not predicted: see netCharge()
        {tr("In train"), {Q::RmsCurrentTrain}},
        {tr("1 s RMS"), {Q::RmsCurrent1s}},
    };
    for (const auto& [title, quantities] : wanted) {
        auto* bar = new LimitBar(title, this);
        bars_.push_back({bar, quantities});
        row->addWidget(bar, 2);
    }

    action_ = new QPushButton(tr("&Arm…"), this);
    action_->setObjectName("armButton");
    connect(action_, &QPushButton::clicked, this, &SafetyBar::pressAction);
    pause_ = new QPushButton(tr("&Pause"), this);
    pause_->setToolTip(tr("Holds the output back and keeps the run: no train is delivered until you resume."));
    connect(pause_, &QPushButton::clicked, this, [this] {
        if (state_ == InterlockState::Paused)
            desk_.resume();
        else
            desk_.pause();
    });
    auto* buttons = new QVBoxLayout;
    buttons->setSpacing(4);
    buttons->addWidget(action_);
    buttons->addWidget(pause_);
    row->addLayout(buttons);

    stop_ = new QPushButton(tr("STOP"), this);
    stop_->setObjectName("stopButton");
    stop_->setAccessibleName(tr("STOP"));
    stop_->setToolTip(tr("Output off, now. Esc and Pause do the same from anywhere, Space outside text fields."));
    // Stops when it goes down: nobody waits for the finger to come up again.
    connect(stop_, &QPushButton::pressed, this, [this] { desk_.stop("operator (STOP)"); });
    auto font = stop_->font();
    font.setPointSizeF(font.pointSizeF() * 1.7);
    font.setBold(true);
    stop_->setFont(font);
    stop_->setMinimumWidth(stop_->fontMetrics().horizontalAdvance("  STOP  ") + 24);
    stop_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
    row->addWidget(stop_);
    for (auto* button : {action_, pause_, stop_}) button->setAutoDefault(false);
    colourStop();
    refresh(Telemetry{});
}

void SafetyBar::colourStop() {
    const auto& c = colours();
    // White on the light theme's red is 6:1; black on the dark theme's lighter one 7:1.
    const QColor ink = currentTheme() == Theme::Dark ? QColor(Qt::black) : QColor(Qt::white);
    stop_->setStyleSheet(QString("QPushButton#stopButton { background: %1; color: %2; border: 2px solid %1; "
                                 "border-radius: 6px; padding: 2px 10px; } "
                                 "QPushButton#stopButton:focus { border-color: %3; }")
                             .arg(c.fault.name(), ink.name(), c.text.name()));
}

void SafetyBar::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange && stop_ != nullptr) colourStop();
    QFrame::changeEvent(event);
}

void SafetyBar::refresh(const Telemetry& telemetry) {
    showState(telemetry);
    showDevice(telemetry);
    showExposure(telemetry);
    showButtons(telemetry.state);
}

void SafetyBar::showState(const Telemetry& telemetry) {
    state_ = telemetry.state;
    if (telemetry.trainsDelivered > trainsSeen_) pulse_ = kFlashFrames;
    trainsSeen_ = telemetry.trainsDelivered;
    const auto look = stateLook(telemetry.state);
    const bool lit = pulse_ > 0;
    if (pulse_ > 0) --pulse_;
    shape_->setText(telemetry.state == InterlockState::Delivering && !lit ? "○" : look.shape);
    word_->setText(look.word);
    word_->setAccessibleDescription(look.word);
    auto colour = palette();
    colour.setColor(QPalette::WindowText, look.colour);
    shape_->setPalette(colour);
    word_->setPalette(colour);
    auto reason = QString::fromUtf8(telemetry.reason.c_str());
    if (telemetry.state == InterlockState::Faulted) reason = tr("%1. Output is off.").arg(reason);
    if (telemetry.state == InterlockState::Disconnected) reason = tr("no stimulator is open");
    reason_->setToolTip(reason);
    reason_->setText(reason_->fontMetrics().elidedText(reason.isEmpty() ? QString(" ") : reason, Qt::ElideRight,
                                                       std::max(word_->width(), 180)));
}

void SafetyBar::showDevice(const Telemetry& telemetry) {
    const auto open = desk_.open();
    if (!open) {
        device_->setText(desk_.activity() == Activity::Opening ? tr("opening…") : tr("no bench is open"));
        load_->setText("–");
        showCalibration();
        return;
    }
    QString name = tr("no stimulator");
    for (const auto& device : open->about.devices) {
        if (device.role == "stimulator" || (device.role == "massager" && !open->source))
            name = QString::fromStdString(device.name);
    }
    device_->setText(open->simulated() ? tr("%1 · simulated").arg(name) : name);
    load_->setText(
        std::isfinite(telemetry.impedance_ohm)
            ? QString("%1 · %2").arg(quantityText(telemetry.impedance_ohm, "ohm", 3), ageText(telemetry.impedanceAge_s))
            : tr("impedance not measured"));
    showCalibration();
}

/// Amber where it does not count: a person may not be connected to what was never measured.
void SafetyBar::showCalibration() {
    const auto stimulator = calibrations_.connected();
    const auto standing = stimulator ? std::optional(calibrations_.standing(*stimulator)) : std::nullopt;
    const bool counts = !standing || standing->state == CalibrationState::Valid;
    auto text = standing ? standingText(*standing) : QString("–");
    if (!counts) text = "⚠ " + text;
    if (calibration_->text() != text) {
        calibration_->setText(text);
        calibration_->setToolTip(standing
                                     ? standingTip(*standing)
                                     : tr("Calibration of the stimulator. Without a valid one it is for bench loads "
                                          "only."));
    }
    // As a sheet: a label's own palette is lost when the theme's sheet changes.
    const auto sheet = QString("QLabel { color: %1; }").arg((counts ? colours().text : colours().amber).name());
    if (calibration_->styleSheet() != sheet) calibration_->setStyleSheet(sheet);
}

void SafetyBar::showExposure(const Telemetry& telemetry) {
    for (const auto& shown : bars_) {
        std::optional<ExposureRow> row = shown.quantities.empty() ? netCharge(telemetry) : std::nullopt;
        for (const auto quantity : shown.quantities) {
            auto candidate = tightest(telemetry.exposure(), {quantity});
            if (!candidate) continue;
            const auto share = [](const ExposureRow& r) {
                return std::isnan(r.limit) ? -1 : r.evaluated ? r.value / r.limit : 1e9;
            };
            if (!row || share(*candidate) > share(*row)) row = candidate;
        }
        shown.bar->show(row);
    }
}

void SafetyBar::showButtons(InterlockState state) {
    const bool live = desk_.activity() == Activity::Live;
    const bool on = state == InterlockState::Armed || state == InterlockState::Delivering ||
                    state == InterlockState::Paused || state == InterlockState::Checking;
    if (state == InterlockState::Faulted) {
        action_->setText(tr("&Reset fault"));
        action_->setToolTip(
            tr("Asks the devices again; one that was unplugged is looked for. When the cause is gone the bench is "
               "disarmed, not armed."));
    } else if (on) {
        action_->setText(tr("Dis&arm"));
        action_->setToolTip(tr("Ends the output and goes back to disarmed."));
    } else {
        action_->setText(tr("&Arm…"));
        action_->setToolTip(tr("First of two steps. Nothing is delivered before the second."));
    }
    action_->setEnabled(live && state != InterlockState::Disconnected);
    pause_->setText(state == InterlockState::Paused ? tr("Res&ume") : tr("&Pause"));
    pause_->setEnabled(state == InterlockState::Delivering || state == InterlockState::Paused);
}

void SafetyBar::pressAction() {
    if (state_ == InterlockState::Faulted)
        desk_.resetFault();
    else if (state_ == InterlockState::Disarmed)
        emit armRequested();
    else
        desk_.disarm();
}

}  // namespace tacto::gui
