#include "app/gui/scope/panels/AcquisitionPanel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSettings>
#include <QSignalBlocker>
#include <QSpinBox>
#include <algorithm>
#include <cmath>

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/model/Viewport.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kUsualSamples = 20'000;  ///< samples per record that Auto aims at for a short record
constexpr double kUsualRate_hz = 500e3;   ///< sample rate for a long record: 100 samples in a phase of 200 µs
constexpr double kLowestRate_hz = 1000;
constexpr double kLowestLevel = 1e-6;
constexpr double kMaxVolts = 200;
constexpr double kMaxAmps = 0.5;
constexpr double kLowestListed_hz = 10e3;

void choose(QComboBox* combo, double value) {
    for (int i = 0; i < combo->count(); ++i) {
        const double its = combo->itemData(i).toDouble();
        if (std::abs(its - value) <= 1e-9 * std::abs(value)) return combo->setCurrentIndex(i);
    }
}

}  // namespace

AcquisitionPanel::AcquisitionPanel(QWidget* parent)
    : QWidget(parent),
      traits_{Hertz(2e6), 1'000'000, 8, Hertz(0)},
      source_(combo(tr("Trigger source"), tr("The channel that is watched: a capture begins where its magnitude rises "
                                             "through the level."))),
      level_(new QuantitySpin("V", kLowestLevel, kMaxVolts, this)),
      preTrigger_(new QSpinBox(this)),
      length_(combo(tr("Record length"), tr("The time that one capture covers. To measure an interval it must hold two "
                                            "trains."))),
      rate_(combo(tr("Sampling rate"), tr("Samples a second. A phase needs 40 or more to be measured well."))),
      volts_(combo(tr("Voltage range"), tr("Full scale of the voltage input. Beyond it pulses are clipped and not "
                                           "measured; far below it they are coarse."))),
      amps_(combo(tr("Current range"), tr("Full scale of the current input."))),
      said_(makeLabel({}, {.tone = Tone::Quiet, .wraps = true}, this)) {
    source_->addItem(tr("Voltage"), false);
    source_->addItem(tr("Current"), true);
    level_->setValue(1);
    level_->setAccessibleName(tr("Trigger level"));
    level_->setToolTip(
        tr("The trigger fires where the magnitude rises through this. In Auto it follows a fifth of the "
           "commanded amplitude; choose Normal to set it, or drag T at the right of the screen."));
    preTrigger_->setRange(0, 100);
    preTrigger_->setValue(10);
    preTrigger_->setSuffix(QStringLiteral("\u202f%"));
    preTrigger_->setAlignment(Qt::AlignRight);
    preTrigger_->setKeyboardTracking(false);
    preTrigger_->setAccessibleName(tr("Pre-trigger"));
    preTrigger_->setToolTip(tr("How much of the record lies before the trigger. Or drag T at the top of the screen."));
    const auto offer = [](QComboBox* box, double low, double high, const QString& before, const QString& unit,
                          double at) {
        for (const double step : stepsBetween(low, high)) box->addItem(before + settingText(step, unit), step);
        choose(box, at);
    };
    offer(length_, 100e-6, 5, {}, "s", 10e-3);
    offer(volts_, 1, kMaxVolts, "±", "V", 50);
    offer(amps_, 1e-3, kMaxAmps, "±", "A", 200e-3);
    fillRates();
    auto* form = layoutIn<QFormLayout>(*this, -1, {});
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->addRow(tr("Trigger on"), source_);
    form->addRow(tr("Level"), level_);
    form->addRow(tr("Pre-trigger"), preTrigger_);
    form->addRow(tr("Record"), length_);
    form->addRow(tr("Rate"), rate_);
    form->addRow(tr("V range"), volts_);
    form->addRow(tr("I range"), amps_);
    form->addRow(said_);
    connect(source_, &QComboBox::activated, this, [this] {
        sourceChanged();
        emit changed();
    });
    for (auto* box : {length_, rate_, volts_, amps_}) {
        connect(box, &QComboBox::activated, this, [this] {
            wantedRate_hz_ = rate_->currentData().toDouble();
            say();
            emit changed();
        });
    }
    connect(level_, &QDoubleSpinBox::valueChanged, this, &AcquisitionPanel::changed);
    connect(preTrigger_, &QSpinBox::valueChanged, this, &AcquisitionPanel::changed);
    say();
}

QComboBox* AcquisitionPanel::combo(const QString& name, const QString& tip) {
    auto* box = new QComboBox(this);
    box->setAccessibleName(name);
    box->setToolTip(tip);
    return box;
}

void AcquisitionPanel::fillRates() {
    rate_->clear();
    rate_->addItem(tr("Auto"), 0.0);
    for (const double hz : stepsBetween(kLowestListed_hz, traits_.maxRate.value()))
        rate_->addItem(settingText(hz, "Hz"), hz);
    choose(rate_, wantedRate_hz_);
}

void AcquisitionPanel::setTraits(const ScopeTraits& traits) {
    traits_ = traits;
    fillRates();
    say();
}

double AcquisitionPanel::rate_hz() const {
    const double length = length_->currentData().toDouble();
    const double chosen = rate_->currentData().toDouble();
    const double wanted = chosen > 0 ? chosen : std::max(stepNotBelow(kUsualSamples / length), kUsualRate_hz);
    const double most = std::min(traits_.maxRate.value(), static_cast<double>(traits_.memoryDepth) / length);
    return std::max(kLowestRate_hz, std::min(wanted, most));
}

ScopeSettings AcquisitionPanel::settings() const {
    ScopeSettings s;
    s.sampleRate = Hertz(rate_hz());
    const double samples = length_->currentData().toDouble() * rate_hz();
    s.samples = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(samples)), 2, traits_.memoryDepth);
    s.preTrigger = preTrigger_->value() / 100.0;
    s.triggerOnCurrent = triggersOnCurrent();
    s.voltageRange = Volts(volts_->currentData().toDouble());
    s.currentRange = Milliamps(1e3 * amps_->currentData().toDouble());
    const double most = s.triggerOnCurrent ? amps_->currentData().toDouble() : s.voltageRange.value();
    s.triggerLevel = std::clamp(level_->value(), kLowestLevel, most);
    return s;
}

bool AcquisitionPanel::triggersOnCurrent() const { return source_->currentData().toBool(); }

void AcquisitionPanel::sourceChanged() {
    const bool current = triggersOnCurrent();
    const QSignalBlocker quiet(level_);
    level_->setUnit(current ? "A" : "V", kLowestLevel, current ? kMaxAmps : kMaxVolts);
    level_->setValue(current ? 1e-3 : 1);
}

void AcquisitionPanel::setLevel(double level) {
    // Rounded to three digits: the level follows the commanded amplitude, and a fourth digit has no use.
    const QSignalBlocker quiet(level_);
    level_->setValue(QString::number(level, 'g', 3).toDouble());
}

void AcquisitionPanel::setPreTrigger(double fraction) {
    preTrigger_->setValue(static_cast<int>(std::lround(100 * fraction)));
}

void AcquisitionPanel::setLevelHeld(bool held) { level_->setEnabled(!held); }

void AcquisitionPanel::save(QSettings& settings) const {
    settings.setValue("trigger/onCurrent", triggersOnCurrent());
    settings.setValue("trigger/level", level_->value());
    settings.setValue("trigger/preTrigger", preTrigger_->value());
    settings.setValue("record/length", length_->currentData());
    settings.setValue("record/rate", wantedRate_hz_);
    settings.setValue("record/volts", volts_->currentData());
    settings.setValue("record/amps", amps_->currentData());
}

void AcquisitionPanel::restore(const QSettings& settings) {
    const QSignalBlocker quiet(this);
    if (const auto current = rememberedFlag(settings, "trigger/onCurrent")) {
        source_->setCurrentIndex(*current ? 1 : 0);
        sourceChanged();
    }
    if (const auto level = rememberedNumber(settings, "trigger/level", level_->minimum(), level_->maximum())) {
        setLevel(*level);
    }
    if (const auto part = rememberedNumber(settings, "trigger/preTrigger", 0, 100)) setPreTrigger(*part / 100);
    for (const auto& [box, key] :
         {std::pair{length_, "record/length"}, std::pair{volts_, "record/volts"}, std::pair{amps_, "record/amps"}}) {
        if (const auto value = rememberedNumber(settings, key, 0, 1e3)) choose(box, *value);
    }
    const auto rate = rememberedNumber(settings, "record/rate", kLowestListed_hz, 1e10);
    wantedRate_hz_ = rate && stepNotBelow(*rate) == *rate ? *rate : 0;
    fillRates();
    say();
}

void AcquisitionPanel::say() {
    const auto s = settings();
    said_->setText(tr("%1 samples at %2").arg(countText(s.samples)).arg(settingText(s.sampleRate.value(), "Hz")));
    const double asked = rate_->currentData().toDouble();
    if (asked > s.sampleRate.value() * 1.001) {
        said_->setText(said_->text() + tr(": more does not fit into the instrument's memory"));
    }
}

}  // namespace tacto::gui

#include "moc_AcquisitionPanel.cpp"
