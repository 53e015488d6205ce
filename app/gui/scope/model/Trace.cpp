#include "app/gui/scope/model/Trace.h"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

template <class Is>
TracePtr firstWhere(const std::vector<TracePtr>& traces, Is is) {
    const auto found = std::find_if(traces.begin(), traces.end(), [&](const TracePtr& trace) { return is(*trace); });
    return found == traces.end() ? nullptr : *found;
}

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

QString letterOf(const Capture& capture, std::size_t channel) {
    const auto alike = [&](const CaptureChannel& other) { return other.unit == capture.channels[channel].unit; };
    const auto begin = capture.channels.begin();
    const auto& unit = capture.channels[channel].unit;
    const QString letter = unit == "V" ? "V" : unit == "A" ? "I" : "D";
    if (std::count_if(begin, capture.channels.end(), alike) == 1) return letter;
    return letter + QString::number(std::count_if(begin, begin + static_cast<std::ptrdiff_t>(channel) + 1, alike));
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
    // The samples are not copied: the pointer keeps the whole capture alive.
    std::shared_ptr<const std::vector<float>> samples(capture, &channel.samples);
    auto trace = makeTrace(channelKey(channel.name), titleOf(channel.name), QString::fromStdString(channel.unit),
                           std::move(samples), capture->rate_hz, capture->start_s, zero_s);
    trace->letter = letterOf(*capture, c);
    trace->low = channel.low;
    trace->high = channel.high;
    takeEdges(measured, *trace);
    return trace;
}

}  // namespace

double Trace::valueAt(double t_s) const noexcept {
    constexpr double kOnTheGrid = 1e-6;  // share of a sample; times on a long session's base are less precise
    double at = (t_s - start_s) * rate_hz;
    if (const double nearest = std::round(at); std::abs(at - nearest) < kOnTheGrid) at = nearest;
    if (!(at >= 0) || !(at <= static_cast<double>(size()) - 1)) return kNotMeasured;
    const auto before = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(before), value = static_cast<double>((*samples)[before]);
    return part == 0 ? value : value + part * (static_cast<double>((*samples)[before + 1]) - value);
}

TracePtr ShownCapture::trace(const QString& key) const {
    return firstWhere(traces, [&](const Trace& trace) { return trace.key == key; });
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

ShownPtr prepareCapture(std::shared_ptr<const Capture> capture, const MathOptions& math) {
    auto shown = std::make_shared<ShownCapture>();
    shown->zero_s = std::isfinite(capture->trigger_s) ? capture->trigger_s : capture->start_s;
    auto measured = measureCapture(*capture);
    for (std::size_t c = 0; c < capture->channels.size(); ++c) {
        shown->traces.push_back(channelTrace(capture, c, measured.channels[c], shown->zero_s));
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

namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

TracePtr calculated(const char* key, const char* letter, const QString& title, const QString& unit,
                    std::vector<float> samples, const Trace& like) {
    auto trace = makeTrace(key, title, unit, std::make_shared<const std::vector<float>>(std::move(samples)),
                           like.rate_hz, like.start_s, like.zero_s);
    trace->letter = letter;
    return trace;
}

}  // namespace

TracePtr powerTrace(const Trace& volts, const Trace& amps) {
    const std::size_t n = std::min(volts.size(), amps.size());
    std::vector<float> power(n);
    std::transform(volts.samples->begin(), volts.samples->begin() + static_cast<std::ptrdiff_t>(n),
                   amps.samples->begin(), power.begin(), std::multiplies<>());
    return calculated("math/power", "P", QObject::tr("Power"), "W", std::move(power), volts);
}

TracePtr chargeTrace(const Trace& amps) {
    std::vector<float> charge(amps.size());
    double sum = 0;
    float before = kMissing;
    for (std::size_t i = 0; i < charge.size(); ++i) {
        const float now = (*amps.samples)[i];
        if (std::isnan(now)) {
            charge[i] = kMissing;
        } else {
            sum = std::isnan(before) ? 0 : sum + 0.5 * (static_cast<double>(before) + static_cast<double>(now));
            charge[i] = static_cast<float>(sum / amps.rate_hz);
        }
        before = now;
    }
    return calculated("math/charge", "Q", QObject::tr("Charge"), "C", std::move(charge), amps);
}

TracePtr differenceTrace(const Trace& a, const Trace& b) {
    std::vector<float> difference(a.size(), kMissing);
    const auto last = static_cast<double>(b.size()) - 1;
    // Two records with separate triggers are aligned at their triggers.
    const double offset = ((a.start_s - a.zero_s) - (b.start_s - b.zero_s)) * b.rate_hz;
    const double step = b.rate_hz / a.rate_hz;
    for (std::size_t i = 0; i < difference.size(); ++i) {
        const double at = offset + static_cast<double>(i) * step;
        if (at < -1e-6 || at > last + 1e-6) continue;
        const double whole = std::clamp(std::floor(at), 0.0, last);
        const auto k = static_cast<std::size_t>(whole);
        const double part = std::clamp(at - whole, 0.0, 1.0);
        const double here = static_cast<double>((*b.samples)[k]);
        const double next = part < 1e-6 ? here : static_cast<double>((*b.samples)[std::min(k + 1, b.size() - 1)]);
        difference[i] = static_cast<float>(static_cast<double>((*a.samples)[i]) - (here + part * (next - here)));
    }
    return calculated("math/difference", "Δ", QObject::tr("%1 − %2").arg(a.title, b.title), a.unit,
                      std::move(difference), a);
}

void addMath(std::vector<TracePtr>& traces, const MathOptions& math) {
    const auto in = [&](const char* unit) {
        return firstWhere(traces, [&](const Trace& trace) { return trace.unit == unit; });
    };
    const auto called = [&](const QString& key) {
        return firstWhere(traces, [&](const Trace& trace) { return trace.key == key; });
    };
    const auto volts = in("V"), amps = in("A");
    std::vector<TracePtr> more;
    if (math.power && volts && amps) more.push_back(powerTrace(*volts, *amps));
    if (math.charge && amps) more.push_back(chargeTrace(*amps));
    const auto minuend = called(math.minuend);
    const auto subtrahend = math.reference ? math.reference : called(math.subtrahend);
    if (minuend && subtrahend && minuend->unit == subtrahend->unit && subtrahend->size() > 0)
        more.push_back(differenceTrace(*minuend, *subtrahend));
    traces.insert(traces.end(), more.begin(), more.end());
}

namespace {

/// Returns the edge with the smallest `distanceTo(edge)` below `reach`, or `otherwise` if there is none.
template <class Distance>
double nearestEdge(const std::vector<TraceSpan>& spans, double otherwise, double reach, Distance distanceTo) {
    double best = otherwise;
    for (const auto& span : spans) {
        const double shift = span.key_s - span.trace->start_s;
        for (const auto& edge : span.trace->edges) {
            for (const double at : {edge.onset_s + shift, edge.end_s + shift}) {
                const double distance = distanceTo(at);
                if (!(distance < reach)) continue;
                reach = distance;
                best = at;
            }
        }
    }
    return best;
}

}  // namespace

double snappedToEdge(const std::vector<TraceSpan>& spans, double time_s, double reach_s) {
    return nearestEdge(spans, time_s, reach_s, [&](double at) { return std::abs(at - time_s); });
}

double nextEdge(const std::vector<TraceSpan>& spans, double time_s, double direction, double least_s) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return nearestEdge(spans, time_s, kInfinity, [&](double at) {
        const double away = (at - time_s) * direction;
        return away > least_s ? away : kInfinity;
    });
}

namespace {

/// Returns onset and end of the pulse, or of the phase, with the onset nearest to `time_s` of those that are `wanted`.
template <class Wanted>
std::optional<std::pair<double, double>> nearestPulse(const std::vector<TraceSpan>& spans, double time_s, bool phases,
                                                      Wanted wanted) {
    std::optional<std::pair<double, double>> nearest;
    for (const auto& span : spans) {
        const auto& edges = span.trace->edges;
        const double shift = span.key_s - span.trace->start_s;
        for (auto edge = edges.begin(); edge != edges.end(); ++edge) {
            if (!edge->leading && !phases) continue;
            const auto second = std::next(edge);
            const bool biphasic = !phases && second != edges.end() && !second->leading;
            const std::pair its{edge->onset_s + shift, (biphasic ? second->end_s : edge->end_s) + shift};
            if (nearest && std::abs(its.first - time_s) >= std::abs(nearest->first - time_s)) continue;
            if (wanted(its)) nearest = its;
        }
    }
    return nearest;
}

}  // namespace

std::optional<std::pair<double, double>> pulseNear(const std::vector<TraceSpan>& spans, double time_s) {
    return nearestPulse(spans, time_s, false, [](const auto&) { return true; });
}

std::optional<std::pair<double, double>> pulseWithin(const std::vector<TraceSpan>& spans, double from_s, double to_s,
                                                     double time_s) {
    const auto inSight = [&](const auto& its) { return its.first >= from_s && its.second <= to_s; };
    const auto pulse = nearestPulse(spans, time_s, false, inSight);
    return pulse ? pulse : nearestPulse(spans, time_s, true, inSight);
}

std::optional<EdgeReading> edgesAround(const std::vector<TraceSpan>& spans, double time_s) {
    for (const auto& span : spans) {
        const auto& edges = span.trace->edges;
        const double shift = span.key_s - span.trace->start_s;
        const double t = time_s - shift;
        if (edges.empty() || t < edges.front().onset_s || t > edges.back().end_s) continue;
        const auto after = std::upper_bound(edges.begin(), edges.end(), t,
                                            [](double at, const PhaseEdges& e) { return at < e.onset_s; });
        const auto& phase = *std::prev(after);
        const bool inside = t <= phase.end_s;
        if (!inside && after == edges.end()) continue;
        EdgeReading read;
        read.from_s = (inside ? phase.onset_s : phase.end_s) + shift;
        read.to_s = (inside ? phase.end_s : after->onset_s) + shift;
        read.text =
            (inside ? QObject::tr("Width %1") : QObject::tr("Rest %1")).arg(quantityText(read.to_s - read.from_s, "s"));
        // The interval runs from the last leading edge before the moment to the next leading edge.
        auto before = std::prev(after);
        while (before != edges.begin() && !before->leading) --before;
        const auto next = std::find_if(after, edges.end(), [](const PhaseEdges& e) { return e.leading; });
        if (next != edges.end() && before->leading) {
            const double interval = next->onset_s - before->onset_s;
            read.text +=
                QObject::tr(" · interval %1 (%2)").arg(quantityText(interval, "s"), quantityText(1 / interval, "Hz"));
        }
        return read;
    }
    return {};
}

}  // namespace tacto::gui
