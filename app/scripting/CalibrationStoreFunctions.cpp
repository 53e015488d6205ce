// The store of calibrations, for scripts: what holds for the stimulator that is connected, and keeping a new one.
#include <chrono>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/calibration/CalibrationStore.h"
#include "core/devices/DeviceUri.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// Of the wall: a calibration's date is the laboratory's, not the bench clock's.
CalibrationDate today() { return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()); }

Result<Stimulator*> connected(ScriptSession& session, std::string_view function) {
    const auto& stimulator = session.bench().devices().stimulator;
    if (!stimulator) return fail(ErrorCode::Unsupported, "{}: no stimulator is connected", function);
    return stimulator.get();
}

std::string unitOf(const Stimulator& stimulator) { return stimulator.traits().drive == Drive::Current ? "mA" : "V"; }

Json lineJson(const StoredLine& line, std::string_view unit) {
    return {{"unit", unit},          {"gain", line.gain},
            {"offset", line.offset}, {"uncertainty_pct", line.uncertainty_pct},
            {"lowest", line.lowest}, {"highest", line.highest}};
}

Result<Json> storedCalibration(ScriptSession& session, const Json&) {
    auto stimulator = connected(session, "bench.calibration");
    if (!stimulator) return failure(stimulator);
    const auto& device = (*stimulator)->identity();
    auto store = CalibrationStore::open(calibrationFile());
    if (!store) return failure(store);
    const auto found =
        store->valid(calibratedOutput(device.serial, device.uri), unitOf(**stimulator), today(), device.simulated);
    if (!found) return Json{{"calibrated", false}, {"text", found.error().message}};
    Json out = {{"calibrated", true},
                {"text", fmt::format("stimulator {} was calibrated on {} and that holds until {}", found->serial,
                                     dateText(found->made), dateText(found->validUntil))},
                {"amplitude", lineJson(found->amplitude, found->unit)},
                {"made", dateText(found->made)},
                {"valid_until", dateText(found->validUntil)}};
    for (const auto& time : kStoredTimes) out[std::string(time.key)] = lineJson(*((*found).*time.line), "s");
    return out;
}

Result<Json> useCalibration(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.useCalibration", list);
    const Json& use = arguments.at(0);
    if (!use.is_boolean()) return arguments.wrong("use", use, "true or false");
    if (auto changed = session.bench().useCalibration(use.get<bool>()); !changed) return failure(changed);
    return Json();
}

Result<std::optional<CalibrationDate>> dueDate(const Arguments& arguments, const Json& options) {
    auto text = arguments.text(options, "scope_due", "");
    if (!text) return failure(text);
    if (text->empty()) return std::optional<CalibrationDate>();
    const auto date = parseDate(*text);
    if (!date) return arguments.wrong("scope_due", *text, "a day such as \"2027-03-01\"");
    return date;
}

/// U over the command, at its worst; NaN where a level has none.
double worstUncertainty_pct(const Json& levels) {
    double worst = 0;
    for (const auto& level : levels) {
        const Json u = level.value("expanded_uncertainty", Json()), at = level.value("commanded", Json());
        if (!u.is_number() || !at.is_number()) return std::nan("");
        worst = std::max(worst, 100 * u.get<double>() / std::abs(at.get<double>()));
    }
    return worst;
}

/// The largest distance of a level's mean from the line; NaN where a level has none.
double largestResidual(const Json& levels) {
    double largest = 0;
    for (const auto& level : levels) {
        const Json residual = level.value("residual", Json());
        if (!residual.is_number()) return std::nan("");
        largest = std::max(largest, std::abs(residual.get<double>()));
    }
    return largest;
}

/// The run's own calibration of one quantity that `found` refers to: of what the script says, the number counts alone.
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

/// The line of one quantity, from what the program itself found.
Result<StoredLine> lineFound(const Arguments& arguments, const Json& one, std::string_view quantity) {
    if (one.value("complete", Json()) != Json(true)) {
        return arguments.wrong(quantity, one,
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
                    "record.calibration: the stimulator's {} is not within 20 % of what it is told, uncertainty "
                    "included (IEC 60601-2-10); a calibration is kept of one that is in order",
                    quantity);
    }
    StoredLine line;
    line.gain = one.value("gain", std::nan(""));
    line.offset = one.value("offset", std::nan(""));
    const Json& levels = one.at("levels");
    line.uncertainty_pct = worstUncertainty_pct(levels);
    line.residual = largestResidual(levels);
    line.lowest = levels.front().value("commanded", std::nan(""));
    line.highest = levels.back().value("commanded", std::nan(""));
    return line;
}

Result<Json> keepCalibration(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.calibration", list);
    auto given = arguments.object(0, "found");
    if (!given) return failure(given);
    const Json& found = **given;
    auto options = arguments.options(1, {"valid_days", "scope_due"});
    if (!options) return failure(options);
    auto days = arguments.number(*options, "valid_days", 365, {1, kLongestValidity.count(), true});
    if (!days) return failure(days);
    auto due = dueDate(arguments, *options);
    if (!due) return failure(due);
    auto stimulator = connected(session, "record.calibration");
    if (!stimulator) return failure(stimulator);
    auto* writer = session.writer();
    if (writer == nullptr) {
        return fail(ErrorCode::InvalidArgument,
                    "record.calibration: this run is not recorded; a session that holds the readings is expected");
    }
    StoredCalibration made;
    const auto amplitude = ownOf(session, found, "amplitude");
    if (!amplitude) return failure(amplitude);
    std::vector<const OwnCalibration*> all{*amplitude};
    const auto line = lineFound(arguments, (*amplitude)->found, "amplitude");
    if (!line) return failure(line);
    made.amplitude = *line;
    for (const auto& time : kStoredTimes) {
        const auto own = ownOf(session, found, time.key);
        if (!own) return failure(own);
        all.push_back(*own);
        const auto one = lineFound(arguments, (*own)->found, time.key);
        if (!one) return failure(one);
        made.*time.line = *one;
    }
    const auto& device = (*stimulator)->identity();
    made.serial = calibratedOutput(device.serial, device.uri);
    made.device = device.name;
    made.unit = (*amplitude)->found.value("unit", "");
    if (made.unit != unitOf(**stimulator)) return arguments.wrong("unit", made.unit, unitOf(**stimulator));
    made.made = today();
    made.validUntil = std::chrono::sys_days(made.made) + std::chrono::days(static_cast<int>(*days));
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
    // The readings are in the session, on disk, before a calibration refers to them.
    if (auto kept = writer->measurement(session.now(), kCalibrationMeasurement, evidence); !kept) return failure(kept);
    if (auto flushed = writer->flush(); !flushed) return failure(flushed);
    made.session = writer->path().filename().string();
    made.sessionHead = writer->chainHead();
    auto store = CalibrationStore::open(calibrationFile());
    if (!store) return failure(store);
    const auto* before = store->latest(made.serial, made.unit);
    const Json supersedes = before == nullptr ? Json() : Json(dateText(before->made));
    if (auto added = store->add(made); !added) return failure(added);
    return Json{{"serial", made.serial},     {"valid_until", dateText(made.validUntil)}, {"supersedes", supersedes},
                {"readings", made.readings}, {"session_head", made.sessionHead},         {"simulated", made.simulated}};
}

}  // namespace

std::vector<HostFunction> calibrationStoreFunctions() {
    return {
        {"bench",
         "calibration",
         HostKind::Property,
         {},
         "The stored calibration that holds today for the stimulator that is connected.",
         "{ calibrated, text }, and where calibrated: { made, valid_until, amplitude, interval, width, gap }, each of "
         "these { unit, gain, offset, uncertainty_pct, lowest, highest }.",
         "Throws without a stimulator, or when the store is damaged.",
         storedCalibration},
        {"bench",
         "useCalibration",
         HostKind::Function,
         {{"use", "boolean", "", "false: the stimulator is told the commands as they are; true: as at the start"}},
         "Leaves the stored calibration aside for the rest of the run, as a new one must, or takes it up again. The "
         "output must be disarmed.",
         "",
         "Throws while armed.",
         useCalibration},
        {"record",
         "calibration",
         HostKind::Function,
         {{"found", "object", "",
           "{ amplitude, interval, width, gap }: complete calibrations of each, from analysis.calibration(); the "
           "program keeps its own record of them, not what the objects say"},
          {"options.valid_days", "number", "d", "how long it holds, 1 to 366; 365 where left out", true},
          {"options.scope_due", "text", "", "day on which the oscilloscope's own calibration is due", true}},
         "Keeps a calibration for the stimulator's serial. An older one stays in the store and is superseded.",
         "{ serial, valid_until, supersedes, readings, session_head, simulated }: supersedes is the date of the one "
         "before, or null.",
         "Throws for a calibration that is incomplete or does not rest on readings of this run, a run that is not "
         "recorded, a stimulator without a serial, an oscilloscope that is overdue or does not state its accuracy, or "
         "a store that cannot be written.",
         keepCalibration},
    };
}

}  // namespace tacto
