#include "app/gui/scope/panels/MaskPanel.h"

#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>
#include <algorithm>
#include <array>
#include <utility>

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kVolts = 2, kAmps = 2e-3, kTime_s = 5e-6;  // half-widths at the first start: 5 % of 40 V and of 40 mA

}  // namespace

MaskPanel::MaskPanel(QWidget* parent)
    : QWidget(parent),
      volts_(new QuantitySpin("V", 1e-6, 1e3, this)),
      amps_(new QuantitySpin("A", 1e-9, 10, this)),
      time_(new QuantitySpin("s", 0, 1, this)),
      make_(new QPushButton(tr("Make from what is shown"), this)),
      remove_(new QPushButton(tr("Remove"), this)),
      reset_(new QPushButton(tr("Reset counts"), this)),
      showFirst_(new QPushButton(tr("Show the first outside"), this)),
      says_(makeLabel({}, {.name = "maskSays", .wraps = true, .selectable = true}, this)) {
    make_->setToolTip(
        tr("A band around the capture on the screen. Captures from now on are tested against it. This does "
           "not affect the output."));
    remove_->setToolTip(tr("Captures are no longer tested."));
    reset_->setToolTip(tr("Forgets what was counted, and the first capture outside."));
    showFirst_->setToolTip(tr("The first capture that left the band. It is kept until the counts are reset."));
    const std::array fields{std::pair(volts_, tr("Voltage ±")), std::pair(amps_, tr("Current ±")),
                            std::pair(time_, tr("Time ±"))};
    auto* form = new QFormLayout;
    form->setContentsMargins(0, 0, 0, 0);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    for (const auto& [spin, name] : fields) {
        spin->setAccessibleName(tr("Mask: %1").arg(name));
        spin->setToolTip(tr("How far a capture may be from the reference. Changing a width makes a new mask."));
        spin->setKeyboardTracking(false);
        form->addRow(name, spin);
        connect(spin, &QDoubleSpinBox::valueChanged, this, &MaskPanel::bandChanged);
    }
    {
        const QSignalBlocker volts(volts_), amps(amps_), time(time_);
        volts_->setValue(kVolts);
        amps_->setValue(kAmps);
        time_->setValue(kTime_s);
    }
    auto* layout = columnIn(*this);
    layout->addLayout(form);
    addAll(*layout, {make_, says_, showFirst_});
    auto* row = new QHBoxLayout;
    addAll(*row, {reset_, remove_});
    layout->addLayout(row);
    connect(make_, &QPushButton::clicked, this, &MaskPanel::makeWanted);
    connect(remove_, &QPushButton::clicked, this, &MaskPanel::remove);
    connect(reset_, &QPushButton::clicked, this, &MaskPanel::resetCounts);
    connect(showFirst_, &QPushButton::clicked, this, &MaskPanel::firstOutsideWanted);
    say();
}

MaskBand MaskPanel::band() const { return {{{"V", volts_->value()}, {"A", amps_->value()}}, time_->value()}; }

void MaskPanel::make(const ShownPtr& reference) {
    if (reference) makeOf(reference->capture);
}

void MaskPanel::makeOf(std::shared_ptr<const Capture> reference) {
    auto made = CaptureMask::around(*reference, band());
    problem_ = made ? QString() : sentence(made.error());
    if (made) {
        reference_ = std::move(reference);
        mask_ = std::make_shared<const CaptureMask>(std::move(*made));
        counts_ = {};
        first_.reset();
        emit maskChanged();
        emit countsChanged();
    }
    say();
}

void MaskPanel::bandChanged() {
    if (reference_) makeOf(reference_);
}

void MaskPanel::remove() {
    mask_.reset();
    reference_.reset();
    problem_.clear();
    emit maskChanged();
    resetCounts();
}

/// Starts a new test with the same band: a capture that was still tested by the old test is not counted.
void MaskPanel::resetCounts() {
    if (mask_) {
        mask_ = std::make_shared<const CaptureMask>(*mask_);
        emit maskChanged();
    }
    counts_ = {};
    first_.reset();
    say();
    emit countsChanged();
}

void MaskPanel::take(const ShownPtr& shown) {
    if (!mask_ || !shown->mask || shown->judgedBy != mask_) return;  // tested against an earlier mask
    counts_.add(*shown->mask);
    if (shown->mask->verdict == MaskVerdict::Outside && !first_) first_ = shown;
    if (shown->mask->verdict == MaskVerdict::NotJudged) whyNot_ = qtext(shown->mask->why);
    say();
    emit countsChanged();
}

QString MaskPanel::said() const {
    if (!mask_) return {};
    if (counts_.judged() == 0 && counts_.notJudged == 0) return tr("Mask: no capture yet");
    auto text = tr("Mask: %1 of %2 captures inside").arg(counts_.inside).arg(counts_.judged());
    if (counts_.notJudged > 0) text += tr(", %1 not judged").arg(counts_.notJudged);
    return text;
}

QString MaskPanel::alarm() const {
    if (!mask_ || counts_.outside == 0) return {};
    return tr("✕ Mask failed: %1 of %2 captures outside").arg(counts_.outside).arg(counts_.judged());
}

void MaskPanel::say() {
    QStringList lines;
    if (!problem_.isEmpty()) lines << problem_;
    if (mask_) lines << said() + ".";
    if (first_) {
        const auto& worst = *first_->mask->worst;
        const auto channel = std::ranges::find(mask_->channels(), worst.channel, &CaptureMask::Channel::name);
        const auto unit = channel == mask_->channels().end() ? QString() : QString::fromStdString(channel->unit);
        lines << tr("The first outside: %1 at %2, %3 where the band ends at %4.")
                     .arg(titled(QString::fromStdString(worst.channel)), quantityText(worst.time_s, "s"),
                          quantityText(worst.value, unit), quantityText(worst.limit, unit));
    }
    if (counts_.notJudged > 0) lines << tr("The last one was not judged: %1.").arg(whyNot_);
    if (lines.isEmpty()) lines << tr("Captures are not tested.");
    says_->setText(lines.join('\n'));
    setTone(*says_, first_ || !problem_.isEmpty() ? Tone::Warning : Tone::Quiet);
    remove_->setEnabled(mask_ != nullptr);
    reset_->setEnabled(mask_ && counts_.judged() + counts_.notJudged > 0);
    showFirst_->setVisible(first_ != nullptr);
}

void MaskPanel::save(QSettings& settings) const {
    settings.setValue("mask/volts", volts_->value());
    settings.setValue("mask/amps", amps_->value());
    settings.setValue("mask/time", time_->value());
}

void MaskPanel::restore(const QSettings& settings) {
    for (const auto& [spin, key] :
         {std::pair{volts_, "mask/volts"}, std::pair{amps_, "mask/amps"}, std::pair{time_, "mask/time"}}) {
        const QSignalBlocker quiet(spin);
        spin->setValue(rememberedNumber(settings, key, spin->minimum(), spin->maximum()).value_or(spin->value()));
    }
}

}  // namespace tacto::gui

#include "moc_MaskPanel.cpp"
