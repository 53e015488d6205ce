#include "app/gui/window/SafetyBar.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "app/gui/look/ConfirmButton.h"
#include "app/gui/look/ElidedLabel.h"
#include "app/gui/look/Look.h"
#include "app/gui/window/LimitBarRow.h"
#include "app/gui/window/StateBlock.h"
#include "app/gui/window/StopButton.h"
#include "core/safety/TrainCheck.h"

namespace tacto::gui {

namespace {

constexpr int kFlashFrames = 4;
constexpr int kBarGap = 16;
constexpr const char* kFactsWidth = "calibrated 12 d ago, until";
constexpr const char* kActions[] = {QT_TRANSLATE_NOOP("SafetyBar", "&Arm…"), QT_TRANSLATE_NOOP("SafetyBar", "Dis&arm"),
                                    QT_TRANSLATE_NOOP("SafetyBar", "&Reset fault")};

struct Bar {
    const char* title;
    std::vector<Quantity> quantities;  ///< none: the measured net charge
};
using Q = Quantity;
const std::vector<Bar>& allBars() {
    static const std::vector<Bar> bars{
        {QT_TRANSLATE_NOOP("SafetyBar", "Peak"), {Q::CommandVoltage, Q::PeakVoltage, Q::PeakCurrent}},
        {QT_TRANSLATE_NOOP("SafetyBar", "5 s RMS"), {Q::RmsCurrent5s, Q::RmsVoltage5s}},
        {QT_TRANSLATE_NOOP("SafetyBar", "Energy"), {Q::PulseEnergy}},
        {QT_TRANSLATE_NOOP("SafetyBar", "Density"), {Q::PowerDensity, Q::CurrentDensity}},
        {QT_TRANSLATE_NOOP("SafetyBar", "Net charge"), {}},  // measured, not predicted: see netCharge()
        {QT_TRANSLATE_NOOP("SafetyBar", "In train"), {Q::RmsCurrentTrain}},
        {QT_TRANSLATE_NOOP("SafetyBar", "1 s RMS"), {Q::RmsCurrent1s}},
    };
    return bars;
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

/// The sentence under the state's word.
QString reasonOf(const Telemetry& telemetry) {
    const auto reason = QString::fromUtf8(telemetry.reason.c_str());
    switch (telemetry.state) {
        case InterlockState::Disconnected:
            return SafetyBar::tr("No stimulator is open.");
        case InterlockState::Faulted:
            return SafetyBar::tr("%1. Output is off.").arg(reason);
        case InterlockState::Armed:
            return telemetry.driving == DriveSource::Off ? SafetyBar::tr("Choose a drive to deliver.") : reason;
        default:
            return reason;
    }
}

}  // namespace

SafetyBar::SafetyBar(BenchDesk& desk, const CalibrationBook& calibrations, QWidget* parent)
    : QFrame(parent), desk_(desk), calibrations_(calibrations), block_(new StateBlock(this)) {
    setObjectName("safetyBar");
    setAccessibleName(tr("Safety bar"));
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(kBarGap);
    row->setSizeConstraint(QLayout::SetNoConstraint);  // minimumSizeHint() says how narrow it may be
    facts_ = buildFacts();
    QStringList titles;
    for (const auto& bar : allBars()) titles << tr(bar.title);
    bars_ = new LimitBarRow(titles, this);
    buttons_ = buildButtons();
    stop_ = new StopButton([this] { desk_.stop("operator (STOP)"); }, this);
    stop_->setToolTip(tr("Output off, now. Esc and Pause do the same from anywhere, Space outside text fields."));
    row->addWidget(block_);
    row->addWidget(facts_);
    row->addWidget(bars_, 1);
    row->addWidget(buttons_);
    row->addWidget(stop_);
    refresh(Telemetry{});
}

QWidget* SafetyBar::buildFacts() {
    auto* holder = new QWidget(this);
    auto* column = new QVBoxLayout(holder);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    load_ = new ElidedLabel(holder);
    auto bold = load_->font();
    bold.setBold(true);
    load_->setFont(bold);
    load_->setToolTip(
        tr("Impedance of the electrodes as last measured, and how long ago. Older than 5 s, it is "
           "measured again before the next train."));
    device_ = new ElidedLabel(holder);
    calibration_ = new ElidedLabel(holder);
    calibration_->setObjectName("calibrationAge");
    column->addStretch();
    for (auto* label : {load_, device_, calibration_}) column->addWidget(label);
    column->addStretch();
    return holder;
}

QWidget* SafetyBar::buildButtons() {
    auto* holder = new QWidget(this);
    auto* column = new QVBoxLayout(holder);
    column->setContentsMargins(0, 4, 0, 4);
    column->setSpacing(4);
    action_ = new ConfirmButton({}, holder);
    action_->setObjectName("armButton");
    connect(action_, &QPushButton::clicked, this, &SafetyBar::pressAction);
    pause_ = new ConfirmButton({}, holder);
    pause_->setToolTip(tr(
        "Holds the output back and keeps the run. A train that is under way ends by itself, within 2 s; no other one "
        "is delivered until you resume. STOP ends it at once."));
    connect(pause_, &QPushButton::clicked, this, &SafetyBar::pressPause);
    for (auto* button : {action_, pause_}) column->addWidget(button);
    return holder;
}

/// The buttons' words change with the state: the widest of them sets the width, so that nothing moves.
void SafetyBar::giveRoom() {
    const auto metrics = fontMetrics();
    int widest = 0;
    for (const auto* words : kActions) widest = std::max(widest, metrics.horizontalAdvance(tr(words).remove('&')));
    buttons_->setFixedWidth(widest + 3 * kBarGap);
    const int always = buttons_->width() + stop_->sizeHint().width() + 4 * kBarGap;
    const int facts = metrics.horizontalAdvance(tr(kFactsWidth));
    const int aBar = metrics.horizontalAdvance("88.8 of 188 mA/cm²");
    block_->fit(width() - always - facts - aBar);
    facts_->setFixedWidth(std::clamp(width() - always - block_->width() - aBar, 0, facts));
}

QSize SafetyBar::minimumSizeHint() const {
    return {block_->smallestWidth() + buttons_->minimumWidth() + stop_->sizeHint().width() + 4 * kBarGap,
            QFrame::minimumSizeHint().height()};
}

void SafetyBar::changeEvent(QEvent* event) {
    if (event->type() == QEvent::FontChange && stop_ != nullptr) giveRoom();
    QFrame::changeEvent(event);
}

void SafetyBar::resizeEvent(QResizeEvent* event) {
    giveRoom();
    QFrame::resizeEvent(event);
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
    block_->show(telemetry.state, reasonOf(telemetry), pulse_ > 0);
    if (pulse_ > 0) --pulse_;
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
    const auto text = open->simulated() ? tr("%1 · simulated").arg(name) : name;
    device_->setText(text);
    device_->setToolTip(text);
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
        calibration_->setToolTip(
            standing ? text + ". " + standingTip(*standing)
                     : tr("Calibration of the stimulator. Without a valid one it is for bench loads only."));
    }
    // As a sheet: a label's own palette is lost when the theme's sheet changes.
    const auto sheet = QString("QLabel { color: %1; }").arg((counts ? colours().text : colours().amberText).name());
    if (calibration_->styleSheet() != sheet) calibration_->setStyleSheet(sheet);
}

void SafetyBar::showExposure(const Telemetry& telemetry) {
    for (std::size_t i = 0; i < allBars().size(); ++i) {
        const auto& quantities = allBars()[i].quantities;
        std::optional<ExposureRow> row = quantities.empty() ? netCharge(telemetry) : std::nullopt;
        for (const auto quantity : quantities) {
            auto candidate = tightest(telemetry.exposure(), {quantity});
            if (!candidate) continue;
            const auto share = [](const ExposureRow& r) {
                return std::isnan(r.limit) ? -1 : r.evaluated ? r.value / r.limit : 1e9;
            };
            if (!row || share(*candidate) > share(*row)) row = candidate;
        }
        bars_->show(i, row);
    }
    bars_->arrange();
}

void SafetyBar::showButtons(InterlockState state) {
    const bool live = desk_.activity() == Activity::Live;
    const bool on = state == InterlockState::Armed || state == InterlockState::Delivering ||
                    state == InterlockState::Paused || state == InterlockState::Checking;
    if (state == InterlockState::Faulted) {
        action_->setMeaning(tr(kActions[2]), true);
        action_->setToolTip(
            tr("Asks the devices again; one that was unplugged is looked for. When the cause is gone the bench is "
               "disarmed, not armed."));
    } else if (on) {
        action_->setMeaning(tr(kActions[1]), false);
        action_->setToolTip(tr("Ends the output and goes back to disarmed."));
    } else {
        action_->setMeaning(tr(kActions[0]), false);
        action_->setToolTip(tr("First of two steps. Nothing is delivered before the second."));
    }
    action_->setEnabled(live && state != InterlockState::Disconnected);
    const bool paused = state == InterlockState::Paused;
    pause_->setMeaning(paused ? tr("Res&ume") : tr("&Pause"), paused);
    pause_->setEnabled(state == InterlockState::Delivering || state == InterlockState::Paused);
}

void SafetyBar::pressAction() {
    if (!action_->listens()) return;
    if (state_ == InterlockState::Faulted)
        desk_.resetFault();
    else if (state_ == InterlockState::Disarmed)
        emit armRequested();
    else
        desk_.disarm();
}

void SafetyBar::pressPause() {
    if (!pause_->listens()) return;
    if (state_ == InterlockState::Paused)
        desk_.resume();
    else
        desk_.pause();
}

}  // namespace tacto::gui
