#include "app/gui/scope/model/Trace.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "app/gui/scope/model/TraceMath.h"

namespace tacto::gui {

namespace {

QString whyNotMeasured(const PulseFlags& flags) {
    QStringList words;
    if (flags.clipped) words << QObject::tr("clipped");
    if (flags.truncated) words << QObject::tr("cut by the record's end");
    if (flags.incomplete) words << QObject::tr("samples missing");
    if (flags.underSampled && words.isEmpty()) words << QObject::tr("too few samples");
    return words.join(QObject::tr(", "));
}

QString titleOf(const std::string& name) {
    auto title = QString::fromStdString(name);
    if (title == "voltage") return QObject::tr("Voltage");
    if (title == "current") return QObject::tr("Current");
    if (!title.isEmpty()) title[0] = title[0].toUpper();
    return title;
}

void takeEdges(const ChannelMeasurement& measured, Trace& trace) {
    for (const auto& pulse : measured.pulses) {
        if (!pulse.flags.measured()) {
            trace.marks.push_back({pulse.seenFrom_s, pulse.seenTo_s, whyNotMeasured(pulse.flags)});
            continue;
        }
        trace.edges.push_back({pulse.leading.onset_s, pulse.leading.end_s, true});
        if (pulse.second) trace.edges.push_back({pulse.second->onset_s, pulse.second->end_s, false});
    }
    for (const double level : {measured.states.baseline, measured.states.high, measured.states.low}) {
        if (std::isfinite(level)) trace.levels.push_back(level);
    }
}

TracePtr channelTrace(const std::shared_ptr<const Capture>& capture, std::size_t c, const ChannelMeasurement& measured,
                      double zero_s) {
    const auto& channel = capture->channels[c];
    // The samples stay where they are: the pointer keeps the whole capture.
    std::shared_ptr<const std::vector<float>> samples(capture, &channel.samples);
    auto trace = makeTrace(channelKey(channel.name), titleOf(channel.name), QString::fromStdString(channel.unit),
                           std::move(samples), capture->rate_hz, capture->start_s, zero_s);
    trace->low = channel.low;
    trace->high = channel.high;
    takeEdges(measured, *trace);
    return trace;
}

}  // namespace

double Trace::valueAt(double t_s) const noexcept {
    constexpr double kOnTheGrid = 1e-6;  // share of a sample: nearer than a time on a long session's base is known
    double at = (t_s - start_s) * rate_hz;
    if (const double nearest = std::round(at); std::abs(at - nearest) < kOnTheGrid) at = nearest;
    if (!(at >= 0) || !(at <= static_cast<double>(size()) - 1)) return kNotMeasured;
    const auto before = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(before), value = static_cast<double>((*samples)[before]);
    return part == 0 ? value : value + part * (static_cast<double>((*samples)[before + 1]) - value);
}

TracePtr ShownCapture::trace(const QString& key) const {
    for (const auto& trace : traces) {
        if (trace->key == key) return trace;
    }
    return nullptr;
}

double ShownCapture::end_s() const noexcept {
    return capture->start_s + static_cast<double>(capture->samples()) / capture->rate_hz;
}

QString channelKey(const std::string& name) { return "channel/" + QString::fromStdString(name); }

std::shared_ptr<Trace> makeTrace(const QString& key, const QString& title, const QString& unit,
                                 std::shared_ptr<const std::vector<float>> samples, double rate_hz, double start_s,
                                 double zero_s) {
    auto trace = std::make_shared<Trace>();
    trace->key = key;
    trace->title = title;
    trace->unit = unit;
    trace->rate_hz = rate_hz;
    trace->start_s = start_s;
    trace->zero_s = zero_s;
    trace->samples = std::move(samples);
    trace->pyramid.extend(*trace->samples);
    return trace;
}

ShownPtr prepareCapture(std::shared_ptr<const Capture> capture, const MeasureOptions& options,
                        const MathOptions& math) {
    auto shown = std::make_shared<ShownCapture>();
    shown->zero_s = std::isfinite(capture->trigger_s) ? capture->trigger_s : capture->start_s;
    auto measured = measureCapture(*capture, {}, options);
    for (std::size_t c = 0; c < capture->channels.size(); ++c) {
        shown->traces.push_back(channelTrace(capture, c, measured.channels[c], shown->zero_s));
    }
    for (std::size_t c = 0; c < capture->channels.size(); ++c) {
        shown->waveforms.push_back(measureWaveform(*capture, c, measured.channels[c]));
    }
    if (const auto pair = loadChannels(*capture)) {
        shown->loadCurrent = pair->second;
        shown->loads = loadOfPulses(*capture, pair->first, pair->second, measured.channels[pair->second]);
    }
    shown->measurement = std::move(measured.channels);
    shown->warnings = std::move(measured.warnings);
    shown->capture = std::move(capture);
    addMath(shown->traces, math);
    return shown;
}

ShownPtr withMath(const ShownCapture& shown, const MathOptions& math) {
    auto again = std::make_shared<ShownCapture>(shown);
    std::erase_if(again->traces, [](const TracePtr& trace) { return trace->key.startsWith("math/"); });
    addMath(again->traces, math);
    return again;
}

}  // namespace tacto::gui
