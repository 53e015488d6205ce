// Measuring captures, and judging what was measured.
#include <cmath>

#include "app/scripting/CaptureClock.h"
#include "app/scripting/GivenCaptures.h"
#include "app/scripting/HostFunction.h"
#include "core/analysis/ResultJson.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// NaN when one of them is unknown.
double worstTimeBase(const std::vector<Capture>& captures) {
    double worst = 0;
    for (const auto& capture : captures) {
        const double u = timeBaseUncertainty(capture);
        if (!(u <= worst)) worst = u;
        if (std::isnan(worst)) break;
    }
    return worst;
}

/// The time base is handed on by itself: it is the same in all trials.
double intervalWithoutTimeBase(const ChannelMeasurement& channel, double timeBase) {
    const double base = timeBase * channel.interval_s.mean, all = channel.uncertainty.interval_s;
    const double rest = all * all - base * base;
    return std::sqrt(rest < 0 ? 0 : rest);  // what is not known stays so
}

Result<Json> train(ScriptSession& session, const Json& list) {
    const Arguments arguments("measure.train", list);
    auto given = capturesGiven(session, arguments);
    if (!given) return failure(given);
    if (given->captures.empty()) return arguments.wrong("captures", arguments.at(0), "at least one capture");
    const auto& captures = given->captures;
    const auto options = optionsFor(session.bench().profile().encoding.train);

    auto voltage = measureTrains(captures, "voltage", options);
    if (!voltage) return failure(voltage);
    Json out = {{"amplitude_v", numberOrNull(meanOfTrains(*voltage, &TrainMeasurement::amplitude))},
                {"amplitude_u_v", numberOrNull(voltage->uncertainty.amplitude)},
                {"interval_s", numberOrNull(meanOfTrains(*voltage, &TrainMeasurement::interval_s))},
                {"interval_u_s", numberOrNull(intervalWithoutTimeBase(*voltage, worstTimeBase(captures)))},
                {"time_base_u", numberOrNull(worstTimeBase(captures))},
                {"width_s", numberOrNull(meanOfTrains(*voltage, &TrainMeasurement::width_s))},
                {"trains", voltage->trains.size()},
                {"pulses", voltage->measuredPulses},
                {"warnings", voltage->warnings},
                {"captures", given->ids}};
    if (auto current = measureTrains(captures, "current", options)) {
        out["amplitude_ma"] = numberOrNull(1e3 * meanOfTrains(*current, &TrainMeasurement::amplitude));
        out["charge_uc"] = numberOrNull(1e6 * meanOfTrains(*current, &TrainMeasurement::charge));
        out["imbalance"] = numberOrNull(meanOfTrains(*current, &TrainMeasurement::imbalance));
    }
    return out;
}

Result<Json> separability(ScriptSession&, const Json& list) {
    const Arguments arguments("analysis.separability", list);
    auto rows = arguments.list(0, "trials");
    if (!rows) return failure(rows);
    std::vector<SeparabilityTrial> trials;
    Json features = Json::array();
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.value("condition", Json()).is_string()) {
            return arguments.wrong("a trial", row, "an object with a condition, from record.trials(),");
        }
        const auto value = [&row](const char* key) {
            const auto at = row.find(key);
            return at != row.end() && at->is_number() ? at->get<double>() : std::nan("");
        };
        SeparabilityTrial trial;
        trial.condition = row["condition"].get<std::string>();
        trial.amplitude = value("amplitude_v");
        trial.interval_s = value("interval_s");
        trial.amplitudeUncertainty = value("amplitude_u_v");
        trial.intervalUncertainty_s = value("interval_u_s");
        trial.timeBase = value("time_base_u");
        features.push_back({{"condition", trial.condition},
                            {"amplitude_v", numberOrNull(trial.amplitude)},
                            {"interval_s", numberOrNull(trial.interval_s)},
                            {"amplitude_u_v", numberOrNull(trial.amplitudeUncertainty)},
                            {"interval_u_s", numberOrNull(trial.intervalUncertainty_s)},
                            {"time_base_u", numberOrNull(trial.timeBase)}});
        trials.push_back(std::move(trial));
    }
    SeparabilityOptions options;
    if (auto expected = arguments.options(1, {"conditions"}); !expected) {
        return failure(expected);
    } else if (expected->contains("conditions")) {
        for (const auto& name : (*expected)["conditions"]) {
            if (!name.is_string()) return arguments.wrong("conditions", (*expected)["conditions"], "a list of names");
            options.conditions.push_back(name.get<std::string>());
        }
    }
    auto found = judgeSeparability(trials, options);
    if (!found) return failure(found);
    Json out = toJson(*found);
    out["trials"] = features;
    return out;
}

}  // namespace

std::vector<HostFunction> measureFunctions() {
    return {
        {"measure",
         "train",
         HostKind::Function,
         {{"captures", "list", "", "from bench.capture(), in time order"}},
         "Measures what was delivered: amplitude, width, charge of each train, and the interval from onset to onset.",
         "{ amplitude_v, amplitude_u_v, amplitude_ma, interval_s, interval_u_s, time_base_u, width_s, charge_uc, "
         "imbalance, trains, "
         "pulses, warnings, captures }: means over the trains; _u_ is the standard uncertainty of a reading, "
         "time_base_u "
         "that of the time base, relative; what "
         "could not be measured is null, the interval of a single train among it.",
         "Throws for captures that are held no longer, or without a voltage channel.",
         train},
        {"analysis",
         "separability",
         HostKind::Function,
         {{"trials", "list", "",
           "objects with condition, amplitude_v, interval_s, and their uncertainties amplitude_u_v, interval_u_s, "
           "time_base_u, without which the verdict cannot be a pass; from record.trials()"},
          {"options", "object", "", "conditions: the names that must all be there, else the verdict cannot be a pass"}},
         "Judges whether the conditions can be told apart from what was measured.",
         "{ verdict, reasons, conditions, pairs, confusion, accuracy, folds, trials }, for plot.* and verdict().",
         "Throws for fewer than two conditions, or a value that is not above zero.",
         separability},
    };
}

}  // namespace tacto
