#include "app/gui/scope/panels/ViewPanel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QSettings>
#include <QSignalBlocker>
#include <algorithm>
#include <array>
#include <cmath>

#include "app/gui/scope/model/Remembered.h"
#include "app/gui/scope/model/ScopeModel.h"
#include "app/gui/scope/model/Viewport.h"
#include "app/gui/scope/panels/QuantitySpin.h"
#include "app/gui/theme/Building.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr std::array kAverages{4, 16, 64, 256};

}  // namespace

ViewPanel::ViewPanel(ScopeModel& model, QWidget* parent)
    : QWidget(parent),
      model_(model),
      base_(new QComboBox(this)),
      centre_(new QuantitySpin("s", -1e7, 1e7, this)),
      persistence_(new QComboBox(this)),
      average_(new QComboBox(this)),
      power_(new QCheckBox(tr("Power V·I"), this)),
      charge_(new QCheckBox(tr("Charge ∫I dt"), this)),
      difference_(new QComboBox(this)),
      spectrum_(new QCheckBox(tr("Spectrum"), this)) {
    const auto say = [](QWidget* field, const QString& name, const QString& tip) {
        field->setAccessibleName(name);
        field->setToolTip(tip);
    };
    say(base_, tr("Time base"),
        tr("How much time lies between two lines of the grid. The wheel over the screen does the same."));
    for (const double s : stepsBetween(10e-9, 100)) addStep(*base_, s, "s");
    say(centre_, tr("Time position"), tr("The time in the middle of the screen. Dragging the screen does the same."));
    say(persistence_, tr("Captures that stay"),
        tr("Earlier captures stay on the screen, faded: jitter shows as a band."));
    persistence_->addItem(tr("newest only"), 0);
    for (const int n : {4, 8, 16, ScopeModel::kMaxBehind}) persistence_->addItem(tr("and %1 before").arg(n), n);
    say(average_, tr("Average"),
        tr("The mean of so many captures, aligned at the trigger: noise goes, what repeats stays. It "
           "starts over when a setting or the commanded amplitude changes."));
    average_->addItem(tr("none"), 1);
    for (const int n : kAverages) average_->addItem(tr("%1 captures").arg(n), n);
    power_->setToolTip(tr("Voltage times current, sample by sample, in watts."));
    charge_->setToolTip(
        tr("The current added up from the start of the record, in coulombs: a balanced pulse returns to "
           "where it began. After missing samples it begins again at zero."));
    for (auto* box : {base_, persistence_, average_, difference_}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(10);
    }
    say(difference_, tr("Difference"), tr("One channel minus another, or minus a stored reference of the same unit."));
    spectrum_->setToolTip(tr("The spectrum of what a lane shows on the screen, below it."));
    // Each check box is only as wide as its text, so that a click next to the text does nothing.
    for (auto* box : {power_, charge_, spectrum_}) box->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
    auto* form = layoutIn<QFormLayout>(*this, -1, {});
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->addRow(tr("Time base"), base_);
    form->addRow(tr("Middle"), centre_);
    form->addRow(tr("Show"), persistence_);
    form->addRow(tr("Average"), average_);
    form->addRow(power_);
    form->addRow(charge_);
    form->addRow(tr("Difference"), difference_);
    form->addRow(spectrum_);
    connect(base_, &QComboBox::activated, this, [this] { model_.setTimePerDivision(base_->currentData().toDouble()); });
    connect(centre_, &QDoubleSpinBox::valueChanged, this, [this](double t) { model_.setTimeCentre(t); });
    connect(persistence_, &QComboBox::activated, this,
            [this] { model_.setPersistence(persistence_->currentData().toInt()); });
    connect(average_, &QComboBox::activated, this, [this] { setAverage(average_->currentData().toInt()); });
    connect(power_, &QCheckBox::toggled, this, &ViewPanel::mathOptionsChanged);
    connect(charge_, &QCheckBox::toggled, this, &ViewPanel::mathOptionsChanged);
    connect(difference_, &QComboBox::activated, this, [this] {
        wantedDifference_.clear();
        emit mathOptionsChanged();
    });
    connect(spectrum_, &QCheckBox::toggled, this, &ViewPanel::spectrumToggled);
    connect(&model_, &ScopeModel::viewChanged, this, &ViewPanel::follow);
    connect(&model_, &ScopeModel::lanesChanged, this, &ViewPanel::offerDifferences);
    offerDifferences();
    follow();
}

void ViewPanel::follow() {
    const auto& v = model_.viewport();
    showStep(*base_, stepNotBelow(v.perDivision_s), "s");  // the step that the grid and the tool show
    const QSignalBlocker quiet(centre_);
    centre_->setValue(v.left_s + v.width_s() / 2);
}

void ViewPanel::setAverage(int captures) {
    const int at = average_->findData(captures);
    if (at < 0) return;
    average_->setCurrentIndex(at);
    if (captures > 1) lastAverage_ = captures;
    emit averageChanged(captures);
}

int ViewPanel::average() const { return average_->currentData().toInt(); }

void ViewPanel::setSpectrum(bool on) { spectrum_->setChecked(on); }

void ViewPanel::offerDifferences() {
    const auto chosen = difference_->currentData();
    const QSignalBlocker quiet(difference_);
    difference_->clear();
    difference_->addItem(tr("none"), QStringList());
    const auto& lanes = model_.lanes();
    for (const auto& a : lanes) {
        if (!a.key.startsWith("channel/")) continue;
        for (const auto& b : lanes) {
            if (a.key == b.key || a.unit != b.unit || b.key.startsWith("math/")) continue;
            difference_->addItem(tr("%1 − %2").arg(a.letter, b.letter), QStringList{a.key, b.key});
        }
    }
    const int same = difference_->findData(chosen);
    const int wanted = wantedDifference_.isEmpty() ? -1 : difference_->findData(wantedDifference_);
    difference_->setCurrentIndex(std::max({0, same, wanted}));
    difference_->setEnabled(difference_->count() > 1);
    if (wanted >= 0) wantedDifference_.clear();
    if (wanted >= 0 || (same < 0 && !chosen.toStringList().isEmpty())) emit mathOptionsChanged();
}

MathOptions ViewPanel::mathOptions() const {
    MathOptions mathOptions;
    mathOptions.power = power_->isChecked();
    mathOptions.charge = charge_->isChecked();
    const auto difference = difference_->currentData().toStringList();
    if (difference.size() == 2) {
        mathOptions.minuend = difference[0];
        if (difference[1].startsWith("reference/")) {
            mathOptions.reference = model_.trace(difference[1]);
        } else {
            mathOptions.subtrahend = difference[1];
        }
    }
    return mathOptions;
}

void ViewPanel::save(QSettings& settings) const {
    settings.setValue("persistence", persistence_->currentData());
    settings.setValue("average", average());
    settings.setValue("math/power", power_->isChecked());
    settings.setValue("math/charge", charge_->isChecked());
    settings.setValue("spectrum", wantsSpectrum());
    // References are not saved, so a difference with a reference is not saved either.
    auto difference = wantedDifference_.isEmpty() ? difference_->currentData().toStringList() : wantedDifference_;
    if (difference.size() != 2 || difference[1].startsWith("reference/")) difference.clear();
    settings.setValue("math/difference", difference);
}

void ViewPanel::restore(const QSettings& settings) {
    if (const auto captures = rememberedNumber(settings, "persistence", 0, ScopeModel::kMaxBehind)) {
        if (const int at = persistence_->findData(static_cast<int>(*captures)); at >= 0) {
            persistence_->setCurrentIndex(at);
            model_.setPersistence(persistence_->currentData().toInt());
        }
    }
    if (const auto captures = rememberedNumber(settings, "average", 1, kAverages.back())) {
        setAverage(static_cast<int>(*captures));
    }
    for (const auto& [box, key] :
         {std::pair{power_, "math/power"}, std::pair{charge_, "math/charge"}, std::pair{spectrum_, "spectrum"}}) {
        box->setChecked(rememberedFlag(settings, key).value_or(box->isChecked()));
    }
    wantedDifference_ = settings.value("math/difference").toStringList();
    if (wantedDifference_.size() != 2) wantedDifference_.clear();
}

bool ViewPanel::wantsSpectrum() const { return spectrum_->isChecked(); }

}  // namespace tacto::gui

#include "moc_ViewPanel.cpp"
