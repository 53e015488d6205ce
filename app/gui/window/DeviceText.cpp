#include "app/gui/window/DeviceText.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("DeviceDock", text); }

QString orDash(const std::string& text) { return text.empty() ? "–" : QString::fromStdString(text).toHtmlEscaped(); }

std::string schemeOf(const std::string& uri) { return uri.substr(0, uri.find(':')); }

}  // namespace

bool isSame(const SessionDevice& open, const DeviceIdentity& present) {
    if (present.placeholder || open.role != nameOf(present.role)) return false;
    if (open.uri == present.uri) return true;
    const auto uri = DeviceUri::parse(open.uri);
    if (!uri || uri->scheme != schemeOf(present.uri)) return false;
    if (present.simulated) return open.name == present.name;
    // A terminal is not among what is plugged in.
    const bool terminal = std::ranges::any_of(uri->parameters, [](const auto& one) { return one.first == "tty"; });
    if (terminal) return false;
    return uri->path.empty() || uri->path == present.serial || (!open.serial.empty() && open.serial == present.serial);
}

bool unpluggedWhileOpen(const SessionDevice& open, const std::vector<DeviceIdentity>& present,
                        const std::set<std::string>& seen) {
    return seen.contains(open.uri) &&
           std::ranges::none_of(present, [&](const auto& device) { return isSame(open, device); });
}

QStringList factsOf(const SessionDevice& device, const OpenBench& open) {
    QStringList lines;
    lines << tr("Serial %1, firmware %2").arg(orDash(device.serial), orDash(device.firmware));
    if (device.simulated) lines << tr("Simulated: none of its numbers were measured on hardware.");
    if (device.is(Role::Stimulator) && open.source) {
        const auto drive = open.source->drive;
        lines << tr("%1 source, at most %2")
                     .arg(drive == Drive::Current ? tr("Current") : tr("Voltage"),
                          settingText(open.source->amplitudeMax, amplitudeUnit(drive)));
    }
    if (device.is(Role::Sensor)) {
        for (const auto& stream : open.streams) {
            const auto kind = nameOf(stream.kind);
            lines << tr("%1: %2, %3")
                         .arg(titled(qtext(kind)),
                              stream.channels == 1 ? tr("1 channel") : tr("%1 channels").arg(stream.channels),
                              settingText(stream.rate_hz, "Hz"));
        }
    }
    if (device.is(Role::Oscilloscope) && open.scope) {
        lines << tr("%1 bits, up to %2").arg(open.scope->bits).arg(settingText(open.scope->maxRate.value(), "S/s"));
    }
    return lines;
}

QStringList rowsOf(const DeviceReport& report) {
    QStringList lines;
    for (const auto& row : report.rows()) {
        const bool count = row.unit[0] == 0;
        if (!std::isfinite(row.value) || (count && row.value == 0)) continue;
        const auto value = count                               ? decimalText(row.value, 0)
                           : std::string_view(row.unit) == "s" ? settingText(row.value, "s")
                                                               : decimalText(row.value, 1, row.unit);
        lines << QString("%1: %2").arg(titled(QString(row.name)), value);
    }
    lines << (report.losses > 0 ? tr("⚠ Something was lost between it and this program.") : tr("Nothing was lost."));
    return lines;
}

}  // namespace tacto::gui
