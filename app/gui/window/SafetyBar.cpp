#include "app/gui/window/SafetyBar.h"

#include <algorithm>

#include "app/gui/controller/FirstOutput.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/FaultBanner.h"
#include "app/gui/window/LimitBar.h"
#include "app/gui/window/StateBlock.h"
#include "app/gui/window/StateWords.h"
#include "app/gui/window/StopButton.h"
#include "core/safety/TrainCheck.h"
#include "core/safety/TrainExposure.h"

namespace tacto::gui {

namespace {

constexpr int kFlashFrames = 4;
constexpr int kBarGap = 16;
constexpr const char* kFactsWidth = "calibrated until 2030-12-30";
constexpr const char* kUnmeasured = QT_TRANSLATE_NOOP("SafetyBar", "Impedance not measured");
constexpr const char* kActions[] = {QT_TRANSLATE_NOOP("SafetyBar", "&Arm…"), QT_TRANSLATE_NOOP("SafetyBar", "Dis&arm"),
                                    QT_TRANSLATE_NOOP("SafetyBar", "&Reset")};

struct Bar {
    const char* title;
    std::vector<Quantity> quantities;  ///< empty: the measured net charge
};
using Q = Quantity;
const std::vector<Bar>& allBars() {
    static const std::vector<Bar> bars{
        {QT_TRANSLATE_NOOP("SafetyBar", "Peak"), {Q::CommandVoltage, Q::PeakVoltage, Q::PeakCurrent}},
        {QT_TRANSLATE_NOOP("SafetyBar", "RMS over 5 s"), {Q::RmsCurrent5s, Q::RmsVoltage5s}},
        {QT_TRANSLATE_NOOP("SafetyBar", "Energy a pulse"), {Q::PulseEnergy}},
        {QT_TRANSLATE_NOOP("SafetyBar", "Density"), {Q::PowerDensity, Q::CurrentDensity}},
        {QT_TRANSLATE_NOOP("SafetyBar", "Net charge"), {}},  // measured, not predicted: see netCharge()
        {QT_TRANSLATE_NOOP("SafetyBar", "In train"), {Q::RmsCurrentTrain}},
        {QT_TRANSLATE_NOOP("SafetyBar", "RMS over 1 s"), {Q::RmsCurrent1s}},
    };
    return bars;
}

/// Compares the last pulse's measured net charge with the limit for a person. On bench loads it is for information:
/// amber above the limit, red from ten times the limit (safety.md H5).
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

SafetyBar::SafetyBar(BenchController& controller, const CalibrationBook& calibrations, QWidget* parent)
    : QFrame(parent), controller_(controller), calibrations_(calibrations), block_(new StateBlock(this)) {
    nameWidget(*this, "safetyBar", tr("Safety bar"));
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    auto* row = rowIn(*this, 0);
    row->setSizeConstraint(QLayout::SetNoConstraint);  // minimumSizeHint() gives the smallest width
    facts_ = buildFacts();
    QStringList titles;
    for (const auto& bar : allBars()) titles << tr(bar.title);
    bars_ = new LimitBarRow(titles, this);
    buttons_ = buildButtons();
    stop_ = new StopButton([this] { controller_.stop("operator (STOP)"); }, this);
    setPauseInstead({});
    fault_ = new FaultBanner(this);
    fault_->hide();
    addAll(*row, {block_, facts_});
    row->addWidget(bars_, 1);
    blindFacts_ = buildBlindFacts();
    row->addWidget(blindFacts_, 1);
    row->addWidget(fault_, 1);
    addAll(*row, {buttons_, stop_});
    refresh(Telemetry{});
    onEvent(*this, QEvent::Resize, [this] { giveRoom(); });
}

QWidget* SafetyBar::buildFacts() {
    auto* holder = new QWidget(this);
    auto* column = columnIn(*holder, 0, {kBarGap, 0, kBarGap, 0});
    load_ = new ElidedLabel(holder);
    device_ = new ElidedLabel(holder);
    calibration_ = makeLabel<ElidedLabel>({}, {.name = "calibrationAge"}, holder);
    load_->setObjectName("impedance");
    for (auto* label : {load_, device_, calibration_}) setTextSize(*label, TextSize::Small, label == load_);
    column->addStretch();
    for (auto* label : {load_, device_, calibration_}) column->addWidget(label);
    column->addStretch();
    return holder;
}

QWidget* SafetyBar::buildBlindFacts() {
    auto* holder = new QWidget(this);
    auto* row = rowIn(*holder, kBarGap);
    const auto pair = [&](QLabel*& strong, const QString& quiet) {
        auto* column = new QVBoxLayout;
        column->setSpacing(0);
        strong = makeLabel<ElidedLabel>({}, {.size = TextSize::Body, .strong = true}, holder);
        auto* below = makeLabel<ElidedLabel>(quiet, {.tone = Tone::Quiet, .size = TextSize::Small}, holder);
        column->addStretch();
        addAll(*column, {strong, below});
        column->addStretch();
        row->addLayout(column, 1);
    };
    pair(within_, tr("numbers hidden, the session is blind"));
    pair(participantsStop_, tr("their third stop ends the session"));
    within_->setObjectName("exposureWithin");
    holder->hide();
    return holder;
}

void SafetyBar::setBlind(bool blind) {
    blind_ = blind;
    fault_->setBlind(blind);
    pulse_ = 0;
    giveRoom();
}

void SafetyBar::addToStopTip(const QString& sentence) {
    moreOfStop_ = ' ' + sentence;
    stop_->setToolTip(stop_->toolTip() + moreOfStop_);
}

void SafetyBar::setPauseInstead(std::optional<PauseInstead> instead) {
    pauseInstead_ = std::move(instead);
    stop_->setToolTip(
        (pauseInstead_
             ? tr("The operator’s: output off, now, and the session is interrupted; it can go on within 2 h. Esc and "
                  "Pause do the same while this window has the keys; in the participant’s window they are the "
                  "participant’s STOP.")
             : tr("Output off, now. Esc and Pause do the same from anywhere, Space outside text fields.")) +
        moreOfStop_);
}

void SafetyBar::setParticipantsStop(const QString& words) { participantsStop_->setText(words); }

/// Says only whether a limit is exceeded, not how far.
void SafetyBar::showBlind(const Telemetry& telemetry) {
    const auto rows = telemetry.exposure();
    const auto broken = [](const ExposureRow& row) { return forbids(row); };
    within_->setText(std::ranges::any_of(rows, broken) ? tr("⚠ Exposure at its limit")
                                                       : tr("✔ Exposure within limits"));
}

QWidget* SafetyBar::buildButtons() {
    auto* holder = new QWidget(this);
    auto* column = columnIn(*holder, 4, {kBarGap / 2, 0, kBarGap / 2, 0});
    action_ = new ConfirmButton({}, holder);
    action_->setObjectName("armButton");
    connect(action_, &QPushButton::clicked, this, &SafetyBar::pressAction);
    pause_ = new ConfirmButton({}, holder);
    pause_->setObjectName("pauseButton");
    pause_->setToolTip(
        tr("Pauses the output but not the run; a protocol waits at its next step. The current train finishes within "
           "2 s; no other train is delivered until you resume. STOP ends a train at once."));
    connect(pause_, &QPushButton::clicked, this, &SafetyBar::pressPause);
    details_ = pageButton(tr("Details…"), {}, tr("All messages since the program began."), holder);
    connect(details_, &QPushButton::clicked, this, &SafetyBar::detailsRequested);
    details_->hide();
    column->addStretch();
    for (auto* button : {static_cast<QPushButton*>(action_), static_cast<QPushButton*>(pause_), details_})
        column->addWidget(button);
    column->addStretch();
    return holder;
}

/// Buttons have the width of their widest word, so that nothing moves when the words change. In a narrow bar the limit
/// bars go first, then the facts, and last the state's word shrinks; a word above 28 pt leaves room for the nearest
/// limit.
void SafetyBar::giveRoom() {
    const auto metrics = fontMetrics();
    int widest = 0;
    for (const auto* words : kActions) widest = std::max(widest, metrics.horizontalAdvance(tr(words).remove('&')));
    widest = std::max(widest, metrics.horizontalAdvance(details_->text()));
    buttons_->setFixedWidth(widest + 3 * kBarGap);
    const int always = buttons_->width() + stop_->sizeHint().width();
    const int calibrated = QFontMetrics(textFont(TextSize::Small)).horizontalAdvance(tr(kFactsWidth));
    const int unmeasured = QFontMetrics(textFont(TextSize::Small, QFont::Bold)).horizontalAdvance(tr(kUnmeasured));
    const int facts = std::max(calibrated, unmeasured) + 2 * kBarGap;
    // While the operator is blind no bar is shown, so no room is kept.
    const int beside = width() - always, forBar = blind_ ? 0 : bars_->oneBarWidth() + kBarGap;
    block_->fit(std::max(beside - forBar, std::min(beside, block_->legibleWidth())));
    const int left = beside - block_->width();
    const bool barFirst = block_->width() > block_->legibleWidth();
    factsFit_ = left >= facts / 2 + (barFirst ? forBar : 0);  // too narrow, all texts would be cut to "…"
    facts_->setFixedWidth(std::min(left, facts));
    bars_->setContentsMargins(factsFit_ ? 0 : kBarGap, 0, 0, 0);
    facts_->setVisible(factsFit_ && state_ != InterlockState::Faulted);
}

QSize SafetyBar::minimumSizeHint() const {
    return {block_->smallestWidth() + buttons_->minimumWidth() + stop_->sizeHint().width(),
            QFrame::minimumSizeHint().height()};
}

void SafetyBar::changeEvent(QEvent* event) {
    if (event->type() == QEvent::FontChange && stop_ != nullptr) giveRoom();
    QFrame::changeEvent(event);
}

void SafetyBar::refresh(const Telemetry& telemetry) {
    followReset(telemetry);
    showState(telemetry);
    const bool faulted = telemetry.state == InterlockState::Faulted;
    facts_->setVisible(!faulted && factsFit_);
    bars_->setVisible(!faulted && !blind_);
    blindFacts_->setVisible(!faulted && blind_);
    if (blind_) showBlind(telemetry);
    fault_->refresh(telemetry);
    showDevice(telemetry);
    showExposure(telemetry);
    showButtons(telemetry);
}

void SafetyBar::followReset(const Telemetry& telemetry) {
    const bool left = state_ == InterlockState::Faulted && telemetry.state != InterlockState::Faulted;
    const bool mayArm = left && telemetry.state == InterlockState::Disarmed && resetAsked_ &&
                        !controller_.stoppedSince(*resetAsked_) && fault_->mayArmNext();
    if (left) resetAsked_.reset();
    if (mayArm) emit faultReset(drove_);
    causesShown_ = telemetry.causesCame;
    if (telemetry.state == InterlockState::Faulted) return;
    const bool byHand = telemetry.driving == DriveSource::Manual;
    drove_ =
        orderedByHand(controller_, telemetry).value_or(DriveCommand{byHand ? DriveSource::Off : telemetry.driving});
}

void SafetyBar::showState(const Telemetry& telemetry) {
    state_ = telemetry.state;
    if (telemetry.trainsDelivered > trainsSeen_ && !blind_) pulse_ = kFlashFrames;
    if (telemetry.trainsDelivered != trainsSeen_ || telemetry.driving == DriveSource::Off)
        refused_ = false;
    else if (telemetry.trainsRefused != refusalsSeen_)
        refused_ = true;
    trainsSeen_ = telemetry.trainsDelivered;
    refusalsSeen_ = telemetry.trainsRefused;
    // An empty presentation delivers nothing, but must look like any other while the operator is blind.
    const bool closed = state_ == InterlockState::Disconnected && controller_.activity() == Activity::Closed;
    const bool hidden = blind_ && (state_ == InterlockState::Delivering || state_ == InterlockState::Armed);
    // Armed but paused: no train comes either.
    const bool waits = telemetry.state == InterlockState::Armed && telemetry.paused;
    shown_ = hidden ? InterlockState::Armed : waits ? InterlockState::Paused : telemetry.state;
    if (hidden)
        block_->show(shown_, tr("The session presents and asks. Space stops."), false);
    else
        block_->show(shown_, closed ? closedWords() : stateWords(telemetry, protocol(), refused_), pulse_ > 0);
    if (pulse_ > 0) --pulse_;
}

QString SafetyBar::closedWords() const {
    return controller_.closedByRun() ? tr("Closed by a run. Ctrl+B opens a simulated one.")
                                     : tr("No bench is open. Ctrl+B opens a simulated one.");
}

/// The protocol that uses the bench; empty while a person uses it.
QString SafetyBar::protocol() const {
    const auto open = controller_.open();
    return open && controller_.activity() == Activity::Running ? procedureText(open->about.protocol) : QString();
}

void SafetyBar::showDevice(const Telemetry& telemetry) {
    const auto open = controller_.open();
    if (!open) {
        device_->setText(controller_.activity() == Activity::Opening ? tr("Opening…") : QString());
        load_->setText({});  // clear() would paint it again
        showCalibration();
        return;
    }
    auto name = tr("No stimulator");
    for (const auto& device : open->about.devices) {
        if (device.is(Role::Stimulator) || (device.is(Role::Massager) && !open->source))
            name = titled(qtext(device.name));
    }
    const auto text = open->simulated() && !name.contains(tr("simulated"), Qt::CaseInsensitive)
                          ? tr("%1 · simulated").arg(name)
                          : name;
    device_->setText(text);
    device_->setToolTip(text);
    const double age_s = noteImpedance(telemetry);
    // Hidden from a blind operator: the time of a measurement would show when a train came, its value which train.
    load_->setText(!open->source || blind_ ? QString()  // a massager has no impedance
                   : std::isfinite(measured_ohm_)
                       ? QString("%1 · %2").arg(quantityText(measured_ohm_, "ohm", 3), ageText(age_s))
                       : tr(kUnmeasured));
    load_->setToolTip(
        blind_ ? QString()
               : tr("%1\nImpedance of the electrodes as last measured, and how long ago. Older than 5 s, it is "
                    "measured again before the next train; after a stop, before the output is armed.")
                     .arg(load_->text()));
    showCalibration();
}

/// The bench forgets the impedance at each stop, so that it never arms on an old one. The measured value stays visible
/// with its age until a fault or another bench. Returns this age in seconds.
double SafetyBar::noteImpedance(const Telemetry& telemetry) {
    const auto bench = controller_.tap();
    const bool another = bench != measuredOn_.lock() || !bench;
    if (another || telemetry.state == InterlockState::Faulted) measured_ohm_ = NAN;
    measuredOn_ = bench;
    if (std::isfinite(telemetry.impedance_ohm)) {
        measured_ohm_ = telemetry.impedance_ohm;
        measuredAt_s_ = toSeconds(telemetry.at) - telemetry.impedanceAge_s;
    }
    return toSeconds(telemetry.at) - measuredAt_s_;
}

/// Amber if the calibration does not count: a person may not be connected to an uncalibrated stimulator.
void SafetyBar::showCalibration() {
    const auto stimulator = calibrations_.connected();
    const auto standing = stimulator ? std::optional(calibrations_.standing(*stimulator)) : std::nullopt;
    const bool counts = !standing || standing->state == CalibrationState::Valid;
    auto text = standing ? standingText(*standing) : QString();
    const auto whole = text;
    // If it counts, the bar shows until when; the tool tip also says how old it is.
    if (standing && counts) text = tr("calibrated until %1").arg(qtext(dateText(standing->newest->validUntil)));
    if (!counts) text = "⚠ " + text;
    if (calibration_->text() != text) {
        calibration_->setText(text);
        calibration_->setToolTip(standing ? (counts ? text + ". " : QString()) + titled(whole) + ". " +
                                                standingTip(*standing)
                                          : tr("Calibration of the stimulator. A stimulator without a valid "
                                               "calibration is for bench loads only."));
    }
    setTone(*calibration_, counts ? Tone::Text : Tone::Warning);
}

void SafetyBar::showExposure(const Telemetry& telemetry) {
    const auto rows = exposureNow(telemetry);
    const bool off = outputIsOff(telemetry.state);
    for (std::size_t i = 0; i < allBars().size(); ++i) {
        const auto& quantities = allBars()[i].quantities;
        const auto row = quantities.empty() ? netCharge(telemetry) : tightest(rows, quantities);
        bars_->show(i, row, controller_.limits().sets);
        // The measured value stays that of the last pulse.
        if (quantities.empty()) bars_->setTitle(i, off && row ? tr("Last net charge") : tr(allBars()[i].title));
        // Named after the limit shown, as in the dock: the same name always means the same limit.
        if (!quantities.empty()) bars_->setTitle(i, row ? shortRowTitle(*row) : tr(allBars()[i].title));
    }
    bars_->arrange();
}

void SafetyBar::showButtons(const Telemetry& telemetry) {
    const auto state = telemetry.state;
    const bool live = controller_.activity() == Activity::Live;
    const auto grave = telemetry.grave;
    if (state == InterlockState::Faulted) {
        action_->setMeaning(tr(kActions[2]), true);
        action_->setToolTip(
            grave ? whyNoReset(telemetry)
                  : tr("Checks the devices again and searches for an unplugged one. When the cause is gone the bench "
                       "is disarmed, and arming is asked for where nothing else must be checked first."));
    } else if (isOn(state)) {
        action_->setMeaning(tr(kActions[1]), false);
        action_->setToolTip(tr("Ends the output and disarms the bench."));
    } else {
        action_->setMeaning(tr(kActions[0]), false);
        action_->setToolTip(tr("First of two steps. Nothing is delivered before the second."));
    }
    action_->setEnabled(live && state != InterlockState::Disconnected && !grave);
    const bool runs = controller_.activity() == Activity::Running;
    paused_ = held(state);
    pause_->setMeaning(paused_ ? tr("Resume") : tr("&Pause"), paused_);
    pause_->setEnabled(pauseInstead_.has_value() || runs || state == InterlockState::Delivering || paused_);
    pause_->setVisible(state != InterlockState::Faulted);
    details_->setVisible(state == InterlockState::Faulted);
    makePrimary(*action_, state == InterlockState::Faulted && !grave);
}

bool SafetyBar::held(InterlockState state) const {
    if (pauseInstead_) return pauseInstead_->paused();
    // While trains are delivered only the state decides, which is known before the loop's next step.
    const bool mayBegin = controller_.activity() == Activity::Running || state == InterlockState::Checking ||
                          state == InterlockState::Armed;
    return state == InterlockState::Paused || (mayBegin && controller_.paused());
}

bool SafetyBar::canHold(bool hold) const { return pause_->isEnabled() && paused_ != hold; }

void SafetyBar::pressAction() {
    if (!action_->listens()) return;
    if (state_ == InterlockState::Faulted)
        resetFault();
    else if (state_ == InterlockState::Disarmed)
        emit armRequested();
    else
        controller_.disarm();
}

QString SafetyBar::whyNoReset(const Telemetry& telemetry) {
    if (!telemetry.grave) return {};
    return sentence(safetyCheckFirst("the stimulator", *telemetry.grave, telemetry.reason.view()));
}

void SafetyBar::resetFault() {
    resetAsked_ = controller_.mark();
    controller_.resetFault(causesShown_);
}

void SafetyBar::pressPause() {
    if (pause_->listens()) holdOutput(!paused_);
}

void SafetyBar::holdOutput(bool hold) {
    if (!hold) emit resumed();
    if (pauseInstead_) return pauseInstead_->pause(hold);
    if (hold)
        controller_.pause();
    else
        controller_.resume();
}

}  // namespace tacto::gui

#include "moc_SafetyBar.cpp"
