#include <cmath>
#include <limits>

#include "core/safety/GateState.h"
#include "core/safety/Rules.h"

namespace tacto::gate {

namespace {
/// A train and one limit.
struct TrainAtLimit {
    const State& state;
    const JudgedTrain& train;
    const ActiveLimit& limit;
    const ExposureMeter::Sums* window = nullptr;  // sums over the window including the train; null: the train alone

    [[nodiscard]] bool judged() const noexcept {
        if (limit.row.action != LimitAction::Refuse) return false;
        return !(needsArea(limit.row.quantity) && std::isnan(state.area));  // shown as "not evaluated"
    }
    [[nodiscard]] double valueAlone() const noexcept {
        const bool into500 = limit.row.judged == JudgedAt::Ohm500;
        return (into500 ? train.at500 : train.overRange).at(limit.row.quantity);
    }
    [[nodiscard]] double valueInWindow() const noexcept {
        const bool into500 = limit.row.judged == JudgedAt::Ohm500;
        return windowedValue(limit.row.quantity, into500 ? window->at500 : window->overRange, state.area);
    }
};

/// Returns the set's title and the limit's source; only the source if this begins with the title.
std::string originOf(const State& state, const ActiveLimit& limit) {
    const auto title = titleOf(state.setup->limits, limit.set.view());
    const std::string source(limit.row.source);
    return limit.ceiling || source.starts_with(title) ? source : fmt::format("{}; {}", title, source);
}

tl::unexpected<Error> refused(const TrainAtLimit& t, double value, const std::string& aside) {
    const LimitRow& row = t.limit.row;
    return fail(ErrorCode::LimitExceeded, "{} would be {:.4g} {}{}; {} {:.6g} {} is allowed ({})",
                titleOf(row.quantity), value, unitOf(row.quantity), aside, row.strict ? "less than" : "at most",
                row.max, unitOf(row.quantity), originOf(t.state, t.limit));
}

bool holdsAlone(const TrainAtLimit& t) { return t.judged() && t.train.fallsUnder(t.limit.row); }

bool breaksAlone(const TrainAtLimit& t) {
    return holdsAlone(t) && !keepsLimit(t.limit.row, t.valueAlone(), t.state.commandIsComputed());
}

tl::unexpected<Error> refusedAlone(const TrainAtLimit& t) {
    const LimitRow& row = t.limit.row;
    std::string aside;
    if (row.judged == JudgedAt::Ohm500) {
        aside = " into 500 ohm";
    } else if (row.quantity != Quantity::CommandVoltage) {  // the command voltage does not depend on the case
        const State& s = t.state;
        const Load& usual = s.person() ? s.load.nominal : s.setup->load.nominal;
        const auto there =
            exposureOf(t.train.command, t.train.interval, usual, s.setup->source, s.area, {t.train.carried_V});
        aside = fmt::format(" in the worst case ({:.4g} {} into {})", there.at(row.quantity), unitOf(row.quantity),
                            usual.text());
    }
    return refused(t, t.valueAlone(), aside);
}

bool holdsInWindow(const TrainAtLimit& t) {
    // Trains of different rates share the window: every band that contains one of them applies.
    return t.judged() && (t.train.fallsUnder(t.limit.row) || t.limit.row.holdsAt(t.window->lowestHz));
}

bool breaksInWindow(const TrainAtLimit& t) {
    return holdsInWindow(t) && !keepsLimit(t.limit.row, t.valueInWindow(), false);
}

tl::unexpected<Error> refusedInWindow(const TrainAtLimit& t) {
    return refused(t, t.valueInWindow(), fmt::format(" with the {} trains before it", t.window->trains));
}

void note(NearestLimit& nearest, const ActiveLimit& limit, double value) noexcept {
    const double share = value / limit.row.max;
    if (!(share <= nearest.share)) nearest = {share, limit.row.quantity, limit.set};
}
}  // namespace

bool keepsLimit(const LimitRow& row, double value, bool commandComputed) noexcept {
    const bool computed = row.quantity == Quantity::CommandVoltage && commandComputed;
    return row.keeps(computed ? value * (1 - 1e-12) : value);
}

double areaOf(const GateSetup& setup) noexcept {
    return setup.electrodeArea ? setup.electrodeArea->value() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<ActiveLimit> activeLimits(const GateSetup& setup) {
    std::vector<ActiveLimit> limits;
    for (const auto& set : setup.limits) {
        for (const auto& row : set.rows) limits.push_back({row, std::string_view(set.id), false});
    }
    for (const auto& ceiling : setup.ceilings) {
        LimitRow row;
        row.quantity = ceiling.quantity;
        row.max = ceiling.max;
        row.source = "the profile's ceiling";
        row.confidence = Confidence::High;
        limits.push_back({row, "profile", true});
    }
    return limits;
}

Result<void> checkLimits(const State& state, JudgedTrain& train, Instant now) {
    for (const ActiveLimit& limit : state.limits) {
        const int id = limitCheck(limit.ceiling ? RequestCeiling : RequestLimit, limit.row.quantity);
        const Rule<TrainAtLimit> rule[] = {{id, breaksAlone, refusedAlone}};
        const TrainAtLimit at{state, train, limit};
        if (auto kept = judge(rule, at); !kept) return kept;
        if (holdsAlone(at)) note(train.nearest, limit, at.valueAlone());
    }
    auto second = state.meter.couldShare(Seconds(1), now, train.stretch);
    auto five = state.meter.couldShare(Seconds(5), now, train.stretch);
    second.overRange += train.overRange.in1s;
    second.at500 += train.at500.in1s;
    five.overRange += train.overRange.in5s;
    five.at500 += train.at500.in5s;
    for (const ActiveLimit& limit : state.limits) {
        const double window_s = windowOf(limit.row.quantity);
        if (window_s == 0) continue;
        const int id = limitCheck(limit.ceiling ? MeterCeiling : MeterLimit, limit.row.quantity);
        const Rule<TrainAtLimit> rule[] = {{id, breaksInWindow, refusedInWindow}};
        const TrainAtLimit at{state, train, limit, window_s == 1 ? &second : &five};
        if (auto kept = judge(rule, at); !kept) return kept;
        if (holdsInWindow(at)) note(train.nearest, limit, at.valueInWindow());
    }
    return {};
}

}  // namespace tacto::gate
