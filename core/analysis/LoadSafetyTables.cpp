// Trips, the table of outputs to be stated, and the worst case over the permitted loads.
#include <algorithm>
#include <cmath>

#include "core/analysis/LoadSafetyRows.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

namespace {

const LoadRecord* recordAt(const LoadSafetyInput& input, double ohm) {
    for (const auto& record : input.loads) {
        if (record.load == Load::resistor(Ohms(ohm))) return &record;
    }
    return nullptr;
}

/// Of the measured steps: the larger of (measured + U) / commanded and 1. Nothing without a measured step.
std::optional<double> amplitudeFactor(const LoadSafetyInput& input) {
    std::optional<double> factor;
    for (const auto& record : input.loads) {
        for (const auto& step : record.steps) {
            const auto& got = step.reading.delivered;
            if (got.measured()) factor = std::max({1.0, factor.value_or(1.0), got.value + got.expanded()});
        }
    }
    return factor;
}

/// A resistor of `ohm` at the largest command times `factor`; a current source is told A / |Z|.
TrainExposure exposureAt(const LoadSafetyInput& input, double ohm, double factor) {
    PulseTrain train = input.train;
    if (input.source.drive == Drive::Current)
        train.amplitude = Milliamps(1e3 * factor * input.command_v / ohm);
    else
        train.amplitude = Volts(factor * input.command_v);
    const double area = input.area_cm2.value_or(std::numeric_limits<double>::quiet_NaN());
    return exposureOf(train, Seconds(input.interval_s), Load::resistor(Ohms(ohm)), input.source, area);
}

SafetyRow extrapolated(const LoadSafetyInput& input, const std::string& range, const LimitSet& set,
                       const LimitRow& limit, const TrainExposure& most) {
    SafetyRow row;
    row.load = limit.judged == JudgedAt::Ohm500 ? "500 ohm, extrapolated" : range;
    row.item = keyOf(limit.quantity);
    row.title = titleOf(limit.quantity);
    row.unit = unitOf(limit.quantity);
    row.limit = limit.max;
    row.set = set.id;
    row.source = limit.source;
    row.value = most.at(limit.quantity);
    row.expanded = 0;  // in the amplitude factor already
    row.verdict = judgeUpper(row.value, row.expanded, limit.max, limit.strict);
    if (row.verdict == RowVerdict::NotEvaluated) {
        row.reason = fmt::format("{} over {} was not evaluated: {}", row.title, row.load,
                                 needsArea(limit.quantity) && !input.area_cm2 ? "the electrode's area is not known"
                                                                              : "it cannot be computed");
    } else if (row.verdict == RowVerdict::Fail) {
        if (limit.action != LimitAction::Refuse) row.verdict = RowVerdict::Attention;
        row.reason = fmt::format("{} over {} comes to {:.4g} {}, above {:.4g} {}", row.title, row.load, row.value,
                                 row.unit, limit.max, row.unit);
    }
    return row;
}

}  // namespace

LoadReading strongestOf(const LoadRecord& record) {
    LoadReading most;
    bool first = true;
    const auto take = [&first](Reading& into, const Reading& from) {
        if (first || !from.measured() || (into.measured() && from.value > into.value)) into = from;
    };
    for (const auto& step : record.steps) {
        const auto& reading = step.reading;
        for (const auto member :
             {&LoadReading::delivered, &LoadReading::amplitude_v, &LoadReading::highest_v, &LoadReading::amplitude_ma,
              &LoadReading::width_s, &LoadReading::peak_v, &LoadReading::peak_ma, &LoadReading::charge_uc,
              &LoadReading::net_charge_uc, &LoadReading::imbalance, &LoadReading::energy_mj, &LoadReading::rms_train_ma,
              &LoadReading::rms_1s_ma, &LoadReading::rms_5s_ma, &LoadReading::rms_5s_v, &LoadReading::dc_ma,
              &LoadReading::power_1s_w}) {
            take(most.*member, reading.*member);
        }
        first = false;
    }
    if (!record.steps.empty()) most.interval_s = record.steps.back().reading.interval_s;
    return most;
}

std::vector<SafetyRow> tripRows(const LoadSafetyInput& input) {
    std::vector<SafetyRow> rows;
    for (const auto name : kRequiredTrips) {
        SafetyRow row;
        row.load = name == "open" || name == "short" ? name : "";
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
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

LoadWorstCase worstCaseOf(const LoadSafetyInput& input) {
    LoadWorstCase out;
    out.low_ohm = input.loadLow.value();
    out.high_ohm = input.loadHigh.value();
    const auto range = fmt::format("{:g} to {:g} ohm", out.low_ohm, out.high_ohm);
    const auto factor = amplitudeFactor(input);
    if (!factor) return out;
    out.amplitudeFactor = *factor;
    const auto overRange = worse(exposureAt(input, out.low_ohm, *factor), exposureAt(input, out.high_ohm, *factor));
    const auto at500 = exposureAt(input, 500, *factor);
    std::vector<RowVerdict> verdicts;
    for (const auto& set : input.limits) {
        for (const auto& limit : set.rows) {
            // A command is what it was, whatever the device makes of it.
            if (limit.quantity == Quantity::CommandVoltage || !limit.holdsAt(1 / input.interval_s)) continue;
            out.rows.push_back(
                extrapolated(input, range, set, limit, limit.judged == JudgedAt::Ohm500 ? at500 : overRange));
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
            const auto most = readingOf(strongestOf(*record), quantity, input.area_cm2);
            if (most.measured()) {
                row.value = most.value;
                row.expanded = most.expanded();
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
    add("maximum current density (RMS over 5 s)", 500, Quantity::CurrentDensity, "500 ohm");
    add("maximum power density (over 1 s)", 500, Quantity::PowerDensity, "500 ohm");
    return rows;
}

}  // namespace tacto
