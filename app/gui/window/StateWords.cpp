#include "app/gui/window/StateWords.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Text.h"

namespace tacto::gui {

namespace {

/// Returns why the fingertip drives no train; empty if it does.
QString fingerHolds(const Telemetry& telemetry) {
    switch (telemetry.finger) {
        case FingerStanding::Stale:
            return QObject::tr("No train: the fingertip’s samples are old. Space stops.");
        case FingerStanding::Implausible:
            return QObject::tr("No train: the fingertip gives no readings. Space stops.");
        case FingerStanding::Fresh:
            return QObject::tr("No train: the fingertip feels nothing. Space stops.");
        case FingerStanding::None:
            break;
    }
    return QObject::tr("From the fingertip. Space stops.");
}

QString deliveringWords(const Telemetry& telemetry) {
    const bool repeats = std::isfinite(telemetry.interval_s);
    const auto every = repeats ? quantityText(telemetry.interval_s, "s", 3) : QString();
    switch (telemetry.driving) {
        case DriveSource::Manual:
            return repeats ? QObject::tr("A train every %1, set by hand. Space stops.").arg(every)
                           : QObject::tr("Set by hand. Space stops.");
        case DriveSource::Sensor:
            return repeats ? QObject::tr("From the fingertip, every %1. Space stops.").arg(every)
                           : fingerHolds(telemetry);
        case DriveSource::Off:
            break;
    }
    return QObject::tr("The last train ends by itself. Space stops.");
}

QString armedWords(DriveSource driving) {
    switch (driving) {
        case DriveSource::Manual:
            return QObject::tr("Set by hand: the next train follows. Space stops.");
        case DriveSource::Sensor:
            return QObject::tr("The fingertip drives it. Space stops.");
        case DriveSource::Off:
            break;
    }
    return QObject::tr("Choose a drive to deliver.");
}

}  // namespace

QString reasonWords(const QString& reason) {
    static const QRegularExpression byOperator(R"(^operator \((.+)\)$)");
    const auto found = byOperator.match(reason);
    return found.hasMatch() ? QObject::tr("stopped with %1").arg(found.captured(1)) : reason;
}

QString stateWords(const Telemetry& telemetry, const QString& protocol, bool refused) {
    const auto reason = reasonWords(qtext(telemetry.reason.view()));
    const bool puts = telemetry.state == InterlockState::Armed || telemetry.state == InterlockState::Delivering;
    if (refused && puts && !telemetry.paused && protocol.isEmpty() && telemetry.driving != DriveSource::Off)
        return QObject::tr("No train: a limit refuses it. Space stops.");
    switch (telemetry.state) {
        case InterlockState::Disconnected:
            return QObject::tr("No stimulator is open.");
        case InterlockState::Faulted:
            return qtext(outputAfter(telemetry.fault));
        case InterlockState::Disarmed:
            return reason.isEmpty() ? QObject::tr("Output is off. “Arm…” asks before anything flows.")
                                    : QObject::tr("Output is off: %1. “Arm…” goes on.").arg(reason);
        case InterlockState::Checking:
            return QObject::tr("One small pulse measures the impedance.");
        case InterlockState::Delivering:
            if (telemetry.driving == DriveSource::Sensor && telemetry.finger != FingerStanding::Fresh)
                return fingerHolds(telemetry);
            return protocol.isEmpty() ? deliveringWords(telemetry)
                                      : QObject::tr("Protocol %1 drives. Space stops.").arg(protocol);
        case InterlockState::Paused:
            return QObject::tr("No train is delivered until you resume.");
        case InterlockState::Armed:
            if (telemetry.paused) return QObject::tr("No train is delivered until you resume.");
            return protocol.isEmpty() ? armedWords(telemetry.driving)
                                      : QObject::tr("Armed by the protocol %1. Space stops.").arg(protocol);
    }
    return {};
}

bool isOn(InterlockState state) noexcept {
    return state == InterlockState::Checking || state == InterlockState::Armed || state == InterlockState::Delivering ||
           state == InterlockState::Paused;
}

bool outputIsOff(InterlockState state) {
    return state == InterlockState::Disconnected || state == InterlockState::Disarmed ||
           state == InterlockState::Faulted;
}

std::vector<ExposureRow> exposureNow(const Telemetry& telemetry) {
    const auto booked = telemetry.exposure();
    std::vector<ExposureRow> rows(booked.begin(), booked.end());
    if (!outputIsOff(telemetry.state)) return rows;
    if (std::ranges::all_of(rows, [](const ExposureRow& row) { return std::isnan(row.limit); })) return {};
    for (auto& row : rows) {
        if (!row.evaluated || std::isnan(row.value) || windowOf(row.quantity) > 0) continue;
        row.value = 0;
        row.within = true;
        row.measured = std::nan("");
        row.beyond = false;
    }
    return rows;
}

}  // namespace tacto::gui
