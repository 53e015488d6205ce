#include "app/gui/scope/panels/AcquisitionPanel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSettings>
#include <QSignalBlocker>
#include <QSpinBox>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/model/Viewport.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/FieldForm.h"
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
      kind_(combo(tr("Kind of trigger"), tr("What a capture waits for."))),
      source_(combo(tr("Trigger source"), tr("The channel that is watched."))),
      level_(new QuantitySpin("V", kLowestLevel, kMaxVolts, this)),
      fields_(new FieldForm(this)),
      find_(buildFind()),  // made in the order in which the tab key visits them
      preTrigger_(new QSpinBox(this)),
      length_(combo(tr("Record length"), tr("The time that one capture covers. To measure an interval it must hold two "
                                            "trains."))),
      rate_(combo(tr("Sampling rate"), tr("Samples a second. A phase needs 40 or more to be measured well."))),
      volts_(combo(tr("Voltage range"), tr("Full scale of the voltage input. Beyond it pulses are clipped and not "
                                           "measured; far below it they are coarse."))),
      amps_(combo(tr("Current range"), tr("Full scale of the current input."))),
      said_(makeLabel({}, {.tone = Tone::Quiet, .wraps = true}, this)) {
    for (const auto& kind : triggerKinds()) {
        kind_->addItem(tr(kind.title.data()), qtext(kind.key));
        kind_->setItemData(kind_->count() - 1, tr(kind.tip.data()), Qt::ToolTipRole);
    }
    source_->addItem(tr("Voltage"), false);
    source_->addItem(tr("Current"), true);
    level_->setValue(trigger_.level);
    level_->setAccessibleName(tr("Trigger level"));
    level_->setToolTip(
        tr("In Auto the level of the oscilloscope's own trigger follows a fifth of the commanded amplitude; choose "
           "Normal to set it, or drag T at the right of the screen."));
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
    form_ = form;
    form->addRow(tr("Trigger"), kind_);
    form->addRow(tr("Trigger on"), source_);
    form->addRow(tr("Level"), level_);
    fields_->setMinimumWidth(1);  // another kind of trigger must not widen the column and shrink the screen
    form->addRow(fields_);
    form->addRow(tr("Find"), find_);
    form->addRow(tr("Pre-trigger"), preTrigger_);
    form->addRow(tr("Record"), length_);
    form->addRow(tr("Rate"), rate_);
    form->addRow(tr("V range"), volts_);
    form->addRow(tr("I range"), amps_);
    form->addRow(said_);
    showTrigger();
    connect(kind_, &QComboBox::activated, this, [this](int kind) {
        trigger_.kind = triggerKinds()[static_cast<std::size_t>(kind)].kind;
        showTrigger();
        takeTrigger();
        emit changed();
    });
    const auto take = [this] {
        if (takeTrigger()) emit changed();
    };
    connect(fields_, &FieldForm::edited, this, take);
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
    connect(level_, &QDoubleSpinBox::valueChanged, this, take);
    connect(preTrigger_, &QSpinBox::valueChanged, this, &AcquisitionPanel::changed);
    say();
}

QWidget* AcquisitionPanel::buildFind() {
    auto* find = new QWidget(this);
    auto* steps = rowIn(*find);
    for (const auto& [text, name, tip, step] :
         {std::tuple{tr("◂ Previous"), "previousMatch", tr("Shift+F3: the match of this trigger before this one."), -1},
          std::tuple{tr("Next ▸"), "nextMatch",
                     tr("F3: the next match of this trigger in the record that is shown, also in an opened file."),
                     1}}) {
        auto* button = pageButton(text, name, tip, find);
        connect(button, &QPushButton::clicked, this, [this, by = step] { emit matchWanted(by); });
        steps->addWidget(button);
    }
    return find;
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
    const double most = std::min(traits_.maxRate.value(), static_cast<double>(depth()) / length);
    return std::max(kLowestRate_hz, std::min(wanted, most));
}

ScopeSettings AcquisitionPanel::settings() const {
    ScopeSettings s;
    s.sampleRate = Hertz(rate_hz());
    const double samples = length_->currentData().toDouble() * rate_hz();
    s.samples = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(samples)), 2, depth());
    s.preTrigger = preTrigger_->value() / 100.0;
    s.triggerOnCurrent = triggersOnCurrent();
    s.voltageRange = Volts(volts_->currentData().toDouble());
    s.currentRange = Milliamps(1e3 * amps_->currentData().toDouble());
    const double most = s.triggerOnCurrent ? amps_->currentData().toDouble() : s.voltageRange.value();
    s.triggerLevel = std::clamp(std::abs(trigger_.level), kLowestLevel, most);
    return s;
}

/// Samples per record: a trigger that is searched for needs as much again for the search.
std::size_t AcquisitionPanel::depth() const {
    return searched(trigger_.kind) ? std::max<std::size_t>(traits_.memoryDepth / 2, 2) : traits_.memoryDepth;
}

bool AcquisitionPanel::triggersOnCurrent() const { return source_->currentData().toBool(); }

const char* AcquisitionPanel::unit() const { return triggersOnCurrent() ? "A" : "V"; }

double AcquisitionPanel::fullScale() const { return triggersOnCurrent() ? kMaxAmps : kMaxVolts; }

void AcquisitionPanel::sourceChanged() {
    const QSignalBlocker quiet(level_);
    const double level = triggersOnCurrent() ? 1e-3 : 1;
    level_->setUnit(unit(), -fullScale(), fullScale());
    level_->setValue(level);
    trigger_.level = level;
    trigger_.upper = 2 * level;
    trigger_.hysteresis = 0;
    showTrigger();
}

void AcquisitionPanel::showTrigger() {
    const auto& info = infoOf(trigger_.kind);
    kind_->setCurrentIndex(kind_->findData(qtext(info.key)));
    const QSignalBlocker quiet(level_), alsoQuiet(fields_);
    level_->setUnit(unit(), searched(info.kind) ? -fullScale() : kLowestLevel, fullScale());
    static_cast<QLabel*>(form_->labelForField(level_))->setText(tr(info.level.data()));
    std::vector<FormField> fields;
    if (!info.edges.empty()) {
        std::vector<std::pair<QString, QString>> edges;
        for (const auto& edge : info.edges) edges.emplace_back(qtext(edge.text), tr(edge.text.data()));
        fields.push_back(choiceField("edge", info.kind == TriggerKind::Slope ? tr("Edge") : tr("Pulses"), edges,
                                     tr("Which edges or pulses trigger.")));
        fields.back().parameter.value = wordFor(info.edges, trigger_.edge);
    }
    if (info.kind == TriggerKind::Width) {
        fields.push_back(choiceField("widths", tr("Width"),
                                     {{"inside", tr("inside two limits")},
                                      {"outside", tr("outside two limits")},
                                      {"less", tr("less than a limit")},
                                      {"greater", tr("greater than a limit")}},
                                     tr("Which pulses trigger.")));
        fields.back().parameter.value = wordFor(kWidthRules, trigger_.widths);
    }
    for (const auto& field : info.fields) {
        const double scale = scaleOf(field), most = field.isTime ? 1 : fullScale();
        fields.push_back(numberField(field.key.data(), tr(field.title.data()), unitOf(field),
                                     field.least * most * scale, field.most * most * scale,
                                     trigger_.*field.value * scale, tr(field.tip.data())));
    }
    fields_->show(fields);
    showUsed(trigger_);
    say();
}

/// Hides the limits that `its` does not use; they have their last valid values when they are shown again.
void AcquisitionPanel::showUsed(const SampleTrigger& its) {
    const QSignalBlocker quiet(fields_);
    for (const auto& field : infoOf(its.kind).fields) {
        const std::string name(field.key);
        const bool used = uses(its, field);
        if (!used) fields_->set(name, QString::number(trigger_.*field.value * scaleOf(field), 'g', 12));
        fields_->setRowVisible(name, used);
    }
}

bool AcquisitionPanel::takeTrigger() {
    auto next = trigger_;
    next.widths = valueFor(kWidthRules, fields_->text("widths").toStdString()).value_or(next.widths);
    showUsed(next);
    const auto read = fields_->read();
    next.level = level_->value();
    const auto& info = infoOf(next.kind);
    for (const auto& field : info.fields)
        if (read) next.*field.value = read->parameters.at(std::string(field.key)).get<double>() / scaleOf(field);
    for (const auto& edge : info.edges)
        if (fields_->text("edge") == qtext(edge.text)) next.edge = edge.value;
    const auto valid = checkTrigger(next, fullScale(), unit());
    const auto why = valid ? QString() : sentence(qtext(valid.error().message));
    for (const auto* field : {"upper", "longest"})
        if (read) fields_->refuse(field, why);  // otherwise the form has said what is wrong
    if (!valid || next == trigger_) return false;
    trigger_ = next;
    say();
    return true;
}

const char* AcquisitionPanel::unitOf(const TriggerField& field) const {
    return field.isTime ? "ms" : triggersOnCurrent() ? "mA" : "V";
}

double AcquisitionPanel::scaleOf(const TriggerField& field) const {
    return field.isTime || triggersOnCurrent() ? 1e3 : 1;
}

void AcquisitionPanel::setLevel(double level) {
    // Rounded to three digits: the level follows the commanded amplitude, and a fourth digit has no use.
    const QSignalBlocker quiet(level_);
    level_->setValue(QString::number(level, 'g', 3).toDouble());
    takeTrigger();
}

void AcquisitionPanel::setUpper(double level) {
    fields_->set("upper", QString::number((triggersOnCurrent() ? 1e3 : 1) * level, 'g', 3));
}

void AcquisitionPanel::setPreTrigger(double fraction) {
    preTrigger_->setValue(static_cast<int>(std::lround(100 * fraction)));
}

void AcquisitionPanel::setLevelHeld(bool held) { level_->setEnabled(!held); }

void AcquisitionPanel::save(QSettings& settings) const {
    settings.setValue("trigger/onCurrent", triggersOnCurrent());
    settings.setValue("trigger/level", level_->value());
    settings.setValue("trigger/preTrigger", preTrigger_->value());
    settings.setValue("trigger/kind", qtext(infoOf(trigger_.kind).key));
    settings.setValue("trigger/edge", static_cast<int>(trigger_.edge));
    settings.setValue("trigger/widths", static_cast<int>(trigger_.widths));
    for (const auto& kind : triggerKinds())
        for (const auto& field : kind.fields) settings.setValue("trigger/" + qtext(field.key), trigger_.*field.value);
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
    SampleTrigger before = trigger_;
    for (const auto& kind : triggerKinds()) {
        if (settings.value("trigger/kind").toString() == qtext(kind.key)) before.kind = kind.kind;
        for (const auto& field : kind.fields) {
            const double most = field.isTime ? 1 : fullScale();
            before.*field.value =
                rememberedNumber(settings, "trigger/" + qtext(field.key), field.least * most, field.most * most)
                    .value_or(before.*field.value);
        }
    }
    if (const auto edge = rememberedNumber(settings, "trigger/edge", 0, 2))
        before.edge = static_cast<TriggerEdge>(std::lround(*edge));
    if (const auto rule = rememberedNumber(settings, "trigger/widths", 0, 3))
        before.widths = static_cast<WidthRule>(std::lround(*rule));
    trigger_.kind = before.kind;  // decides which levels are possible
    showTrigger();
    if (const auto level = rememberedNumber(settings, "trigger/level", level_->minimum(), level_->maximum())) {
        setLevel(*level);
    }
    before.level = level_->value();
    if (checkTrigger(before, fullScale(), unit())) trigger_ = before;
    showTrigger();
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
    if (!searched(trigger_.kind)) return;
    said_->setText(said_->text() + '\n' +
                   tr("A software trigger: it is searched for in the samples of each record. What happens between two "
                      "records does not trigger."));
}

}  // namespace tacto::gui

#include "moc_AcquisitionPanel.cpp"
