#include "app/gui/scope/model/ScopeCursors.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

constexpr double kEdgeShare = 0.1;  ///< least change over four samples on an edge, as a share of the whole step

CursorValue::At valueOf(const Trace& trace, double time_s) {
    const double at = (time_s - trace.start_s) * trace.rate_hz;
    const auto last = static_cast<double>(trace.size()) - 1;
    if (!(at >= 0) || !(at <= last)) return {};
    const auto sample = [&](double index) {
        return static_cast<double>((*trace.samples)[static_cast<std::size_t>(std::clamp(index, 0.0, last))]);
    };
    CursorValue::At read;
    read.value = trace.valueAt(time_s);
    if (trace.levels.size() < 2) return read;
    const auto [low, high] = std::minmax_element(trace.levels.begin(), trace.levels.end());
    const double change = sample(std::round(at) + 2) - sample(std::round(at) - 2);
    if (std::abs(change) > kEdgeShare * (*high - *low)) read.slope = change > 0 ? 1 : -1;
    return read;
}

}  // namespace

void ScopeCursors::showTime(const Viewport& view, const std::optional<std::pair<double, double>>& at_s) {
    time_s_ = {view.left_s + view.width_s() * 0.3, view.left_s + view.width_s() * 0.7};
    if (at_s) time_s_ = {at_s->first, at_s->second};
    focused_ = 0;
}

void ScopeCursors::hideTime() {
    time_s_.reset();
    if (focused_ < 2) focused_ = level_ ? 2 : kNone;
}

void ScopeCursors::showLevel(const LaneScale& scale, const std::optional<std::pair<double, double>>& at) {
    constexpr double kFarthest = kHalfUp - 0.5;
    level_ = {scale.levelAt(std::max(-kFarthest, scale.position - 1)),
              scale.levelAt(std::min(kFarthest, scale.position + 1))};
    const auto onScreen = [&](double level) { return std::abs(scale.heightOf(level)) <= kHalfUp; };
    if (at && onScreen(at->first) && onScreen(at->second)) level_ = {at->first, at->second};
    focused_ = 2;
}

void ScopeCursors::hideLevel() {
    level_.reset();
    if (focused_ >= 2) focused_ = time_s_ ? 0 : kNone;
}

void ScopeCursors::focus(int cursor) {
    if (cursor < 0 || cursor > 3 || !(cursor < 2 ? time_s_.has_value() : level_.has_value())) return;
    focused_ = cursor;
}

void ScopeCursors::changeLane(const LaneScale& before, const LaneScale& after) {
    if (!level_) return;
    for (auto& level : *level_) level = after.levelAt(before.heightOf(level));
}

CursorReadout ScopeCursors::readout(const ScopeLane& active) const {
    CursorReadout r;
    r.unit = active.unit;
    if (time_s_) {
        r.x1_s = (*time_s_)[0];
        r.x2_s = (*time_s_)[1];
        for (const auto& span : active.spans) {
            const double shift = span.trace->start_s - span.key_s;
            const double a = span.trace->valueAt(r.x1_s + shift), b = span.trace->valueAt(r.x2_s + shift);
            if (!std::isnan(a)) r.at1 = a;
            if (!std::isnan(b)) r.at2 = b;
        }
    }
    if (level_) {
        r.y1 = (*level_)[0];
        r.y2 = (*level_)[1];
    }
    return r;
}

std::vector<CursorValue> ScopeCursors::values(const std::vector<ScopeLane>& lanes) const {
    std::vector<CursorValue> values;
    if (!time_s_) return values;
    for (const auto& lane : lanes) {
        if (!lane.shown || lane.reference()) continue;
        CursorValue value{lane.key, {}};
        for (const auto& span : lane.spans) {
            for (std::size_t i = 0; i < 2; ++i) {
                const auto read = valueOf(*span.trace, (*time_s_)[i] + span.trace->start_s - span.key_s);
                if (!std::isnan(read.value)) value.at[i] = read;
            }
        }
        values.push_back(std::move(value));
    }
    return values;
}

double knownTime(double time_s, double rate_hz) {
    // The time of an edge between two samples is known to a small part of the sample interval.
    constexpr double kTimeKnown = 0.02;
    if (!(rate_hz > 0)) return time_s;
    const double grain = std::pow(10, std::floor(std::log10(kTimeKnown / rate_hz)));
    return std::round(time_s / grain) * grain;
}

QString levelText(double level, const QString& unit) { return quantityText(level, unit, 3); }

QString spanText(const CursorReadout& readout, double rate_hz) {
    const double span_s = knownTime(readout.x2_s, rate_hz) - knownTime(readout.x1_s, rate_hz);
    return QObject::tr("Δ %1 · 1/Δ %2")
        .arg(quantityText(span_s, "s"), span_s == 0 ? "–" : quantityText(1 / std::abs(span_s), "Hz"));
}

QString readoutText(CursorReadout r, double rate_hz) {
    for (auto* t : {&r.x1_s, &r.x2_s}) *t = knownTime(*t, rate_hz);
    QStringList parts;
    if (std::isfinite(r.x1_s)) {
        parts << QObject::tr("t₁ %1").arg(quantityText(r.x1_s, "s"))
              << QObject::tr("t₂ %1").arg(quantityText(r.x2_s, "s"))
              << QObject::tr("Δ %1").arg(quantityText(r.dx_s(), "s"))
              << QObject::tr("1/Δ %1").arg(r.dx_s() == 0 ? "–" : quantityText(1 / std::abs(r.dx_s()), "Hz"));
        parts << QObject::tr("there %1 and %2").arg(levelText(r.at1, r.unit), levelText(r.at2, r.unit));
    }
    if (std::isfinite(r.y1)) {
        parts << QObject::tr("y₁ %1").arg(levelText(r.y1, r.unit)) << QObject::tr("y₂ %1").arg(levelText(r.y2, r.unit))
              << QObject::tr("Δ %1").arg(levelText(r.dy(), r.unit));
    }
    return parts.join(QStringLiteral("   "));
}

bool ScopeTrigger::set(const QString& lane, const SampleTrigger& its, bool held) {
    if (lane_ == lane && its_ == its && held_ == held) return false;
    if (levelDragged_ && !held) return false;
    lane_ = lane;
    its_ = its;
    held_ = held;
    return true;
}

bool ScopeTrigger::dragLevel(bool other, double height, const LaneScale& scale, const QString& unit) {
    if (held_) return false;
    // Rounds to whole hundredths of a division, because a level set by eye needs no more digits.
    const double grain = scale.perDivision / 100;
    levelDragged_ = true;
    const double level = std::round(scale.levelAt(height) / grain) * grain;
    (other ? its_.upper : its_.level) = level;
    text_ = (other ? QObject::tr("Not reaching %1") : QObject::tr("Trigger at %1")).arg(quantityText(level, unit, 3));
    return true;
}

double ScopeTrigger::fractionAt(double time_s, double length_s) const {
    return std::clamp(*fraction_ + time_s / length_s, 0.0, 1.0);
}

bool ScopeTrigger::dragMoment(double time_s, double length_s) {
    if (!fraction_) return false;
    const double chosen = fractionAt(time_s, length_s);
    moment_s_ = (chosen - *fraction_) * length_s;
    text_ = QObject::tr("%1 of the record before the trigger").arg(quantityText(100 * chosen, "%", 2));
    return true;
}

std::optional<double> ScopeTrigger::drop(double length_s) {
    levelDragged_ = false;
    text_.clear();
    const auto moment_s = std::exchange(moment_s_, std::nullopt);
    if (!moment_s || !fraction_) return {};
    fraction_ = fractionAt(*moment_s, length_s);
    return fraction_;
}

}  // namespace tacto::gui
