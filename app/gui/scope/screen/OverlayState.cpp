#include "app/gui/scope/screen/OverlayState.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "app/gui/scope/screen/LaneLegend.h"
#include "app/gui/theme/Theme.h"
#include "app/report/NumberText.h"

namespace tacto::gui {

namespace {

/// Returns the outline of a train: time 0 is its leading edge, with a short rest before and after it.
std::vector<QPointF> linesOf(const PulseTrain& train, double perVolt, const LaneScale& scale) {
    const double rest_s = 0.03 * train.pulseDuration().count();
    const double zero = scale.heightOf(0);
    std::vector<QPointF> line{{-rest_s, zero}};
    for (int pulse = 0; pulse < train.pulses; ++pulse) {
        double at_s = pulse / train.rate.value();
        line.emplace_back(at_s, zero);
        for (const auto& phase : segmentsOf(train, GapState::HoldsZero).span()) {
            const double height = scale.heightOf(phase.start * perVolt);
            line.emplace_back(at_s, height);
            at_s += phase.duration_s;
            line.emplace_back(at_s, height);
        }
        line.emplace_back(at_s, zero);
    }
    line.emplace_back(line.back().x() + rest_s, zero);
    return line;
}

void fillDrawn(const ScopeModel& model, OverlayState& o) {
    constexpr int kColumns = 300;
    const auto& view = model.viewport();
    const double column_s = view.width_s() / kColumns;
    for (const auto& lane : model.lanes()) {
        if (!lane.shown || lane.reference() || lane.spans.empty()) continue;
        const auto scale = model.scaleOf(lane);
        const auto& span = lane.spans.back();
        const auto& trace = *span.trace;
        const auto sample = [&](double time_s) {
            return static_cast<std::size_t>(
                std::clamp((time_s - span.key_s) * trace.rate_hz, 0.0, static_cast<double>(trace.size())));
        };
        for (int column = 0; column < kColumns; ++column) {
            const double from_s = view.left_s + column * column_s, to_s = from_s + column_s;
            if (to_s < span.key_s || from_s > span.key_s + span.length_s()) continue;
            // Takes one more sample on each side, because the line to that sample is drawn as well.
            const auto its = trace.pyramid.over(sample(from_s), std::min(sample(to_s) + 2, trace.size()));
            if (its.empty()) continue;
            o.drawn.push_back({from_s, to_s, scale.heightOf(static_cast<double>(its.low)),
                               scale.heightOf(static_cast<double>(its.high))});
        }
    }
    for (const auto& coming : o.coming) {
        for (std::size_t i = 1; i < coming.line.size(); ++i) {
            const auto &from = coming.line[i - 1], &to = coming.line[i];
            o.drawn.push_back({from.x(), to.x(), std::min(from.y(), to.y()), std::max(from.y(), to.y())});
        }
    }
}

void fillComing(const ScopeModel& model, OverlayState& o) {
    const auto coming = model.coming();
    if (!coming) return;
    const double volts = std::get<Volts>(coming->train.amplitude).value();
    const std::pair<QString, std::optional<double>> kinds[] = {
        {"V", 1.0}, {"A", coming->impedance_ohm ? std::optional(1 / *coming->impedance_ohm) : std::nullopt}};
    for (const auto& [unit, perVolt] : kinds) {
        const auto* lane = model.lane(model.channelIn(unit));
        if (lane == nullptr || !lane->shown || !perVolt) continue;
        OverlayState::Coming line;
        line.colour = laneInk(model, *lane);
        line.line = linesOf(coming->train, *perVolt, model.scaleOf(*lane));
        const auto level = quantityText(volts * *perVolt, unit == "V" ? "V" : "A", 3);
        line.text = unit == "V" ? (coming->asked ? QObject::tr("next train %1") : QObject::tr("by hand: %1")).arg(level)
                                : QObject::tr("%1 at %2").arg(level, quantityText(*coming->impedance_ohm, "ohm", 3));
        o.coming.push_back(std::move(line));
    }
}

void fillCursors(const ScopeModel& model, OverlayState& o) {
    const auto& cursors = model.cursors();
    const auto read = model.readout();
    const double rate_hz = model.shown() ? model.shown()->capture->rate_hz : 0;
    o.focusedCursor = cursors.focused();
    if (const auto& times = cursors.time_s()) {
        o.timeCursors_s.assign(times->begin(), times->end());
        o.timeSpan = spanText(read, rate_hz);
        for (const auto& [name, time_s] :
             {std::pair(QObject::tr("t₁"), read.x1_s), std::pair(QObject::tr("t₂"), read.x2_s)}) {
            o.flags.push_back({name, quantityText(knownTime(time_s, rate_hz), "s"), {}});
        }
        for (const auto& value : model.cursorValues()) {
            const auto& lane = *model.lane(value.lane);
            for (std::size_t i = 0; i < 2; ++i) {
                const auto& at = value.at[i];
                auto text = levelText(at.value, lane.unit);
                if (at.slope != 0) text += at.slope > 0 ? QStringLiteral(" ↑") : QStringLiteral(" ↓");
                o.flags[i].rows.push_back({lane.letter, text, laneInk(model, lane)});
            }
        }
    }
    if (cursors.time_s()) fillDrawn(model, o);
    const auto* active = model.lane(model.activeLane());
    if (active == nullptr || !cursors.level()) return;
    for (const double level : *cursors.level()) {
        o.levelCursors.push_back(model.scaleOf(*active).heightOf(level));
        o.levelTexts.push_back(
            (o.levelTexts.empty() ? QObject::tr("y₁ %1") : QObject::tr("y₂ %1")).arg(levelText(level, active->unit)));
    }
    o.levelSpan = QObject::tr("Δ %1").arg(levelText(read.dy(), active->unit));
    // The text between the time cursors avoids these lines, too.
    const auto& view = model.viewport();
    for (const double height : o.levelCursors) o.drawn.push_back({view.left_s, view.right_s(), height, height});
}

void fillTrigger(const ScopeModel& model, OverlayState& o) {
    const auto& trigger = model.trigger();
    const bool triggered = model.shown() && !model.roll() && std::isfinite(model.shown()->capture->trigger_s);
    if (triggered || trigger.moment_s()) {
        o.trigger = OverlayState::Trigger{};
        o.trigger->moment_s = trigger.moment_s().value_or(0);
        o.trigger->colour = colours().quiet;
    }
    if (const auto* source = model.lane(trigger.lane()); source != nullptr && source->shown) {
        if (!o.trigger) o.trigger = OverlayState::Trigger{};
        const auto scale = model.scaleOf(*source);
        const auto& its = trigger.its();
        o.trigger->height = scale.heightOf(its.level);
        if (its.kind == TriggerKind::Runt) o.trigger->other = scale.heightOf(its.upper);
        if (its.kind == TriggerKind::Width) {
            const double now_s = o.trigger->moment_s.value_or(0);
            const double shorter = now_s - its.shortest_s, longer = now_s - its.longest_s;
            constexpr double kEver_s = 1e9;  // longer than any record
            auto& began = o.trigger->began_s;
            if (its.widths == WidthRule::Inside) began = {{longer, shorter}};
            if (its.widths == WidthRule::Outside) began = {{now_s - kEver_s, longer}, {shorter, now_s}};
            if (its.widths == WidthRule::Less) began = {{longer, now_s}};
            if (its.widths == WidthRule::Greater) began = {{now_s - kEver_s, shorter}};
        }
        for (const double sign : {1.0, -1.0}) {
            if (!searched(its.kind) || !(its.hysteresis > 0)) break;
            if (its.edge == (sign > 0 ? TriggerEdge::Falling : TriggerEdge::Rising)) continue;
            const double from = its.kind == TriggerKind::Runt && sign < 0 ? its.upper : its.level;
            const auto [low, high] = std::minmax({from, from - sign * its.hysteresis});
            o.trigger->hysteresis.emplace_back(scale.heightOf(low), scale.heightOf(high));
        }
        o.trigger->colour = laneInk(model, *source);
        o.trigger->held = trigger.held();
    }
    if (o.trigger) o.trigger->text = trigger.text();
}

/// Fills in the unmeasured pulses of the active lane, or of the first lane.
void fillMarks(const ScopeModel& model, OverlayState& o) {
    if (o.lanes.empty()) return;
    const auto marked = std::find_if(o.lanes.begin(), o.lanes.end(), [](const auto& lane) { return lane.active; });
    const auto& from = marked == o.lanes.end() ? o.lanes.front() : *marked;
    const auto& view = model.viewport();
    for (const auto& span : model.lane(from.key)->spans) {
        if (span.key_s + span.length_s() < view.left_s || span.key_s > view.right_s()) continue;
        const double shift = span.key_s - span.trace->start_s;
        for (const auto& mark : span.trace->marks) {
            if (mark.to_s + shift < view.left_s || mark.from_s + shift > view.right_s()) continue;
            o.marks.push_back({mark.from_s + shift, mark.to_s + shift, mark.why, from.colour});
        }
    }
}

}  // namespace

OverlayState overlayOf(const ScopeModel& model) {
    OverlayState o;
    for (const auto& lane : model.lanes()) {
        if (lane.reference() || !lane.shown) continue;
        o.lanes.push_back({lane.key, lane.letter, laneInk(model, lane), model.scaleOf(lane).position,
                           lane.key == model.activeLane(), !o.lanes.empty() && lane.unit == "A"});
    }
    fillTrigger(model, o);
    fillComing(model, o);
    fillCursors(model, o);
    if (model.shown() && model.shown()->capture->untriggered) o.notes << QObject::tr("not triggered");
    if (model.held()) o.notes << QObject::tr("the last live train, held");
    if (model.shown() && model.shown()->averaged > 0)
        o.notes << QObject::tr("averaged %1").arg(model.shown()->averaged);
    if (const auto mark = model.markBeside(); !mark.isEmpty()) o.notes << mark;
    o.moments = model.marksOnAxis();
    o.hover = model.hovered();
    fillMarks(model, o);
    return o;
}

}  // namespace tacto::gui
