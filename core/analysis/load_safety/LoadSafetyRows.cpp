#include "core/analysis/load_safety/LoadSafetyRows.h"

#include <algorithm>
#include <cmath>

#include "core/base/QuantityText.h"
#include "core/base/Statistics.h"
#include "core/encoding/PulseTrain.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

namespace {

Reading scaledBy(double factor, const Reading& reading) {
    return {factor * reading.value, factor * reading.u, factor * reading.expanded};
}

SafetyRow rowOf(const LoadRecord& record, std::string item, std::string title, const Reading& reading,
                std::string unit) {
    SafetyRow row;
    row.load = record.name;
    row.item = std::move(item);
    row.title = std::move(title);
    row.value = reading.value;
    row.expanded = reading.expanded;
    row.unit = std::move(unit);
    return row;
}

void explain(SafetyRow& row, std::string_view missing) {
    if (row.verdict == RowVerdict::NotEvaluated) {
        row.reason = fmt::format("{} into {} was not evaluated: {}", row.title, row.load, missing);
    } else if (row.verdict == RowVerdict::Fail || row.verdict == RowVerdict::Attention) {
        row.reason = fmt::format("{} into {} is {}, above {}", row.title, row.load,
                                 measuredText(row.value, row.expanded, row.unit), exactText(row.limit, row.unit));
    } else if (row.verdict == RowVerdict::Indeterminate) {
        row.reason = fmt::format("{} into {} is {}: too close to {} to tell", row.title, row.load,
                                 measuredText(row.value, row.expanded, row.unit), exactText(row.limit, row.unit));
    }
}

std::string missingOf(const LoadRecord& record) {
    for (const auto& step : record.steps) {
        if (!step.reading.warnings.empty()) return step.reading.warnings.front();
    }
    for (const auto& step : record.steps) {
        if (!step.reading.notStated.empty()) return step.reading.notStated;
    }
    if (!record.problem.empty()) return record.problem;
    if (std::isfinite(record.dmm_ohm.value) && !record.dmm_ohm.measured())
        return "the uncertainty of the multimeter's reading is not known; one above 0 is expected";
    return record.steps.empty() ? "nothing was delivered" : "it was not measured";
}

/// Divides by the electrode's area and includes the area's own uncertainty.
Reading perArea(const Reading& reading, const LoadSafetyInput& input) {
    if (!input.area_cm2) return {};
    const auto out = scaledBy(1 / *input.area_cm2, reading);
    const double area = input.tolerances.area_pct / 100 * out.value;
    return {out.value, std::hypot(out.u, area / 2), std::hypot(out.expanded, area)};
}

/// Returns the value of the step with the highest value + U. A step that was not measured or has no U takes precedence,
/// so that it is not hidden.
template <class Of>
Reading highest(const LoadRecord& record, Of of) {
    Reading most;
    bool first = true;
    for (const auto& step : record.steps) {
        const Reading reading = of(step);
        if (std::isnan(reading.value)) return {};
        const bool unknown = std::isnan(most.expanded), more = !reading.measured() || reading.value > most.value;
        if (first || (unknown ? !reading.measured() && more
                              : !reading.measured() || reading.value + reading.expanded > most.value + most.expanded)) {
            most = reading;
        }
        first = false;
    }
    return most;
}

/// Returns the error with the higher value + U; an unknown error takes precedence.
Reading higherOf(const Reading& a, const Reading& b) {
    if (!a.measured()) return a;
    return !b.measured() || b.value + b.expanded > a.value + a.expanded ? b : a;
}

/// How far the delivered amplitude lies above the command, in % of the command; negative if below.
Reading amplitudeError(const LoadStep& step) {
    const Reading& got = step.reading.delivered;
    return {100 * (got.value - 1), 100 * got.u, 100 * got.expanded};
}

Reading voltageError(const LoadStep& step) {
    const Reading& got = step.reading.highest_v;
    const double scale = 100 / step.command_v;
    return {scale * (got.value - step.command_v), scale * got.u, scale * got.expanded};
}

Reading widthError(const LoadStep& step, const PulseTrain& train) {
    const double wanted = Seconds(train.phaseWidth).count();
    const auto& got = step.reading.width_s;
    const double scale = 100 / wanted;
    return {scale * (got.value - wanted), scale * got.u, scale * got.expanded};
}

/// Pulses that follow each other faster within a train produce more heat.
Reading trainRateError(const LoadStep& step, const PulseTrain& train) {
    const auto& got = step.reading.rate_hz;
    const double scale = 100 / train.rate.value();
    return {scale * (got.value - train.rate.value()), scale * got.u, scale * got.expanded};
}

/// Trains that follow too soon are too many, so a shorter interval gives a larger error.
Reading rateError(const LoadStep& step) {
    const auto& got = step.reading.interval_s;
    const double scale = 100 / step.interval_s;
    return {scale * (step.interval_s - got.value), scale * got.u, scale * got.expanded};
}

void addUpper(std::vector<SafetyRow>& rows, const LoadRecord& record, SafetyRow row, double limit, bool strict,
              std::string set, std::string source) {
    row.limit = limit;
    row.set = std::move(set);
    row.source = std::move(source);
    row.verdict = judgeUpper(row.value, row.expanded, limit, strict);
    explain(row, missingOf(record));
    rows.push_back(std::move(row));
}

void addLoadValue(std::vector<SafetyRow>& rows, const LoadRecord& record, const LoadSafetyInput& input) {
    const bool metered = std::isfinite(record.dmm_ohm.value);
    Reading error;
    if (!record.steps.empty()) {
        const Reading& got = record.steps.front().reading.impedance_ohm;
        const double truth = metered ? record.dmm_ohm.value : expectedOhms(record, input);
        // The marked tolerance is a rectangle: U (95 %) is 0.95 of its half-width, and s is its half-width/√3.
        const double marked = input.tolerances.resistor_pct / 100 * truth;
        const Reading known = metered ? record.dmm_ohm : Reading{truth, marked / std::sqrt(3.0), 0.95 * marked};
        const double scale = 100 / truth;
        error = {scale * std::abs(got.value - truth), scale * std::hypot(got.u, known.u),
                 scale * std::hypot(got.expanded, known.expanded)};
    }
    addUpper(rows, record,
             rowOf(record, "load_value",
                   metered ? "error of the load's value against the DMM" : "error of the load's value", error, "%"),
             input.tolerances.load_pct, false, "laboratory",
             "the load's value is verified before anything is judged on it; its tolerance is a choice");
}

void addAccuracy(std::vector<SafetyRow>& rows, const LoadRecord& record, const LoadSafetyInput& input) {
    const auto width = [&](const LoadStep& step) { return widthError(step, input.train); };
    const auto trainRate = [&](const LoadStep& step) { return trainRateError(step, input.train); };
    const bool hasRate = input.train.pulses > 1;
    const auto within = [](auto error) {
        return [error](const LoadStep& step) {
            const Reading e = error(step);
            return Reading{std::abs(e.value), e.u, e.expanded};
        };
    };
    const char* own = "the laboratory's tolerance, a choice (science.md section 9)";
    addUpper(rows, record,
             rowOf(record, "amplitude_over", "amplitude above the command", highest(record, amplitudeError), "%"),
             input.tolerances.amplitude_pct, false, "laboratory", own);
    if (input.source.drive == Drive::Current) {
        // The device was programmed to A / |Z|. If |Z| was measured too low, the device delivers more than A, which the
        // current alone does not show.
        addUpper(rows, record,
                 rowOf(record, "voltage_over", "voltage above the command", highest(record, voltageError), "%"),
                 input.tolerances.load_pct, false, "laboratory", own);
    }
    addUpper(rows, record, rowOf(record, "width_over", "phase width above the command", highest(record, width), "%"),
             input.tolerances.timing_pct, false, "laboratory", own);
    if (hasRate) {
        addUpper(
            rows, record,
            rowOf(record, "train_rate_over", "rate within a train above the command", highest(record, trainRate), "%"),
            input.tolerances.timing_pct, false, "laboratory", own);
    }
    addUpper(rows, record, rowOf(record, "rate_over", "interval below the command", highest(record, rateError), "%"),
             input.tolerances.timing_pct, false, "laboratory", own);
    for (const auto& set : input.limits) {
        for (const auto& asked : set.accuracy) {
            if (!(asked.tolerance_pct > 0)) continue;  // only to be stated, in the table of outputs
            Reading error;
            if (asked.parameter == "amplitude") error = highest(record, within(amplitudeError));
            if (asked.parameter == "width") error = highest(record, within(width));
            if (asked.parameter == "rate") {
                error = highest(record, [&](const LoadStep& step) {
                    const Reading ofTrains = within(rateError)(step);
                    return hasRate ? higherOf(ofTrains, within(trainRate)(step)) : ofTrains;
                });
            }
            addUpper(rows, record,
                     rowOf(record, asked.parameter + "_accuracy", "error of the " + asked.parameter, error, "%"),
                     asked.tolerance_pct, false, set.id, asked.source);
        }
    }
}

void addNetCharge(std::vector<SafetyRow>& rows, const LoadRecord& record, const LoadSafetyInput& input) {
    if (input.train.shape == PulseShape::Monophasic) return;
    const auto imbalance = highest(record, [](const LoadStep& step) { return step.reading.imbalance; });
    auto row = rowOf(record, "imbalance", "net charge of the phase charge", scaledBy(100, imbalance), "%");
    row.limit = input.tolerances.imbalance_pct;
    row.set = "laboratory";
    row.source = "safety.md, hazard H5";
    const bool lets_go = input.source.drive == Drive::Voltage && input.source.gap == GapState::HighImpedance;
    if (lets_go && record.load.kind == LoadKind::SkinEquivalent) {
        row.verdict = RowVerdict::NotApplicable;
        row.reason = fmt::format(
            "net charge into {} is reported, not judged: a voltage source that opens its output "
            "between the phases leaves charge on a capacitor",
            record.name);
    } else if (imbalance.measured() && !(row.expanded <= input.tolerances.imbalanceUncertainty_pct) &&
               !(row.value - row.expanded > row.limit)) {
        row.verdict = RowVerdict::NotEvaluated;
        row.reason =
            fmt::format("net charge into {} was not evaluated: its uncertainty is {}, at most {} can tell", record.name,
                        scaledText(row.expanded, "%", 2), exactText(input.tolerances.imbalanceUncertainty_pct, "%"));
    } else {
        row.verdict = judgeUpper(row.value, row.expanded, row.limit, false);
        explain(row, missingOf(record));
    }
    rows.push_back(std::move(row));
}

bool isOhm500(const LoadRecord& record) {
    return record.load.kind == LoadKind::Resistor && std::abs(record.load.series.value() - 500) < 1e-6;
}

/// Judges a limit on the command itself by the commanded value; the note shows the measured one.
SafetyRow commandRow(const LoadRecord& record, const LimitSet& set, const LimitRow& limit) {
    double most = kNaN;
    for (const auto& step : record.steps) most = std::fmax(most, step.command_v);
    auto row = rowOf(record, std::string(keyOf(limit.quantity)), "amplitude as commanded", {most, kNaN, kNaN}, "V");
    row.basis = RowBasis::Commanded;
    row.limit = limit.max;
    row.set = set.id;
    row.source = limit.source;
    row.verdict = judgeUpper(most, 0, limit.max, limit.strict);
    if (row.verdict == RowVerdict::Fail) {
        row.reason = fmt::format("{:.4g} V was commanded into {}, above {:.4g} V", most, record.name, limit.max);
    }
    const auto peak = highest(record, [](const LoadStep& step) { return step.reading.peak_v; });
    if (peak.measured()) {
        row.note = fmt::format("the highest peak measured is {}, {} beside the command",
                               measuredText(peak.value, peak.expanded, "V"),
                               measuredText(peak.value - most, peak.expanded, "V"));
    }
    return row;
}

/// True if the quantity covers 1 s or 5 s, which is longer than any record.
bool isOverAWindow(Quantity quantity) {
    switch (quantity) {
        case Quantity::RmsCurrent1s:
        case Quantity::RmsCurrent5s:
        case Quantity::RmsVoltage5s:
        case Quantity::DcCurrent:
        case Quantity::CurrentDensity:
        case Quantity::PowerDensity:
            return true;
        case Quantity::CommandVoltage:
        case Quantity::PeakVoltage:
        case Quantity::PeakCurrent:
        case Quantity::PhaseCharge:
        case Quantity::NetCharge:
        case Quantity::PulseEnergy:
        case Quantity::RmsCurrentTrain:
            return false;
    }
    return false;
}

void addLimits(std::vector<SafetyRow>& rows, const LoadRecord& record, const LoadSafetyInput& input) {
    const double hz = 1 / input.interval_s;
    for (const auto& set : input.limits) {
        for (const auto& limit : set.rows) {
            if (!limit.holdsAt(hz) || (limit.judged == JudgedAt::Ohm500 && !isOhm500(record))) continue;
            if (limit.quantity == Quantity::CommandVoltage) {
                rows.push_back(commandRow(record, set, limit));
                continue;
            }
            const Reading most =
                highest(record, [&](const LoadStep& step) { return readingOf(step.reading, limit.quantity, input); });
            auto row = rowOf(record, std::string(keyOf(limit.quantity)), std::string(titleOf(limit.quantity)), most,
                             std::string(unitOf(limit.quantity)));
            row.limit = limit.max;
            row.set = set.id;
            row.source = limit.source;
            row.verdict = judgeUpper(row.value, row.expanded, limit.max, limit.strict);
            if (isOverAWindow(limit.quantity) && most.measured())
                row.note = fmt::format("from {} captured trains, repeated{}", strongestOf(record).trains,
                                       input.train.pulses > 1 ? "; a train that a window touches counts whole" : "");
            const bool breaks = row.verdict == RowVerdict::Fail || row.verdict == RowVerdict::Indeterminate;
            if (breaks && limit.action != LimitAction::Refuse) row.verdict = RowVerdict::Attention;
            explain(row, needsArea(limit.quantity) && !input.area_cm2 ? "the electrode's area is not known"
                                                                      : missingOf(record));
            rows.push_back(std::move(row));
        }
    }
}

std::string commandText(double command_v, double interval_s) {
    return fmt::format("{:.4g} V every {:.4g} s", command_v, interval_s);
}

void addUndriven(std::vector<SafetyRow>& rows, const LoadRecord& record) {
    for (const auto& step : record.undriven) {
        auto row = rowOf(record, "drive", commandText(step.command_v, step.interval_s), {}, "");
        row.set = "laboratory";
        row.source = "the device's own range and step";
        row.verdict = RowVerdict::NotApplicable;
        row.reason = step.reason;
        rows.push_back(std::move(row));
    }
}

void addRefusals(std::vector<SafetyRow>& rows, const LoadRecord& record) {
    for (const auto& asked : record.refusals) {
        auto row = rowOf(record, "refusal",
                         asked.what.empty() ? commandText(asked.command_v, asked.interval_s) : asked.what, {}, "");
        row.set = "gate";
        row.source = asked.predicted;
        if (asked.forbidden) {
            row.verdict = asked.refused ? RowVerdict::RefusedAsExpected : RowVerdict::Fail;
            row.reason = asked.refused ? asked.reason
                                       : fmt::format("{} into {} was delivered although it breaks a limit: {}",
                                                     row.title, record.name, asked.predicted);
        } else if (asked.refused) {
            row.verdict = RowVerdict::Indeterminate;
            row.reason = fmt::format("{} into {} was refused although no limit forbids it: {}", row.title, record.name,
                                     asked.reason);
        } else {
            continue;
        }
        rows.push_back(std::move(row));
    }
}

}  // namespace

double expectedOhms(const LoadRecord& record, const LoadSafetyInput& input) {
    if (record.load.kind == LoadKind::Open || record.load.kind == LoadKind::Short) return kNaN;
    return impedanceOf(record.load, input.train, input.source).value();
}

Reading readingOf(const LoadReading& reading, Quantity quantity, const LoadSafetyInput& input) {
    switch (quantity) {
        case Quantity::CommandVoltage:
            return {};
        case Quantity::PeakVoltage:
            return reading.peak_v;
        case Quantity::PeakCurrent:
            return reading.peak_ma;
        case Quantity::PhaseCharge:
            return reading.charge_uc;
        case Quantity::NetCharge:
            return reading.net_charge_uc;
        case Quantity::PulseEnergy:
            return reading.energy_mj;
        case Quantity::RmsCurrentTrain:
            return reading.rms_train_ma;
        case Quantity::RmsCurrent1s:
            return reading.rms_1s_ma;
        case Quantity::RmsCurrent5s:
            return reading.rms_5s_ma;
        case Quantity::RmsVoltage5s:
            return reading.rms_5s_v;
        case Quantity::DcCurrent:
            return reading.dc_ma;
        case Quantity::CurrentDensity:
            return perArea(reading.rms_5s_ma, input);
        case Quantity::PowerDensity:
            return perArea(reading.power_1s_w, input);
    }
    return {};
}

SafetyRow judgeReference(const LoadRecord& record, const LoadSafetyInput& input) {
    std::vector<SafetyRow> rows;
    addLoadValue(rows, record, input);
    rows.front().item = "reference";
    rows.front().title = "known-reference check: " + rows.front().title;
    return rows.front();
}

SafetyRow judgeTimeReference(const LoadRecord& record, const LoadSafetyInput& input) {
    Reading error;
    if (!record.steps.empty()) error = rateError(record.steps.front());
    error.value = std::abs(error.value);
    std::vector<SafetyRow> rows;
    addUpper(rows, record, rowOf(record, "time_reference", "time reference: error of the interval", error, "%"),
             input.tolerances.clock_pct, false, "laboratory", "the computer's clock, which hands out the trains");
    return rows.front();
}

std::vector<SafetyRow> rowsOf(const LoadRecord& record, const LoadSafetyInput& input) {
    std::vector<SafetyRow> rows;
    if (!record.notApplicable.empty()) {
        auto row = rowOf(record, "drive", "driving the load", {}, "");
        row.verdict = RowVerdict::NotApplicable;
        row.reason = record.notApplicable;
        return {row};
    }
    addRefusals(rows, record);
    addUndriven(rows, record);
    // If the limits forbid every command on a load, nothing can be measured on it.
    const bool allRefused = record.steps.empty() && !record.refusals.empty() && record.problem.empty();
    if (allRefused) return rows;
    addLoadValue(rows, record, input);
    addAccuracy(rows, record, input);
    addNetCharge(rows, record, input);
    addLimits(rows, record, input);
    if (!record.problem.empty()) {
        auto row = rowOf(record, "complete", "all commands", {}, "");
        row.verdict = RowVerdict::NotEvaluated;
        row.reason = fmt::format("{} was left unfinished: {}", record.name, record.problem);
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace tacto
