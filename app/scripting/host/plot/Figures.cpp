// Figures of measured results.
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/host/plot/PlotFigures.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/Statistics.h"

namespace tacto::host::plot {

namespace {

Result<Json> member(const Arguments& arguments, const Json& found, const char* key) {
    if (!found.is_object() || !found.value(key, Json()).is_array())
        return arguments.wrong("found", found, fmt::format("a result with {}", key));
    return found[key];
}

Json samplesOf(const CaptureChannel& channel) {
    Json out = Json::array();
    for (const float sample : channel.samples) {
        out.push_back(std::isfinite(sample) ? Json(static_cast<double>(sample)) : Json());
    }
    return out;
}

/// Adds the capture to `entry`: the number of the row that keeps it, or its samples.
Json withCapture(Json entry, const ScriptSession::Exemplar& exemplar) {
    if (exemplar.row) {
        entry["capture"] = *exemplar.row;
        return entry;
    }
    const auto& capture = exemplar.capture;
    entry["rate_hz"] = capture.rate_hz;
    entry["start_s"] = capture.start_s - (std::isfinite(capture.trigger_s) ? capture.trigger_s : 0);
    for (const auto& channel : capture.channels) {
        if (channel.unit == "V") entry["voltage_v"] = samplesOf(channel);
        if (channel.unit == "A") entry["current_a"] = samplesOf(channel);
    }
    return entry;
}

/// Adds the captured trains to a condition: onset and length of each, and the samples of the first.
void addLane(Json& condition, const std::vector<Capture>& captures) {
    Json trains = Json::array();
    double first_s = kNaN;
    for (const auto& capture : captures) {
        const auto voltage = std::ranges::find(capture.channels, "V", &CaptureChannel::unit);
        if (voltage == capture.channels.end() || !std::isfinite(capture.trigger_s)) continue;
        double low = kNaN, high = kNaN;
        for (const float sample : voltage->samples) {
            low = std::fmin(low, sample);
            high = std::fmax(high, sample);
        }
        if (trains.empty()) {
            first_s = capture.trigger_s;
            condition["pulse"] = {{"rate_hz", capture.rate_hz},
                                  {"start_s", capture.start_s - capture.trigger_s},
                                  {"voltage_v", samplesOf(*voltage)}};
        }
        trains.push_back(
            {{"onset_s", capture.trigger_s - first_s}, {"low_v", numberOrNull(low)}, {"high_v", numberOrNull(high)}});
    }
    condition["trains"] = std::move(trains);
}

}  // namespace

Json calibrationFigure(const Json& found, const char* view) {
    Json out = {{"type", "calibration"}, {"view", view}};
    for (const char* key : {"quantity", "unit", "gain", "offset", "levels", "readings", "full_scale"})
        out[key] = found.value(key, Json());
    return out;
}

Json tracingsFigure(ScriptSession& session, const std::vector<Tracing>& tracings) {
    Json captures = Json::array();
    for (const auto& [condition, label] : tracings) {
        for (const auto& exemplar : session.exemplars()) {
            if (exemplar.condition == condition) captures.push_back(withCapture({{"label", label}}, exemplar));
        }
    }
    return {{"type", "waveforms"}, {"captures", std::move(captures)}};
}

namespace {

Result<Json> conditionsFigure(ScriptSession& session, const Arguments& arguments) {
    auto found = member(arguments, arguments.object("found"), "conditions");
    if (!found) return found;
    if (!arguments.has("captures")) return Json{{"type", "conditions"}, {"conditions", *found}};
    const Json& lanes = arguments.object("captures");
    char letter = 'A';
    for (auto& condition : *found) {
        const std::string name = condition.value("name", "");
        condition["letter"] = std::string(1, letter);
        if (letter < 'Z') ++letter;
        const Json handles = lanes.value(name, Json::array());
        if (!handles.is_array()) return arguments.wrong("captures", handles, "from bench.capture()");
        const auto held = session.held(handles);
        if (!held) return failure(held);
        std::vector<Capture> captures;
        for (const auto* capture : *held) captures.push_back(*capture);
        addLane(condition, captures);
    }
    return Json{{"type", "conditions"}, {"conditions", *found}};
}

Result<Json> plane(ScriptSession&, const Arguments& arguments) {
    const Json& given = arguments.any("found");
    auto trials = given.is_array() ? Result<Json>(given) : member(arguments, given, "trials");
    if (!trials) return trials;
    return Json{{"type", "plane"}, {"trials", *trials}};
}

Result<Json> confusion(ScriptSession&, const Arguments& arguments) {
    auto counts = member(arguments, arguments.object("found"), "confusion");
    if (!counts) return counts;
    auto rows = member(arguments, arguments.object("found"), "conditions");
    if (!rows) return rows;
    Json labels = Json::array();
    for (const auto& row : *rows) labels.push_back(row.value("name", ""));
    return Json{{"type", "confusion"},
                {"labels", labels},
                {"confusion", *counts},
                {"accuracy", arguments.object("found").value("accuracy", Json())}};
}

Result<Json> curves(ScriptSession&, const Arguments& arguments) {
    Json figure = arguments.object("figure");
    for (const char* axis : {"x", "y"}) {
        if (!figure.value(axis, Json()).is_object())
            return arguments.wrong("figure", figure, fmt::format("an object with the axis {}", axis));
    }
    if (!figure.value("curves", Json()).is_array())
        return arguments.wrong("figure", figure, "an object with a list of curves");
    figure["type"] = "curves";
    return figure;
}

Result<Json> waveforms(ScriptSession& session, const Arguments&) {
    Json captures = Json::array();
    for (const auto& exemplar : session.exemplars()) {
        captures.push_back(withCapture({{"condition", exemplar.condition}}, exemplar));
    }
    return Json{{"type", "waveforms"}, {"captures", std::move(captures)}};
}

Result<Json> exposureFigure(ScriptSession& session, const Arguments& arguments) {
    return Json{{"type", "exposure"},
                {"rows", arguments.has("rows") ? arguments.list("rows") : session.worstExposure()}};
}

Result<Json> timeline(ScriptSession&, const Arguments& arguments) {
    const Json& states = arguments.list("states");
    Json t = Json::array(), r = Json::array(), p = Json::array(), a = Json::array();
    for (const auto& state : states) {
        if (!state.is_object() || !state.value("time_s", Json()).is_number()) {
            return arguments.wrong("a state", state, "what bench.live() returned");
        }
        t.push_back(state["time_s"]);
        r.push_back(state.value("roughness", Json()));
        p.push_back(state.value("pressure", Json()));
        a.push_back(state.value("amplitude_v", Json()));
    }
    return Json{{"type", "timeline"}, {"t_s", t}, {"r", r}, {"p", p}, {"amplitude_v", a}};
}

Result<Json> plotTransitions(ScriptSession&, const Arguments& arguments) {
    const Json& found = arguments.object("found");
    for (const char* key : {"amplitude_map", "interval_map", "gradual", "wanted_jnd"}) {
        if (!found.contains(key)) return arguments.wrong("found", found, "what analysis.transitions() returned");
    }
    const Json& gradual = found["gradual"];
    const auto place = [&gradual](const char* axis) {
        const Json at = gradual.value(axis, Json::object());
        return Json{{"roughness", at.value("roughness", Json())},
                    {"pressure", at.value("pressure", Json())},
                    {"jnd", at.value("jnd", Json())}};
    };
    return Json{{"type", "transitions"},
                {"wanted_jnd", found["wanted_jnd"]},
                {"amplitude", found["amplitude_map"]},
                {"interval", found["interval_map"]},
                {"largest_amplitude", place("amplitude")},
                {"largest_interval", place("interval")}};
}

Result<Json> plotCalibration(ScriptSession&, const Arguments& arguments) {
    const Json& found = arguments.object("found");
    if (!found.value("levels", Json()).is_array())
        return arguments.wrong("found", found, "what analysis.calibration() returned");
    return calibrationFigure(found, "measured");
}

}  // namespace

}  // namespace tacto::host::plot

namespace tacto {

std::vector<HostFunction> plotFunctions() {
    using namespace takes;
    return {
        {.name = "conditions",
         .parameters = {object("found", "from analysis.separability()"),
                        object("captures",
                               "lists from bench.capture(), by the condition's name: consecutive trains of each, drawn "
                               "as captured in lettered lanes; left out: drawn from the means")
                            .optional()},
         .text = "The conditions: trains as captured, a lane for each; or from the means, texture alone, pressure "
                 "alone, the two combined.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::conditionsFigure},
        {.name = "plane",
         .parameters = {any("found",
                            "from analysis.separability(), or trials with condition, amplitude_v, interval_s")},
         .text = "Amplitude against interval, a point per trial.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::plane},
        {.name = "confusion",
         .parameters = {object("found", "from analysis.separability()")},
         .text = "Presented against recognised condition.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::confusion},
        {.name = "waveforms",
         .text = "The first capture of each condition that was recorded as a trial.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::waveforms},
        {.name = "exposure",
         .parameters = {list("rows", "from bench.exposure()").optional("the run's largest")},
         .text = "Exposure against its limits.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::exposureFigure},
        {.name = "timeline",
         .parameters = {list("states", "from bench.live(), in time order")},
         .text = "Roughness, pressure and amplitude over time.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::timeline},
        {.name = "curves",
         .parameters = {object("figure",
                               "{ x: { label, unit }, y: { label, unit }, curves: [{ label, x, y, low, high, steps }], "
                               "lines: [{ label, y }] }: lists of numbers, low and high for a band, lines to hold the "
                               "curves against")},
         .text = "Curves over one pair of axes, of up to 40 points each with its points.",
         .returns = "A figure, for report.figure().",
         .errors = "Throws where axes or curves are missing.",
         .call = host::plot::curves},
        {.name = "calibration",
         .parameters = {object("found", "from analysis.calibration()")},
         .text = "Measured against commanded, with the fitted line.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::plotCalibration},
        {.name = "transitions",
         .parameters = {object("found", "from analysis.transitions()")},
         .text = "The largest step per train over the R-P plane, amplitude and interval beside each other.",
         .returns = "A figure, for report.figure().",
         .call = host::plot::plotTransitions},
    };
}

}  // namespace tacto
