// Calibrating a stimulator: what to command, one reading from the captures, and the line through all of them.
#include <cmath>
#include <optional>

#include "app/scripting/GivenCaptures.h"
#include "app/scripting/HostFunction.h"
#include "core/analysis/CalibrationJson.h"
#include "core/analysis/ResultJson.h"
#include "core/measure/InstrumentStatement.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Result<Json> setEncoding(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.setEncoding", list);
    auto wanted = arguments.object(0, "changes");
    if (!wanted) return failure(wanted);
    Profile profile = session.bench().profile();
    Json section = toJson(profile.encoding);
    section.update(**wanted);  // an unknown key is refused below, by name
    auto encoding = encodingProfileFrom(section);
    if (!encoding) return failure(encoding);
    profile.encoding = *encoding;
    if (auto replaced = session.bench().setProfile(profile); !replaced) return failure(replaced);
    return Json();
}

const CaptureChannel* channelOf(const Capture& capture, std::string_view name) {
    for (const auto& channel : capture.channels) {
        if (channel.name == name) return &channel;
    }
    return nullptr;
}

/// What the data sheet of the channel that was read states, in the reading's unit (`scale`: mA per A).
Json instrumentOf(const Capture& capture, const CaptureChannel& channel, double scale) {
    const auto positive = [](double value) { return value > 0 ? Json(value) : Json(); };
    return {{"gain_tolerance", numberOrNull(channel.gainTolerance)},
            {"probe_tolerance", numberOrNull(channel.probeTolerance)},
            {"linearity_tolerance", numberOrNull(channel.linearityTolerance * scale)},
            {"offset_tolerance", numberOrNull(channel.offsetTolerance * scale)},
            {"resolution", positive(channel.lsb * scale)},
            {"timebase_tolerance", numberOrNull(capture.timeBaseTolerance)},
            {"stamp_tolerance_s", numberOrNull(capture.stampTolerance_s)},
            {"stated_by", channel.statedBy},
            {"not_stated", notStatedText(capture)},
            {"sampling_step_s", 1 / capture.rate_hz},
            {"full_scale", positive(channel.high * scale)}};
}

/// What was asked of the stimulator when the capture was taken.
Json commandJson(const CapturedCommand& command) {
    return {{"amplitude", numberOrNull(command.amplitude)},
            {"interval_s", numberOrNull(command.interval_s)},
            {"width_s", numberOrNull(command.width_s)},
            {"gap_s", numberOrNull(command.gap_s)}};
}

/// The load as V/I with its U, from what both channels state; null where they do not.
void addLoad(Json& out, const Capture& capture, const ChannelMeasurement& voltage, const ChannelMeasurement& current) {
    const double volts = meanOfTrains(voltage, &TrainMeasurement::amplitude);
    const double amps = meanOfTrains(current, &TrainMeasurement::amplitude);
    const auto* i = channelOf(capture, "current");
    if (i == nullptr || !(volts > 0) || !(amps > 0)) return;
    const double relative = std::hypot(voltage.uncertainty.amplitude / volts, current.uncertainty.amplitude / amps);
    out["load_ohm"] = volts / amps;
    out["load_expanded_ohm"] = numberOrNull(kCoverage * relative * volts / amps);
    if (i->lsb > 0) out["current_lsb"] = amps / i->lsb;
}

Result<Json> pulse(ScriptSession& session, const Json& list) {
    const Arguments arguments("measure.pulse", list);
    auto given = capturesGiven(session, arguments);
    if (!given) return failure(given);
    if (given->captures.empty()) return arguments.wrong("captures", arguments.at(0), "at least one capture");
    const auto& captures = given->captures;
    const auto commands = session.commandsOf(given->ids);
    if (!commands) return failure(commands);
    const auto& stimulator = session.bench().devices().stimulator;
    if (!stimulator) return fail(ErrorCode::Unsupported, "measure.pulse: no stimulator is connected");
    const auto options = optionsFor(session.bench().profile().encoding.train);

    auto voltage = measureTrains(captures, "voltage", options);
    if (!voltage) return failure(voltage);
    const auto current = measureTrains(captures, "current", options);
    const bool drivesCurrent = stimulator->traits().drive == Drive::Current;
    if (drivesCurrent && !current) return failure(current);
    const ChannelMeasurement& read = drivesCurrent ? *current : *voltage;
    const double scale = drivesCurrent ? 1e3 : 1;
    const auto* channel = channelOf(captures.front(), read.name);

    Json out = {{"unit", drivesCurrent ? "mA" : "V"},
                {"amplitude", numberOrNull(scale * meanOfTrains(read, &TrainMeasurement::amplitude))},
                {"interval_s", numberOrNull(meanOfTrains(read, &TrainMeasurement::interval_s))},
                {"width_s", numberOrNull(meanOfTrains(read, &TrainMeasurement::width_s))},
                {"gap_s", numberOrNull(read.gap_s.mean)},
                {"trains", read.trains.size()},
                {"warnings", read.warnings},
                {"commanded", commandJson(commands->back())},
                {"instrument", instrumentOf(captures.front(), *channel, scale)},
                {"captures", given->ids}};
    if (current) {
        addLoad(out, captures.front(), *voltage, *current);
    }
    OwnReading own;
    for (const auto& id : given->ids) own.captures.push_back(id.get<std::int64_t>());
    own.commands = *commands;
    for (const char* key : {"amplitude", "interval_s", "width_s", "gap_s"}) own.read[key] = out[key];
    own.unit = drivesCurrent ? "mA" : "V";
    own.gainTolerance = channel->gainTolerance;
    own.probeTolerance = channel->probeTolerance;
    own.linearityTolerance = channel->linearityTolerance * scale;
    if (channel->lsb > 0) own.resolution = channel->lsb * scale;
    own.timeBaseTolerance = captures.front().timeBaseTolerance;
    own.stampTolerance_s = captures.size() > 1 ? captures.front().stampTolerance_s : 0;
    own.statedBy = channel->statedBy;
    own.samplingStep_s = 1 / captures.front().rate_hz;
    out["reading"] = session.own().add(std::move(own));
    return out;
}

/// The numbers of the run's own readings that `rows` name; nothing where one of them names none.
std::optional<std::vector<std::int64_t>> ownNumbers(const Json& rows) {
    std::vector<std::int64_t> numbers;
    for (const auto& row : rows) {
        const Json number = row.is_object() ? row.value("reading", Json()) : Json();
        if (!number.is_number_integer()) return std::nullopt;
        numbers.push_back(number.get<std::int64_t>());
    }
    return numbers;
}

/// Levels of a kept calibration are told apart at least this well, relative to the largest.
constexpr double kWidestLevel = 0.05;

/// A calibration of the run's own readings: commands, readings and what the instrument states come from the program,
/// whatever the rows say beside. `errors` grow to what the instrument states, and never shrink.
class OwnSeries {
public:
    OwnSeries(ScriptSession& session, const OwnQuantity& quantity, std::vector<std::int64_t> numbers,
              std::vector<const OwnReading*> readings)
        : session_(session), quantity_(quantity), readings_(std::move(readings)) {
        made_.quantity = quantity.name;
        made_.readings = std::move(numbers);
        for (const auto* reading : readings_) {
            for (const auto& command : reading->commands) {
                made_.simulated = made_.simulated || command.simulated;
                made_.calibrationApplied = made_.calibrationApplied || command.calibrationApplied;
            }
        }
    }

    /// Errors: InvalidArgument for a reading whose captures were commanded differently, or whose command is not known.
    [[nodiscard]] Result<void> fill(std::vector<CalibrationReading>& rows) const {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto& commands = readings_[i]->commands;
            const double commanded = commands.back().*quantity_.commanded;
            for (const auto& command : commands) {
                if (std::abs(command.*quantity_.commanded - commanded) <= 1e-9 * std::abs(commanded)) continue;
                return fail(ErrorCode::InvalidArgument,
                            "analysis.calibration: reading {} has captures of different commands of {}; one command is "
                            "expected",
                            made_.readings[i], quantity_.name);
            }
            const Json& measured = readings_[i]->read[quantity_.key];
            rows[i].commanded = commanded;
            rows[i].measured = measured.is_number() ? measured.get<double>() : std::nan("");
        }
        return {};
    }

    /// The captures carry what the operator or else the instrument states; what neither does is not known, whatever a
    /// script says of it.
    void widen(InstrumentErrors& errors) {
        const bool amplitude = quantity_.name == "amplitude";
        const double stated = worst(amplitude ? &OwnReading::gainTolerance : &OwnReading::timeBaseTolerance);
        if (!std::isnan(stated)) {
            const auto said = session_.operatorsNumber(amplitude ? "scope_gain_pct" : "timebase_ppm");
            made_.statedBy = said && *said > 0 ? "the operator" : "the instrument";
            made_.gainTolerance = stated;
        }
        widenTo(errors.gainTolerance, stated);
        errors.offsetTolerance = 0;  // levels are read from their own baseline
        if (amplitude) {
            widenTo(errors.probeTolerance, worst(&OwnReading::probeTolerance));
            widenTo(errors.linearityTolerance, worst(&OwnReading::linearityTolerance));
            widenTo(errors.resolution, worst(&OwnReading::resolution));
        } else {
            errors.resolution = 0;
            if (quantity_.name == "interval") widenTo(errors.stampTolerance, worst(&OwnReading::stampTolerance_s));
            widenTo(errors.samplingStep, worst(&OwnReading::samplingStep_s));
        }
        errors.unit = amplitude ? readings_.front()->unit : "s";
    }

    [[nodiscard]] std::int64_t keep(const Json& found) {
        made_.found = found;
        return session_.own().add(std::move(made_));
    }

private:
    /// The largest of the readings; NaN where one of them does not state it.
    [[nodiscard]] double worst(double OwnReading::*member) const {
        double most = 0;
        for (const auto* reading : readings_) {
            if (std::isnan(reading->*member)) return kNaN;
            most = std::max(most, reading->*member);
        }
        return most;
    }
    /// A script's own figure may widen what is stated, and never stands for it.
    static void widenTo(double& error, double stated) {
        error = std::isnan(stated) || std::isnan(error) ? stated : std::max(error, stated);
    }

    ScriptSession& session_;
    const OwnQuantity& quantity_;
    std::vector<const OwnReading*> readings_;
    OwnCalibration made_;
};

Result<std::optional<OwnSeries>> ownSeries(ScriptSession& session, const Json& rows, const std::string& quantity) {
    auto numbers = ownNumbers(rows);
    const auto* known = ownQuantity(quantity);
    if (!numbers || known == nullptr || rows.empty()) return std::optional<OwnSeries>();
    auto readings = session.own().readings(*numbers);
    if (!readings) return fail(ErrorCode::InvalidArgument, "analysis.calibration: {}", readings.error().message);
    return std::optional<OwnSeries>(std::in_place, session, *known, std::move(*numbers), std::move(*readings));
}

Result<std::vector<CalibrationReading>> readingsFrom(const Arguments& arguments, const Json& rows) {
    std::vector<CalibrationReading> readings;
    for (const auto& row : rows) {
        if (!row.is_object() || !row.value("commanded", Json()).is_number()) {
            return arguments.wrong("a reading", row, "an object with commanded, measured and direction");
        }
        CalibrationReading reading;
        reading.commanded = row["commanded"].get<double>();
        const Json measured = row.value("measured", Json());
        if (measured.is_number()) reading.measured = measured.get<double>();
        const Json direction = row.value("direction", Json(""));
        bool known = false;
        for (const auto one : {SweepDirection::None, SweepDirection::Up, SweepDirection::Down}) {
            if (direction != nameOf(one)) continue;
            reading.direction = one;
            known = true;
        }
        if (!known) return arguments.wrong("direction", direction, "\"up\", \"down\" or \"\"");
        readings.push_back(reading);
    }
    return readings;
}

Result<Json> calibration(ScriptSession& session, const Json& list) {
    const Arguments arguments("analysis.calibration", list);
    auto rows = arguments.list(0, "readings");
    if (!rows) return failure(rows);
    auto readings = readingsFrom(arguments, **rows);
    if (!readings) return failure(readings);
    auto options = arguments.options(
        1, {"quantity", "unit", "tolerance_pct", "gain_tolerance", "probe_tolerance", "offset_tolerance", "resolution",
            "load_tolerance", "load_sensitivity", "sampling_step", "same_level"});
    if (!options) return failure(options);
    auto quantity = arguments.text(*options, "quantity", "amplitude");
    if (!quantity) return failure(quantity);
    auto unit = arguments.text(*options, "unit", "");
    if (!unit) return failure(unit);
    double tolerance = 2;
    CalibrationOptions fit;
    InstrumentErrors errors;
    errors.unit = *unit;
    struct Option {
        const char* key;
        double* target;
        double least;
    };
    for (const auto& [key, target, least] :
         {Option{"tolerance_pct", &tolerance, 0}, Option{"gain_tolerance", &errors.gainTolerance, 0},
          Option{"probe_tolerance", &errors.probeTolerance, 0}, Option{"offset_tolerance", &errors.offsetTolerance, 0},
          Option{"resolution", &errors.resolution, 0}, Option{"load_tolerance", &errors.loadTolerance, 0},
          Option{"load_sensitivity", &errors.loadSensitivity, -10}, Option{"sampling_step", &errors.samplingStep, 0},
          Option{"same_level", &fit.sameLevel, 0}}) {
        if (options->contains(key) && (*options)[key].is_null()) {
            *target = kNaN;  // not stated
            continue;
        }
        auto value = arguments.number(*options, key, *target, {least, 1e9});
        if (!value) return failure(value);
        *target = *value;
    }
    auto own = ownSeries(session, **rows, *quantity);
    if (!own) return failure(own);
    if (*own) {
        if (fit.sameLevel > kWidestLevel) {
            return arguments.wrong("same_level", fit.sameLevel, fmt::format("at most {}", kWidestLevel));
        }
        if (auto filled = (*own)->fill(*readings); !filled) return failure(filled);
        (*own)->widen(errors);
    }
    fit.resolution = std::max(errors.samplingStep, std::isnan(errors.resolution) ? 0 : errors.resolution);
    auto found = fitCalibration(*readings, fit);
    if (!found) return failure(found);
    BudgetOptions budget;
    budget.seed = session.request().seed;
    auto judged = judgeCalibration(std::move(*found), errors, tolerance, budget);
    if (!judged) return failure(judged);
    constexpr double kIec_pct = 20;  // IEC 60601-2-10: output within ± 20 % of what is set
    Json out = toJson(*judged);
    out["quantity"] = *quantity;
    out["unit"] = errors.unit;
    out["verdict_iec"] = nameOf(verdictAt(*judged, kIec_pct));
    out["calibration"] = *own ? Json((*own)->keep(out)) : Json();
    return out;
}

Result<Json> figureOf(const char* function, const Json& list, const char* view) {
    const Arguments arguments(function, list);
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    if (!(*found)->value("levels", Json()).is_array()) {
        return arguments.wrong("found", **found, "what analysis.calibration() returned");
    }
    Json out = {{"type", "calibration"}, {"view", view}};
    for (const char* key : {"quantity", "unit", "gain", "offset", "levels", "readings", "full_scale"}) {
        out[key] = (*found)->value(key, Json());
    }
    return out;
}

Result<Json> plotCalibration(ScriptSession&, const Json& list) {
    return figureOf("plot.calibration", list, "measured");
}
Result<Json> plotResiduals(ScriptSession&, const Json& list) { return figureOf("plot.residuals", list, "errors"); }

}  // namespace

std::vector<HostFunction> calibrationFunctions() {
    constexpr std::string_view kFound = "from analysis.calibration()";
    return {
        {"bench",
         "setEncoding",
         HostKind::Function,
         {{"changes", "object", "",
           "keys of a profile's encoding section (amplitude_min_v, interval_max_s, phase_width_us, ...)"}},
         "Changes how R and P become a train, for the rest of the run. The output must be disarmed.",
         "",
         "Throws while armed; for an unknown key, a wrong type, or a range that does not fit.",
         setEncoding},
        {"measure",
         "pulse",
         HostKind::Function,
         {{"captures", "list", "", "from bench.capture(), in time order"}},
         "One reading for a calibration: what came out beside what was commanded, and what the oscilloscope states of "
         "itself.",
         "{ unit, amplitude, interval_s, width_s, gap_s, trains, warnings, commanded: { amplitude, interval_s, "
         "width_s, "
         "gap_s }, instrument: { gain_tolerance, offset_tolerance, resolution, sampling_step_s, full_scale }, "
         "load_ohm, load_limit, captures, reading }: reading is its number in this run, for analysis.calibration(); "
         "amplitude in unit, V or mA by the stimulator's source; what could not be "
         "measured or is not stated is null; load_limit is the relative half-width that both channels state.",
         "Throws for captures that are held no longer, or without the channel that is read.",
         pulse},
        {"analysis",
         "calibration",
         HostKind::Function,
         {{"readings", "list", "",
           "objects with commanded, measured and direction (up, down); where each has a reading, the number from "
           "measure.pulse(), the program's own record of that reading counts in place of the two values"},
          {"options.quantity", "text", "", "what was calibrated; amplitude where left out", true},
          {"options.unit", "text", "", "of the readings", true},
          {"options.tolerance_pct", "number", "%", "of the command at each level; 2 where left out", true},
          {"options.gain_tolerance", "number", "", "of the instrument, relative half-width", true},
          {"options.offset_tolerance", "number", "as the readings", "of the instrument, half-width", true},
          {"options.resolution", "number", "as the readings", "one step of the instrument", true},
          {"options.load_tolerance", "number", "", "relative half-width", true},
          {"options.load_sensitivity", "number", "", "relative change of a reading per relative change of the load",
           true},
          {"options.sampling_step", "number", "s", "of the record, for widths and intervals", true},
          {"options.same_level", "number", "", "commands this close, relative to the largest, are one level", true}},
         "Fits measured against commanded, works out the uncertainty and judges each level with a guard band. Of own "
         "readings the uncertainty holds at least what the oscilloscope states.",
         "{ gain, offset, residual_max_pct_fs, repeatability_pct_fs, hysteresis_pct_fs, expanded_uncertainty, verdict, "
         "verdict_iec (± 20 %), reasons, levels, readings with outlier, budget: { rows }, calibration, ... }; "
         "calibration is its number for record.calibration(), null where a reading is not the program's own.",
         "Throws for fewer than two levels, or where nothing was repeated.",
         calibration},
        {"plot",
         "calibration",
         HostKind::Function,
         {{"found", "object", "", kFound}},
         "Measured against commanded, with the fitted line.",
         "A figure, for report.figure().",
         "",
         plotCalibration},
        {"plot",
         "residuals",
         HostKind::Function,
         {{"found", "object", "", kFound}},
         "Errors against the command, up and down, with their uncertainty and the tolerance band.",
         "A figure, for report.figure().",
         "",
         plotResiduals},
    };
}

}  // namespace tacto
