#include "app/gui/scope/model/TraceMath.h"

#include <QObject>
#include <algorithm>
#include <cmath>

namespace tacto::gui {

namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

TracePtr calculated(const char* key, const QString& title, const QString& unit, std::vector<float> samples,
                    const Trace& like) {
    return makeTrace(key, title, unit, std::make_shared<const std::vector<float>>(std::move(samples)), like.rate_hz,
                     like.start_s, like.zero_s);
}

TracePtr firstIn(const std::vector<TracePtr>& traces, const QString& unit) {
    const auto found = std::find_if(traces.begin(), traces.end(), [&](const TracePtr& t) { return t->unit == unit; });
    return found == traces.end() ? nullptr : *found;
}

TracePtr called(const std::vector<TracePtr>& traces, const QString& key) {
    const auto found = std::find_if(traces.begin(), traces.end(), [&](const TracePtr& t) { return t->key == key; });
    return found == traces.end() ? nullptr : *found;
}

}  // namespace

TracePtr powerTrace(const Trace& volts, const Trace& amps) {
    const std::size_t n = std::min(volts.size(), amps.size());
    std::vector<float> power(n);
    std::transform(volts.samples->begin(), volts.samples->begin() + static_cast<std::ptrdiff_t>(n),
                   amps.samples->begin(), power.begin(), std::multiplies<>());
    return calculated("math/power", QObject::tr("Power"), "W", std::move(power), volts);
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
    return calculated("math/charge", QObject::tr("Charge"), "C", std::move(charge), amps);
}

TracePtr differenceTrace(const Trace& a, const Trace& b) {
    std::vector<float> difference(a.size(), kMissing);
    const auto last = static_cast<double>(b.size()) - 1;
    // In two records with their own triggers, samples that belong together are equally far from them.
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
    return calculated("math/difference", QObject::tr("%1 − %2").arg(a.title, b.title), a.unit, std::move(difference),
                      a);
}

void addMath(std::vector<TracePtr>& traces, const MathOptions& math) {
    const auto volts = firstIn(traces, "V");
    const auto amps = firstIn(traces, "A");
    std::vector<TracePtr> more;
    if (math.power && volts && amps) more.push_back(powerTrace(*volts, *amps));
    if (math.charge && amps) more.push_back(chargeTrace(*amps));
    const auto minuend = called(traces, math.minuend);
    const auto subtrahend = math.reference ? math.reference : called(traces, math.subtrahend);
    if (minuend && subtrahend && minuend->unit == subtrahend->unit && subtrahend->size() > 0)
        more.push_back(differenceTrace(*minuend, *subtrahend));
    traces.insert(traces.end(), more.begin(), more.end());
}

}  // namespace tacto::gui
