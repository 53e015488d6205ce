// Measures a delivered train, for trials.
#include <cmath>

#include "app/scripting/host/measure/Readings.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::host::measure {

namespace {

/// Returns the largest uncertainty of the time base; NaN if one capture does not state it.
double worstTimeBase(const std::vector<Capture>& captures) {
    double worst = 0;
    for (const auto& capture : captures) {
        const double u = timeBaseUncertainty(capture);
        if (!(u <= worst)) worst = u;
        if (std::isnan(worst)) break;
    }
    return worst;
}

/// Returns the relative uncertainty of the voltage gain, which all trials share; NaN if one trial does not state it.
double gainUncertainty(const std::vector<Capture>& captures) {
    double worst = 0;
    for (const auto& capture : captures) {
        const auto* voltage = channelOf(capture, "voltage");
        const double u = voltage != nullptr ? voltage->gainTolerance / std::sqrt(3.0) : kNaN;
        if (!(u <= worst)) worst = u;
        if (std::isnan(worst)) break;
    }
    return worst;
}

/// Leaves the time base out, which is the same in all trials and is handed on separately.
double intervalWithoutTimeBase(const ChannelMeasurement& channel, double timeBase) {
    const double base = timeBase * channel.interval_s.mean, all = channel.uncertainty.interval_s;
    const double rest = all * all - base * base;
    return std::sqrt(rest < 0 ? 0 : rest);  // an unknown value stays unknown
}

Result<Json> train(ScriptSession& session, const Arguments& arguments) {
    auto given = capturesGiven(session, arguments.list("captures"));
    if (!given) return failure(given);
    if (given->captures.empty()) return arguments.wrong("captures", arguments.list("captures"), "at least one capture");
    const auto& captures = given->captures;
    const auto options = optionsFor(session.bench().profile().encoding.train);

    auto voltage = measureTrains(captures, "voltage", options);
    if (!voltage) return failure(voltage);
    Json out = {{"amplitude_v", numberOrNull(meanOfTrains(*voltage, &TrainMeasurement::amplitude))},
                {"amplitude_u_v", numberOrNull(voltage->uncertainty.amplitude)},
                {"amplitude_gain_u", numberOrNull(gainUncertainty(captures))},
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

}  // namespace

}  // namespace tacto::host::measure

namespace tacto {

std::vector<HostFunction> trainFunctions() {
    using namespace takes;
    return {
        {.name = "train",
         .parameters = {list("captures", "from bench.capture(), in time order")},
         .text = "Measures what was delivered: amplitude, width, charge of each train, and the interval from onset to "
                 "onset.",
         .returns = "{ amplitude_v, amplitude_u_v, amplitude_gain_u, amplitude_ma, interval_s, interval_u_s, "
                    "time_base_u, width_s, charge_uc, imbalance, trains, pulses, warnings, captures }: means over the "
                    "trains; _u_ is the standard uncertainty of a reading, amplitude_gain_u the part of it that the "
                    "gain makes, relative, time_base_u that of the time base, relative; what could not be measured is "
                    "null, the interval of a single train among it.",
         .errors = "Throws for captures that are held no longer, or without a voltage channel.",
         .call = host::measure::train},
    };
}

}  // namespace tacto
