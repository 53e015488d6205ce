// Fits a line through the readings of a calibration, with its uncertainty.
#include <cmath>
#include <optional>

#include "app/scripting/host/analysis/RunAnalysis.h"
#include "core/analysis/calibration/CalibrationJson.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/JsonText.h"

namespace tacto::host::analysis {

namespace {

/// Returns the numbers of the run's own readings in `rows`, or nothing if a row has no number.
std::optional<std::vector<std::int64_t>> ownNumbers(const Json& rows) {
    std::vector<std::int64_t> numbers;
    for (const auto& row : rows) {
        const Json number = row.is_object() ? row.value("reading", Json()) : Json();
        if (!number.is_number_integer()) return std::nullopt;
        numbers.push_back(number.get<std::int64_t>());
    }
    return numbers;
}

/// Levels of a stored calibration are distinguished at least this finely, relative to the largest level.
constexpr double kWidestLevel = 0.05;

/// A calibration made of the run's own readings: commands, readings and the instrument's statements come from the
/// program, whatever else the rows say. `errors` are enlarged to what the instrument states, never reduced.
class OwnSeries {
public:
    OwnSeries(ScriptSession& session, const OwnQuantity& quantity, std::vector<std::int64_t> numbers,
              std::vector<const OwnReading*> readings)
        : session_(session), quantity_(quantity), readings_(std::move(readings)) {
        made_.quantity = quantity.id;
        made_.readings = std::move(numbers);
        for (const auto* reading : readings_) {
            for (const auto& command : reading->commands) {
                made_.simulated = made_.simulated || command.simulated;
                made_.calibrationApplied = made_.calibrationApplied || command.calibrationApplied;
            }
        }
    }

    /// Errors: InvalidArgument for a reading with captures of different commands or with an unknown command.
    [[nodiscard]] Result<void> fill(std::vector<CalibrationReading>& rows) const {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto& commands = readings_[i]->commands;
            const double commanded = commands.back().*quantity_.commanded;
            for (const auto& command : commands) {
                if (std::abs(command.*quantity_.commanded - commanded) <= 1e-9 * std::abs(commanded)) continue;
                return fail(ErrorCode::InvalidArgument,
                            "analysis.calibration: reading {} has captures of different commands of {}; one command is "
                            "expected",
                            made_.readings[i], quantity_.id);
            }
            rows[i].commanded = commanded;
            rows[i].measured = numberOr(readings_[i]->read[quantity_.reading]);
        }
        return {};
    }

    /// Captures carry the operator's statement, or else the instrument's. Anything else is unknown, whatever a script
    /// says about it.
    void widen(InstrumentErrors& errors) {
        const bool amplitude = quantity_.isAmplitude();
        const double stated = worst(amplitude ? &OwnReading::gainTolerance : &OwnReading::timeBaseTolerance);
        if (!std::isnan(stated)) {
            const auto said = session_.operatorsNumber(amplitude ? "scope_gain_pct" : "timebase_ppm");
            made_.statedBy = said && *said > 0 ? "the operator" : "the instrument";
            made_.gainTolerance = stated;
        }
        widenTo(errors.gainTolerance, stated);
        errors.offsetTolerance = 0;  // levels are measured from their own baseline
        if (amplitude) {
            widenTo(errors.probeTolerance, worst(&OwnReading::probeTolerance));
            widenTo(errors.linearityTolerance, worst(&OwnReading::linearityTolerance));
            widenTo(errors.resolution, worst(&OwnReading::resolution));
            errors.fullScale = readings_.front()->fullScale;
        } else {
            errors.resolution = 0;
            if (quantity_.id == kCalibratedInterval.id)
                widenTo(errors.stampTolerance, worst(&OwnReading::stampTolerance_s));
            widenTo(errors.samplingStep, worst(&OwnReading::samplingStep_s));
        }
        errors.unit = amplitude ? readings_.front()->unit : "s";
    }

    [[nodiscard]] std::int64_t keep(const Json& found) {
        made_.found = found;
        return session_.own().add(std::move(made_));
    }

private:
    /// Returns the largest value of all readings; NaN if one reading does not state it.
    [[nodiscard]] double worst(double OwnReading::*member) const {
        double most = 0;
        for (const auto* reading : readings_) {
            if (std::isnan(reading->*member)) return kNaN;
            most = std::max(most, reading->*member);
        }
        return most;
    }
    /// A script's own figure may enlarge the stated error but cannot replace it.
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

Result<std::vector<CalibrationReading>> readingsGiven(const Json& rows) {
    constexpr const char* kFunction = "analysis.calibration";
    std::vector<CalibrationReading> readings;
    for (const auto& row : rows) {
        CalibrationReading reading;
        reading.commanded = numberOr(row, "commanded");
        if (!std::isfinite(reading.commanded))
            return otherThanExpected(kFunction, "a reading", row, "an object with commanded, measured and direction");
        reading.measured = numberOr(row, "measured");
        const auto given = row.value("direction", Json(""));
        const auto direction =
            given.is_string() ? valueFor(kSweepDirections, given.get_ref<const std::string&>()) : std::nullopt;
        if (!direction) return otherThanExpected(kFunction, "direction", given, "\"up\", \"down\" or \"\"");
        reading.direction = *direction;
        readings.push_back(reading);
    }
    return readings;
}

}  // namespace

Result<Json> calibrationOf(ScriptSession& session, const Json& rows, const CalibrationAsked& asked) {
    auto readings = readingsGiven(rows);
    if (!readings) return failure(readings);
    auto fit = asked.fit;
    auto errors = asked.errors;
    auto own = ownSeries(session, rows, asked.quantity);
    if (!own) return failure(own);
    if (*own) {
        if (fit.sameLevel > kWidestLevel)
            return otherThanExpected("analysis.calibration", "same_level", fit.sameLevel,
                                     fmt::format("at most {}", kWidestLevel));
        if (auto filled = (*own)->fill(*readings); !filled) return failure(filled);
        (*own)->widen(errors);
    }
    fit.resolution = std::max(errors.samplingStep, std::isnan(errors.resolution) ? 0 : errors.resolution);
    auto found = fitCalibration(*readings, fit);
    if (!found) return failure(found);
    BudgetOptions budget;
    budget.seed = session.request().seed;
    auto judged = judgeCalibration(std::move(*found), errors, asked.tolerance_pct, budget);
    if (!judged) return failure(judged);
    constexpr double kIec_pct = 20;  // IEC 60601-2-10: output within ± 20 % of what is set
    Json out = toJson(*judged);
    out["quantity"] = asked.quantity;
    out["unit"] = errors.unit;
    out["verdict_iec"] = nameOf(verdictAt(*judged, kIec_pct));
    out["calibration"] = *own ? Json((*own)->keep(out)) : Json();
    return out;
}

namespace {

Result<Json> calibration(ScriptSession& session, const Arguments& arguments) {
    const auto stated = [&arguments](std::string_view name, double usual) {
        return arguments.isNull(name) ? kNaN : arguments.number(name, usual);
    };
    CalibrationAsked asked;
    asked.quantity = arguments.text("options.quantity");
    asked.tolerance_pct = stated("options.tolerance_pct", asked.tolerance_pct);
    asked.fit.sameLevel = stated("options.same_level", asked.fit.sameLevel);
    auto& errors = asked.errors;
    errors.unit = arguments.text("options.unit");
    errors.gainTolerance = stated("options.gain_tolerance", errors.gainTolerance);
    errors.probeTolerance = stated("options.probe_tolerance", errors.probeTolerance);
    errors.offsetTolerance = stated("options.offset_tolerance", errors.offsetTolerance);
    errors.resolution = stated("options.resolution", errors.resolution);
    errors.loadTolerance = stated("options.load_tolerance", errors.loadTolerance);
    errors.loadSensitivity = stated("options.load_sensitivity", errors.loadSensitivity);
    errors.samplingStep = stated("options.sampling_step", errors.samplingStep);
    return calibrationOf(session, arguments.list("readings"), asked);
}

}  // namespace

}  // namespace tacto::host::analysis

namespace tacto {

std::vector<HostFunction> calibrationAnalysis() {
    using namespace takes;
    constexpr double kLargest = 1e9;  // largest tolerance
    return {
        {.name = "calibration",
         .parameters =
             {list("readings",
                   "objects with commanded, measured and direction (up, down); where each has a reading, the number "
                   "from measure.pulse(), the program's own record of that reading counts in place of the two values"),
              text("options.quantity", "what was calibrated").otherwise("amplitude"),
              text("options.unit", "of the readings").optional(),
              number("options.tolerance_pct", "%", "of the command at each level")
                  .range(0, kLargest)
                  .orNull()
                  .optional("2 %"),
              number("options.gain_tolerance", "", "of the instrument, relative half-width")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.probe_tolerance", "", "of the probe, relative half-width")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.offset_tolerance", "as the readings", "of the instrument, half-width")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.resolution", "as the readings", "one step of the instrument")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.load_tolerance", "", "relative half-width").range(0, kLargest).orNull().optional(),
              number("options.load_sensitivity", "", "relative change of a reading per relative change of the load")
                  .range(-10, kLargest)
                  .orNull()
                  .optional(),
              number("options.sampling_step", "s", "of the record, for widths and intervals")
                  .range(0, kLargest)
                  .orNull()
                  .optional(),
              number("options.same_level", "", "commands this close, relative to the largest, are one level")
                  .range(0, kLargest)
                  .orNull()
                  .optional()},
         .text = "Fits measured against commanded, works out the uncertainty and judges each level with a guard band. "
                 "The uncertainty of own readings is at least what the oscilloscope states.",
         .members = judgedMembers(),
         .returns = " with quantity, unit, verdict_iec (± 20 %) and calibration, which is its number for "
                    "record.calibration(), null where a reading is not the program's own.",
         .errors = "Throws for fewer than two levels, or where nothing was repeated.",
         .call = host::analysis::calibration},
    };
}

}  // namespace tacto
