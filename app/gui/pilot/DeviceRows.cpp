#include "app/gui/pilot/DeviceRows.h"

#include <QSignalBlocker>
#include <QStandardItemModel>

#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

constexpr const char* kSimulated = "sim:";

void fill(QComboBox& box, const std::vector<DeviceIdentity>& present, Role role) {
    auto* items = qobject_cast<QStandardItemModel*>(box.model());
    for (const auto& device : present) {
        if (device.role != role || device.simulated || device.placeholder) continue;
        const auto name = device.serial.empty() ? qtext(device.name) : qtext(device.name + " · " + device.serial);
        box.addItem(device.obstacle.empty() ? name : "⚠ " + name, qtext(device.uri));
        box.setItemData(box.count() - 1, qtext(device.obstacle.empty() ? device.uri : device.obstacle),
                        Qt::ToolTipRole);
        items->item(box.count() - 1)->setEnabled(device.obstacle.empty());
    }
}

/// Keeps the earlier choice while it is still offered; otherwise chooses nothing.
void chooseAgain(QComboBox& box, const QVariant& before) {
    const int at = before.isValid() ? box.findData(before) : -1;
    auto* items = qobject_cast<QStandardItemModel*>(box.model());
    box.setCurrentIndex(at >= 0 && items->item(at)->isEnabled() ? at : -1);
}

}  // namespace

DeviceRows::DeviceRows(FieldForm& form, const DeviceWatch& watch)
    : QObject(&form), form_(form), watch_(watch), delivers_(new QComboBox), looks_(new QComboBox) {
    delivers_->setObjectName("deliversWith");
    delivers_->setToolTip(tr("The device is opened for the session alone; a bench open under Live is closed first."));
    looks_->setObjectName("looksAtMotor");
    looks_->setPlaceholderText(tr("none chosen"));
    looks_->setToolTip(
        tr("A sensor board on the motor measures what the massager really does. Without one, its vibration is not "
           "measured."));
    for (auto* box : {delivers_, looks_}) connect(box, &QComboBox::currentIndexChanged, this, &DeviceRows::judge);
    connect(&watch_, &DeviceWatch::changed, this, [this] {
        if (watch_.devices() != listed_) list();
    });
}

std::vector<FormField> DeviceRows::fields() const {
    return {ownField(tr("Delivers"), delivers_), ownField(tr("Motor sensor"), looks_)};
}

void DeviceRows::offer(const StudySettings& study, bool person) {
    const bool rehearsal = study.kind == StudyKind::Rehearsal;
    role_ = study.modality == Modality::Massager ? Role::Massager : Role::Stimulator;
    simulated_ = !person || rehearsal;
    plugged_ = person && (!rehearsal || role_ == Role::Massager);
    {
        const QSignalBlocker quiet(delivers_), also(looks_);
        delivers_->clear();
        looks_->clear();
    }
    list();
    const QSignalBlocker quiet(delivers_);
    if (simulated_ || delivers_->count() == 1) chooseAgain(*delivers_, delivers_->itemData(0));
    judge();
}

void DeviceRows::list() {
    listed_ = watch_.devices();
    {
        const QSignalBlocker quiet(delivers_), also(looks_);
        const auto delivered = delivers_->currentData();
        const auto looked = looks_->count() > 0 ? looks_->currentData() : QVariant(QString());
        delivers_->clear();
        if (simulated_) delivers_->addItem(tr("the simulated bench"), QString(kSimulated));
        if (plugged_) fill(*delivers_, listed_, role_);
        delivers_->setPlaceholderText(delivers_->count() == 0 ? missing() : tr("none chosen"));
        chooseAgain(*delivers_, delivered);
        looks_->clear();
        looks_->addItem(tr("nothing: what it does is not measured"), QString());
        fill(*looks_, listed_, Role::Sensor);
        chooseAgain(*looks_, looked);
    }
    judge();
}

void DeviceRows::judge() {
    const auto delivered = delivers_->currentData();
    form_.setRowVisible(*looks_, role_ == Role::Massager && delivered.isValid() && delivered != QString(kSimulated));
    emit changed();
}

std::vector<DeviceUri> DeviceRows::chosen() const {
    if (!missing().isEmpty()) return {};
    std::vector<DeviceUri> uris;
    for (auto* box : {delivers_, looks_}) {
        const auto text = box->currentData().toString();
        if (text.isEmpty() || !form_.isRowVisible(*box)) continue;
        if (auto uri = DeviceUri::parse(text.toStdString())) uris.push_back(std::move(*uri));
    }
    return uris;
}

QString DeviceRows::missing() const {
    const bool massager = role_ == Role::Massager;
    if (delivers_->count() == 0)
        return massager ? tr("No massager is plugged in.") : tr("No stimulator is plugged in.");
    if (delivers_->currentIndex() < 0) return tr("Choose the device that delivers.");
    if (form_.isRowVisible(*looks_) && looks_->currentIndex() < 0)
        return tr("The sensor board on the motor is gone. Choose another, or nothing.");
    return {};
}

}  // namespace tacto::gui

#include "moc_DeviceRows.cpp"
