// Keeps a calibration for the connected stimulator.
#include "app/scripting/host/record/KeptCalibration.h"

#include <chrono>
#include <cmath>

#include "app/scripting/engine/Arguments.h"
#include "core/analysis/calibration/CalibrationJson.h"
#include "core/base/JsonText.h"
#include "core/base/Statistics.h"
#include "core/devices/DeviceUri.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::record {

namespace {

using Json = nlohmann::json;

constexpr const char* kFunction = "record.calibration";

Result<std::optional<CalibrationDate>> dueDate(const std::string& text) {
    if (text.empty()) return std::optional<CalibrationDate>();
    const auto date = parseDate(text);
    if (!date) return otherThanExpected(kFunction, "scope_due", text, "a day such as \"2027-03-01\"");
    return date;
}

/// Returns the largest expanded uncertainty relative to its command, in %; NaN if a level has none.
double worstUncertainty_pct(const Json& levels) {
    double worst = 0;
    for (const auto& level : levels) {
        const double u_pct = 100 * numberOr(level, "expanded_uncertainty") / std::abs(numberOr(level, "commanded"));
        if (std::isnan(u_pct)) return kNaN;
        worst = std::max(worst, u_pct);
    }
    return worst;
}

/// Returns the largest distance of a level's mean from the line; NaN if a level has none.
double largestResidual(const Json& levels) {
    double largest = 0;
    for (const auto& level : levels) {
        const double residual = numberOr(level, "residual");
        if (std::isnan(residual)) return kNaN;
        largest = std::max(largest, std::abs(residual));
    }
    return largest;
}

/// Returns the run's own calibration of one quantity that `found` refers to. Only the number in `found` is used.
Result<const OwnCalibration*> ownOf(ScriptSession& session, const Json& found, std::string_view quantity) {
    const Json one = found.value(std::string(quantity), Json());
    const auto* own = session.own().calibration(one.is_object() ? one.value("calibration", Json()) : one);
    if (own == nullptr || own->quantity != quantity) {
        return fail(ErrorCode::InvalidArgument,
                    "record.calibration: {} was not computed from readings that this run took itself; what "
                    "analysis.calibration() made of the readings of measure.pulse() is expected",
                    quantity);
    }
    if (own->calibrationApplied) {
        return fail(ErrorCode::InvalidArgument,
                    "record.calibration: readings of {} were taken with the stored calibration applied; "
                    "bench.useCalibration(false) before the first is expected",
                    quantity);
    }
    return own;
}

/// Returns the line of one quantity as the program itself found it.
Result<StoredLine> lineFound(const Json& one, std::string_view quantity) {
    if (one.value("complete", Json()) != Json(true)) {
        return otherThanExpected(kFunction, quantity, one,
                                 fmt::format("a complete calibration of {}, from analysis.calibration(),", quantity));
    }
    if (one.value("expanded_uncertainty", Json()).is_null()) {
        return fail(
            ErrorCode::InvalidArgument,
            "record.calibration: the {} has no uncertainty, since the oscilloscope does not state how good it is; "
            "--set scope_gain_pct=... and timebase_ppm=..., from its data sheet, are expected",
            quantity);
    }
    if (one.value("verdict_iec", "") != "pass") {
        return fail(ErrorCode::InvalidArgument,
                    "record.calibration: the stimulator's {} is not within 20 % of what is programmed, uncertainty "
                    "included (IEC 60601-2-10); only then would its calibration be kept",
                    quantity);
    }
    StoredLine line;
    line.gain = numberOr(one, "gain");
    line.offset = numberOr(one, "offset");
    const Json& levels = one.at("levels");
    line.uncertainty_pct = worstUncertainty_pct(levels);
    line.residual = largestResidual(levels);
    line.lowest = numberOr(levels.front(), "commanded");
    line.highest = numberOr(levels.back(), "commanded");
    return line;
}

}  // namespace

Result<Json> keepCalibration(ScriptSession& session, const Json& found, const Validity& validity) {
    auto due = dueDate(validity.scopeDue);
    if (!due) return failure(due);
    const auto& stimulator = *session.bench().devices().stimulator;
    auto* writer = session.writer();
    if (writer == nullptr) {
        return fail(ErrorCode::InvalidArgument,
                    "record.calibration: this run is not recorded; a session that holds the readings is expected");
    }
    StoredCalibration made;
    const auto amplitude = ownOf(session, found, "amplitude");
    if (!amplitude) return failure(amplitude);
    std::vector<const OwnCalibration*> all{*amplitude};
    const auto line = lineFound((*amplitude)->found, "amplitude");
    if (!line) return failure(line);
    made.amplitude = *line;
    for (const auto& time : kStoredTimes) {
        const auto own = ownOf(session, found, time.id);
        if (!own) return failure(own);
        all.push_back(*own);
        const auto one = lineFound((*own)->found, time.id);
        if (!one) return failure(one);
        made.*time.line = *one;
    }
    const auto& device = stimulator.identity();
    made.serial = calibratedOutput(device.serial, device.uri);
    made.device = device.name;
    made.unit = (*amplitude)->found.value("unit", "");
    const std::string unit = amplitudeUnit(stimulator.traits().drive);
    if (made.unit != unit) return otherThanExpected(kFunction, "unit", made.unit, unit);
    made.made = utcToday();
    made.validUntil = std::chrono::sys_days(made.made) + std::chrono::days(validity.days);
    for (const auto& each : session.bench().devices().identities()) {
        made.simulated = made.simulated || each.simulated;
        if (each.role != Role::Oscilloscope) continue;
        if (each.uri.starts_with("capture:")) {
            return fail(ErrorCode::InvalidArgument,
                        "record.calibration: the readings were taken from files; an oscilloscope on the stimulator is "
                        "expected");
        }
        if (!(*amplitude)->gainTolerance) {
            return fail(
                ErrorCode::InvalidArgument,
                "record.calibration: the oscilloscope {} does not state its gain tolerance, so nothing is kept; "
                "--set scope_gain_pct=..., from its data sheet, is expected",
                each.name);
        }
        made.instruments.push_back({each.name, each.serial, *due, (*amplitude)->gainTolerance, (*amplitude)->statedBy});
    }
    Json evidence = Json::object();
    for (const auto* own : all) {
        made.simulated = made.simulated || own->simulated;
        made.readings += own->readings.size();
        evidence[own->quantity] = own->found;
    }
    // A calibration may refer to the readings only once they are on disk in the session.
    if (auto kept = writer->measurement(session.now(), kCalibrationMeasurement, evidence); !kept) return failure(kept);
    if (auto flushed = writer->flush(); !flushed) return failure(flushed);
    made.session = writer->path().filename().string();
    made.sessionHead = writer->chainHead();
    auto store = CalibrationStore::open(calibrationFile());
    if (!store) return failure(store);
    const auto* before = store->latest(made.serial, made.unit);
    const auto supersedes = before == nullptr ? std::string() : dateText(before->made);
    if (auto added = store->add(made); !added) return failure(added);
    session.own().note({{"kept at", made.sessionHead}});  // for the certificate, which names it
    return toJson(KeptCalibration{made.serial, dateText(made.validUntil), supersedes, made.readings, made.sessionHead,
                                  made.simulated});
}

namespace {

Result<Json> calibration(ScriptSession& session, const Arguments& arguments) {
    return keepCalibration(session, arguments.object("found"),
                           {arguments.whole("options.valid_days"), arguments.text("options.scope_due")});
}

}  // namespace

}  // namespace tacto::host::record

namespace tacto {

std::vector<HostFunction> calibrationRecords() {
    using namespace takes;
    return {
        {.name = "calibration",
         .parameters =
             {object("found",
                     "{ amplitude, interval, width, gap }: complete calibrations of each, from analysis.calibration(); "
                     "the program keeps its own record of them, not what the objects say"),
              whole("options.valid_days", "how long it holds")
                  .range(1, static_cast<double>(kLongestValidity.count()))
                  .otherwise(365),
              text("options.scope_due", "day on which the oscilloscope's own calibration is due").optional()},
         .text = "Keeps a calibration for the stimulator's serial. An older one stays in the store and is superseded.",
         .members = keptMembers(),
         .returns = ": supersedes is the date of the one before, or null.",
         .errors = "Throws for a calibration that is incomplete or does not rest on readings of this run, a run that "
                   "is not recorded, a stimulator without a serial, an oscilloscope that is overdue or does not state "
                   "its accuracy, or a store that cannot be written.",
         .needs = Role::Stimulator,
         .call = host::record::calibration},
    };
}

}  // namespace tacto
