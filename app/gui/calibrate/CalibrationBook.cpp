#include "app/gui/calibrate/CalibrationBook.h"

#include <chrono>

#include "app/gui/theme/Text.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

QString daysText(int days) { return QObject::tr("%1 d").arg(days); }

}  // namespace

CalibrationBook::CalibrationBook(BenchController& controller, QObject* parent)
    : QObject(parent), controller_(controller) {
    connect(&controller_, &BenchController::changed, this, &CalibrationBook::follow);
    connect(&controller_, &BenchController::finished, this, &CalibrationBook::read);
    last_ = connected();
    read();
}

std::optional<StimulatorId> CalibrationBook::connected() const {
    const auto open = controller_.open();
    if (!open) return std::nullopt;
    for (const auto& device : open->about.devices) {
        if (device.role != nameOf(Role::Stimulator)) continue;
        const char* unit = open->source ? amplitudeUnit(open->source->drive) : "";
        return StimulatorId{calibratedOutput(device.serial, device.uri), device.name, unit, device.simulated};
    }
    return std::nullopt;
}

void CalibrationBook::follow() {
    const auto now = connected();
    if (!now || now == last_) return;
    last_ = now;
    read();
}

void CalibrationBook::read() {
    auto store = CalibrationStore::open(calibrationFile());
    fault_ = store ? QString() : sentence(store.error());
    store_.reset();
    if (store) store_ = std::move(*store);
    emit changed();
}

std::vector<StimulatorId> CalibrationBook::known() const {
    std::vector<StimulatorId> found;
    const auto add = [&](const StimulatorId& one) {
        const auto same = [&](const StimulatorId& other) { return other.serial == one.serial; };
        if (std::none_of(found.begin(), found.end(), same)) found.push_back(one);
    };
    if (const auto open = connected()) add(*open);
    if (last_) add(*last_);
    for (const auto& device : controller_.watch().devices()) {
        // A simulated device has a serial number only after it is opened.
        if (device.role == Role::Stimulator && !device.simulated)
            add({device.serial, device.name, {}, device.simulated});
    }
    if (!store_) return found;
    for (const auto& stored : store_->all()) add({stored.serial, stored.device, stored.unit, stored.simulated});
    return found;
}

CalibrationStanding CalibrationBook::standing(const StimulatorId& stimulator) const {
    CalibrationStanding found;
    if (!store_) {
        found.state = CalibrationState::Unreadable;
        found.why = fault_;
        return found;
    }
    if (stimulator.serial.empty()) {
        found.state = CalibrationState::NoSerial;
        found.why = tr("It reports no serial number, so no calibration can be kept for it.");
        return found;
    }
    auto unit = stimulator.unit;
    if (const auto all = history(stimulator.serial); unit.empty() && !all.empty()) unit = all.front().unit;
    const auto today = utcToday();
    if (const auto* newest = store_->latest(stimulator.serial, unit)) {
        found.newest = *newest;
        found.age_d = daysBetween(newest->made, today);
        found.left_d = daysBetween(today, newest->validUntil);
    }
    const auto valid = store_->valid(stimulator.serial, unit, today, stimulator.simulated);
    if (valid) {
        found.state = CalibrationState::Valid;
    } else {
        found.why = sentence(valid.error());
        found.state = !found.newest                                      ? CalibrationState::Never
                      : found.newest->simulated && !stimulator.simulated ? CalibrationState::OfSimulation
                                                                         : CalibrationState::Expired;
    }
    return found;
}

std::vector<StoredCalibration> CalibrationBook::history(const std::string& serial) const {
    std::vector<StoredCalibration> found;
    if (!store_) return found;
    for (const auto& stored : store_->all()) {
        if (stored.serial == serial) found.insert(found.begin(), stored);
    }
    return found;
}

QString standingText(const CalibrationStanding& standing) {
    switch (standing.state) {
        case CalibrationState::Valid: {
            const auto until = QString::fromStdString(dateText(standing.newest->validUntil));
            return standing.age_d == 0
                       ? QObject::tr("calibrated today, until %1").arg(until)
                       : QObject::tr("calibrated %1 ago, until %2").arg(daysText(standing.age_d), until);
        }
        case CalibrationState::Expired:
            // A calibration dated in the future is not valid either.
            return standing.left_d >= 0 ? QObject::tr("not calibrated")
                                        : QObject::tr("calibration expired %1 ago").arg(daysText(-standing.left_d));
        case CalibrationState::Unreadable:
            return QObject::tr("calibration not readable");
        case CalibrationState::Never:
        case CalibrationState::OfSimulation:
        case CalibrationState::NoSerial:
            break;
    }
    return QObject::tr("not calibrated");
}

QString standingTip(const CalibrationStanding& standing) {
    if (standing.state == CalibrationState::Valid) {
        return QObject::tr(
                   "What the stimulator delivers was measured: within %1 of the command (95 %). Check it under "
                   "Calibrate whenever something was changed.")
            .arg(quantityText(standing.newest->amplitude.uncertainty_pct, "%", 2));
    }
    return QObject::tr(
               "%1 The stimulator may be used on bench loads only, not on a person, and reports say so. "
               "Calibrate it under Calibrate (Ctrl+2).")
        .arg(standing.why);
}

}  // namespace tacto::gui

#include "moc_CalibrationBook.cpp"
