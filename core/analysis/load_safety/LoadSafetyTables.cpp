
#include <algorithm>
#include <cmath>

#include "core/analysis/load_safety/LoadSafetyRows.h"
#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"
#include "core/safety/SourceTraits.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

namespace {

const LoadRecord* recordAt(const LoadSafetyInput& input, double ohm) {
    for (const auto& record : input.loads) {
        if (record.load == Load::resistor(Ohms(ohm))) return &record;
    }
    return nullptr;
}

/// The device's largest relative deviations from the command over all measured steps.
struct Made {
    Reading amplitude{1, 0, 0}, width{1, 0, 0}, rate{1, 0, 0}, interval{1, 0, 0};
    bool measured = false;
};
/// A quantity that no step measured is unknown, not equal to the command.
Made madeOf(const LoadSafetyInput& input) {
    Made out;
    bool widthSeen = false, intervalSeen = false;
    bool rateSeen = input.train.pulses == 1;  // a single pulse has no rate to see
    // A single measured step without U makes the whole result unknown.
    const auto take = [](Reading& into, double value, const Reading& got, double scale, bool more) {
        if (std::isnan(got.value)) return;
        const double expanded = scale * got.expanded;
        if (more) into.value = value;
        into.expanded = std::isnan(expanded) || std::isnan(into.expanded) ? kNaN : std::max(into.expanded, expanded);
    };
    const double width = Seconds(input.train.phaseWidth).count(), rate = input.train.rate.value();
    for (const auto& record : input.loads) {
        for (const auto& step : record.steps) {
            const auto& got = step.reading;
            take(out.amplitude, got.delivered.value, got.delivered, 1, got.delivered.value > out.amplitude.value);
            take(out.width, got.width_s.value / width, got.width_s, 1 / width,
                 got.width_s.value / width > out.width.value);
            take(out.rate, got.rate_hz.value / rate, got.rate_hz, 1 / rate, got.rate_hz.value / rate > out.rate.value);
            take(out.interval, got.interval_s.value / step.interval_s, got.interval_s, 1 / step.interval_s,
                 got.interval_s.value / step.interval_s < out.interval.value);
            out.measured = out.measured || !std::isnan(got.delivered.value);
            widthSeen = widthSeen || !std::isnan(got.width_s.value);
            rateSeen = rateSeen || !std::isnan(got.rate_hz.value);
            intervalSeen = intervalSeen || !std::isnan(got.interval_s.value);
        }
    }
    if (!widthSeen) out.width.expanded = kNaN;
    if (!rateSeen) out.rate.expanded = kNaN;
    if (!intervalSeen) out.interval.expanded = kNaN;
    return out;
}

/// Multipliers of the command and the area; each is raised by its U in turn.
struct Factors {
    double amplitude = 1, width = 1, rate = 1, interval = 1, area = 1;
};

/// Computes the exposure in `load` at `command_v`; a current source is programmed to A / |Z|.
TrainExposure exposureAt(const LoadSafetyInput& input, const Load& load, double command_v, const Factors& factors) {
    double amplitude = factors.amplitude * command_v;
    if (input.source.drive == Drive::Current) {
        LoadRecord record;
        record.load = load;
        amplitude *= 1e3 / expectedOhms(record, input);
    }
    PulseTrain train = trainAt(input.train, input.source.drive, amplitude);
    train.phaseWidth = Micros(factors.width * train.phaseWidth.count());
    train.rate = Hertz(factors.rate * train.rate.value());
    const double area = input.area_cm2 ? *input.area_cm2 * factors.area : kNaN;
    return exposureOf(train, Seconds(input.interval_s * factors.interval), load, input.source, area);
}

/// A load for the extrapolation, with the command given on it.
struct Place {
    Load load;
    double command_v = 0;
};

/// Highest value of one quantity over all places. Each factor's U is applied alone; the changes add in quadrature.
Reading extrapolate(const LoadSafetyInput& input, const std::vector<Place>& places, const Made& made,
                    Quantity quantity) {
    const auto worstAt = [&](const Factors& factors) {
        double most = 0;
        for (const auto& place : places) {
            const double value = exposureAt(input, place.load, place.command_v, factors).at(quantity);
            if (std::isnan(value)) return kNaN;
            most = std::max(most, value);
        }
        return most;
    };
    // A train that jitters across a window's edge does not add a whole train (as in LoadReading).
    const auto beyondTheEdge = [&](double shorter) {
        constexpr double kLongestWindow_s = 5, kEdge = 0.01;
        return shorter * kLongestWindow_s / input.interval_s > kEdge ? shorter : 0;
    };
    const Factors nominal{made.amplitude.value, made.width.value, made.rate.value,
                          1 - beyondTheEdge(1 - made.interval.value), 1};
    const double value = worstAt(nominal);
    double squares = 0;
    const auto add = [&](double Factors::*factor, double expanded) {
        Factors off = nominal;
        off.*factor += expanded;
        const double change = std::isnan(expanded) ? kNaN : worstAt(off) - value;
        squares += change * change;
    };
    add(&Factors::amplitude, made.amplitude.expanded);
    add(&Factors::width, made.width.expanded);
    add(&Factors::rate, made.rate.expanded);
    const double shorter = made.interval.expanded;
    add(&Factors::interval, std::isnan(shorter) ? kNaN : -beyondTheEdge(shorter));
    if (needsArea(quantity)) add(&Factors::area, -input.tolerances.area_pct / 100);
    return {value, std::sqrt(squares) / 2, std::sqrt(squares)};
}

SafetyRow rowOf(const LimitSet& set, const LimitRow& limit, std::string_view title) {
    SafetyRow row;
    row.item = keyOf(limit.quantity);
    row.title = title;
    row.unit = unitOf(limit.quantity);
    row.limit = limit.max;
    row.set = set.id;
    row.source = limit.source;
    return row;
}

SafetyRow extrapolated(const LoadSafetyInput& input, const std::string& range, const LimitSet& set,
                       const LimitRow& limit, const Reading& most) {
    auto row = rowOf(set, limit, titleOf(limit.quantity));
    row.load = limit.judged == JudgedAt::Ohm500 ? "500 ohm, extrapolated" : range;
    row.basis = RowBasis::Computed;
    row.value = most.value;
    row.expanded = most.expanded;
    row.verdict = judgeUpper(row.value, row.expanded, limit.max, limit.strict);
    if (row.verdict == RowVerdict::NotEvaluated) {
        row.reason = fmt::format("{} over {} was not evaluated: {}", row.title, row.load,
                                 needsArea(limit.quantity) && !input.area_cm2 ? "the electrode's area is not known"
                                 : std::isnan(row.value)                      ? "it cannot be computed"
                                                         : "the uncertainty of what it is computed from is not known");
    } else if (row.verdict != RowVerdict::Pass) {
        const bool near = row.verdict == RowVerdict::Indeterminate;
        if (limit.action != LimitAction::Refuse) row.verdict = RowVerdict::Attention;
        row.reason = fmt::format("{} over {} comes to {}, {} {}", row.title, row.load,
                                 measuredText(row.value, row.expanded, row.unit),
                                 near ? "too close to tell from" : "above", exactText(limit.max, row.unit));
    }
    return row;
}

}  // namespace

LoadReading strongestOf(const LoadRecord& record) {
    LoadReading most;
    bool first = true;
    const auto take = [&first](Reading& into, const Reading& from) {
        if (first || std::isnan(from.value) || (!std::isnan(into.value) && from.value > into.value)) into = from;
    };
    for (const auto& step : record.steps) {
        const auto& reading = step.reading;
        for (const auto member :
             {&LoadReading::delivered, &LoadReading::amplitude_v, &LoadReading::highest_v, &LoadReading::amplitude_ma,
              &LoadReading::width_s, &LoadReading::rate_hz, &LoadReading::peak_v, &LoadReading::peak_ma,
              &LoadReading::charge_uc, &LoadReading::net_charge_uc, &LoadReading::imbalance, &LoadReading::energy_mj,
              &LoadReading::rms_train_ma, &LoadReading::rms_1s_ma, &LoadReading::rms_5s_ma, &LoadReading::rms_5s_v,
              &LoadReading::dc_ma, &LoadReading::power_1s_w}) {
            take(most.*member, reading.*member);
        }
        most.trains = first ? reading.trains : std::min(most.trains, reading.trains);  // smallest number of all steps
        first = false;
    }
    if (!record.steps.empty()) most.interval_s = record.steps.back().reading.interval_s;
    return most;
}

std::vector<SafetyRow> tripRows(const LoadSafetyInput& input) {
    std::vector<SafetyRow> rows;
    for (const auto name : kRequiredTrips) {
        SafetyRow row;
        for (const std::string_view load : {"open", "short"})
            if (name.starts_with(load)) row.load = load;
        row.item = "trip";
        row.title = fmt::format("trip: {}", name);
        row.set = "interlock";
        row.source = name == "dead-man" ? "safety.md, hazard H2" : "safety.md, hazard H3";
        const auto made = std::find_if(input.trips.begin(), input.trips.end(),
                                       [&](const TripTrial& trial) { return trial.name == name; });
        if (made == input.trips.end()) {
            row.reason = fmt::format("the trip \"{}\" was not tried", name);
        } else if (!made->evaluated) {
            row.reason = fmt::format("the trip \"{}\" was not evaluated: {}", name, made->reason);
        } else {
            row.value = made->after_s;
            row.unit = std::isfinite(made->after_s) ? "s" : "";
            row.verdict = made->tripped ? RowVerdict::Pass : RowVerdict::Fail;
            if (!made->tripped) row.reason = fmt::format("\"{}\" did not end the output: {}", name, made->reason);
            if (made->tripped && std::isfinite(made->stop_s) && made->allowed_s > 0) {
                row.stop_s = made->stop_s;
                row.allowed_s = made->allowed_s;
                row.note = fmt::format("ended within {} of the train that found it; the next was due after {}",
                                       scaledText(made->stop_s, "s", 2), scaledText(made->allowed_s, "s", 3));
            }
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<SafetyRow> openCircuitRows(const LoadSafetyInput& input) {
    std::vector<SafetyRow> rows;
    for (const auto& set : input.limits) {
        for (const auto& limit : set.rows) {
            if (limit.quantity != Quantity::PeakVoltage) continue;
            auto row = rowOf(set, limit, "peak voltage on the open circuit");
            row.load = "open";
            std::string missing = "no train into an open circuit was captured";
            if (input.openCircuit) {
                const auto& reading = input.openCircuit->reading;
                row.value = reading.peak_v.value;
                row.expanded = reading.peak_v.expanded;
                row.note = fmt::format("at {:.4g} V commanded", input.openCircuit->command_v);
                if (std::isfinite(row.value)) missing = reading.notStated;
                if (std::isnan(row.value) && !reading.warnings.empty()) missing = reading.warnings.front();
            }
            row.verdict = judgeUpper(row.value, row.expanded, limit.max, limit.strict);
            if (row.verdict == RowVerdict::NotEvaluated) {
                row.reason = fmt::format("{} was not evaluated: {}", row.title, missing);
            } else if (row.verdict != RowVerdict::Pass) {
                row.reason = fmt::format("{} is {}; {} are allowed", row.title,
                                         measuredText(row.value, row.expanded, "V"), exactText(limit.max, "V"));
            }
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

LoadWorstCase worstCaseOf(const LoadSafetyInput& input) {
    LoadWorstCase out;
    out.low_ohm = input.loadLow.value();
    out.high_ohm = input.loadHigh.value();
    auto range = fmt::format("{:g} to {:g} ohm", out.low_ohm, out.high_ohm);
    const auto made = madeOf(input);
    if (!made.measured) return out;
    out.amplitudeFactor = made.amplitude;
    std::vector<Place> overRange{{Load::resistor(Ohms(out.low_ohm)), input.command_v},
                                 {Load::resistor(Ohms(out.high_ohm)), input.command_v}};
    const std::vector<Place> at500{{Load::resistor(Ohms(500)), input.command_v}};
    // On the skin equivalent: the strongest command that the limits allow; stronger commands are refused.
    for (const auto& record : input.loads) {
        if (record.load.kind != LoadKind::SkinEquivalent || record.steps.empty()) continue;
        double most = 0;
        for (const auto& step : record.steps) most = std::max(most, step.command_v);
        overRange.push_back({record.load, most});
        range += " and " + record.name;
    }
    std::vector<RowVerdict> verdicts;
    for (const auto& set : input.limits) {
        for (const auto& limit : set.rows) {
            // A limit on the command does not depend on what the device delivers.
            if (limit.quantity == Quantity::CommandVoltage || !limit.holdsAt(1 / input.interval_s)) continue;
            // The voltage is highest on the open circuit, where it is measured: openCircuitRows().
            if (limit.quantity == Quantity::PeakVoltage) continue;
            const auto& places = limit.judged == JudgedAt::Ohm500 ? at500 : overRange;
            out.rows.push_back(
                extrapolated(input, range, set, limit, extrapolate(input, places, made, limit.quantity)));
            verdicts.push_back(out.rows.back().verdict);
        }
    }
    out.verdict = summaryOf(verdicts);
    return out;
}

std::vector<DisclosedOutput> disclosedOf(const LoadSafetyInput& input) {
    std::vector<DisclosedOutput> rows;
    const auto add = [&](const char* output, double ohm, Quantity quantity, const char* load) {
        DisclosedOutput row;
        row.output = output;
        row.load = load;
        row.unit = unitOf(quantity);
        const auto* record = recordAt(input, ohm);
        if (record == nullptr || record->steps.empty()) {
            row.reason = "not measured";
        } else if (needsArea(quantity) && !input.area_cm2) {
            row.reason = "the electrode's area is not known";
        } else {
            const auto most = readingOf(strongestOf(*record), quantity, input);
            if (!std::isnan(most.value)) {
                row.value = most.value;
                row.expanded = most.expanded;
                if (most.value > row.expanded) row.expanded_pct = 100 * row.expanded / most.value;
            } else {
                row.reason = "not measured";
            }
        }
        rows.push_back(std::move(row));
    };
    const struct {
        double ohm;
        const char* name;
    } loads[] = {{500, "500 ohm"}, {2000, "2 kohm"}, {10'000, "10 kohm"}};
    for (const auto& at : loads) add("maximum output voltage", at.ohm, Quantity::PeakVoltage, at.name);
    for (const auto& at : loads) add("maximum output current", at.ohm, Quantity::PeakCurrent, at.name);
    add("maximum phase charge", 500, Quantity::PhaseCharge, "500 ohm");
    add("net charge per pulse", 500, Quantity::NetCharge, "500 ohm");
    for (const auto& at : loads) add("maximum RMS current over 5 s", at.ohm, Quantity::RmsCurrent5s, at.name);
    add("maximum current density (RMS over 5 s)", 500, Quantity::CurrentDensity, "500 ohm");
    add("maximum power density (over 1 s)", 500, Quantity::PowerDensity, "500 ohm");
    return rows;
}

}  // namespace tacto
