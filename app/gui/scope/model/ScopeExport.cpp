#include "app/gui/scope/model/ScopeExport.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "core/measure/CaptureFile.h"

namespace tacto::gui {

std::optional<QString> saveData(const ShownCapture& shown, double from_s, double to_s, const QString& path) {
    const auto& whole = *shown.capture;
    const auto index = [&](double t) {
        const double at = std::ceil((t - whole.start_s) * whole.rate_hz - 1e-6);
        return static_cast<std::ptrdiff_t>(std::clamp(at, 0.0, static_cast<double>(whole.samples())));
    };
    const auto first = index(from_s), last = index(to_s);
    if (first >= last) return QObject::tr("No data were saved: no sample is on the screen.");
    Capture part;
    part.rate_hz = whole.rate_hz;
    part.start_s = whole.start_s + static_cast<double>(first) / whole.rate_hz;
    for (const auto& trace : shown.traces) {
        CaptureChannel channel;
        channel.name = trace->key.section('/', 1).toStdString();
        channel.unit = trace->unit.toStdString();
        channel.samples.assign(trace->samples->begin() + first, trace->samples->begin() + last);
        part.channels.push_back(std::move(channel));
    }
    if (const auto written = writeCapture(path.toStdString(), part); !written) {
        return QObject::tr("%1. A file of that name is as it was.")
            .arg(QString::fromStdString(written.error().message));
    }
    return {};
}

}  // namespace tacto::gui
