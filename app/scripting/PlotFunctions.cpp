// Figures of the report, as data; app/report/Figure.h says what each holds.
#include <algorithm>
#include <cmath>

#include "app/scripting/Arguments.h"
#include "app/scripting/GivenCaptures.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Result<Json> member(const Arguments& arguments, const char* key) {
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    if (!(*found)->value(key, Json()).is_array()) {
        return arguments.wrong("found", **found, fmt::format("a result with {}", key));
    }
    return (**found)[key];
}

Json samplesOf(const CaptureChannel& channel) {
    Json out = Json::array();
    for (const float sample : channel.samples) {
        out.push_back(std::isfinite(sample) ? Json(static_cast<double>(sample)) : Json());
    }
    return out;
}

/// The condition as captured: where its trains begin and how far each reaches, and the samples of the first.
void addLane(Json& condition, const std::vector<Capture>& captures) {
    Json trains = Json::array();
    double first_s = std::nan("");
    for (const auto& capture : captures) {
        const auto voltage = std::ranges::find(capture.channels, "V", &CaptureChannel::unit);
        if (voltage == capture.channels.end() || !std::isfinite(capture.trigger_s)) continue;
        double low = std::nan(""), high = std::nan("");
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

Result<Json> conditionsFigure(ScriptSession& session, const Json& list) {
    const Arguments arguments("plot.conditions", list);
    auto found = member(arguments, "conditions");
    if (!found) return found;
    const Json lanes = arguments.at(1);
    if (lanes.is_null()) return Json{{"type", "conditions"}, {"conditions", *found}};
    if (!lanes.is_object()) return arguments.wrong("captures", lanes, "an object of captures by condition");
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

Result<Json> plane(ScriptSession&, const Json& list) {
    const Arguments arguments("plot.plane", list);
    auto trials = arguments.at(0).is_array() ? Result<Json>(arguments.at(0)) : member(arguments, "trials");
    if (!trials) return trials;
    return Json{{"type", "plane"}, {"trials", *trials}};
}

Result<Json> confusion(ScriptSession&, const Json& list) {
    const Arguments arguments("plot.confusion", list);
    auto counts = member(arguments, "confusion");
    if (!counts) return counts;
    auto rows = member(arguments, "conditions");
    if (!rows) return rows;
    Json labels = Json::array();
    for (const auto& row : *rows) labels.push_back(row.value("name", ""));
    return Json{{"type", "confusion"},
                {"labels", labels},
                {"confusion", *counts},
                {"accuracy", arguments.at(0).value("accuracy", Json())}};
}

Result<Json> waveforms(ScriptSession& session, const Json&) {
    Json captures = Json::array();
    for (const auto& exemplar : session.exemplars()) {
        Json entry = {{"condition", exemplar.condition}};
        if (exemplar.row) {
            entry["capture"] = *exemplar.row;
        } else {
            const double origin = std::isfinite(exemplar.capture.trigger_s) ? exemplar.capture.trigger_s : 0;
            entry["rate_hz"] = exemplar.capture.rate_hz;
            entry["start_s"] = exemplar.capture.start_s - origin;
            for (const auto& channel : exemplar.capture.channels) {
                if (channel.unit == "V") entry["voltage_v"] = samplesOf(channel);
                if (channel.unit == "A") entry["current_a"] = samplesOf(channel);
            }
        }
        captures.push_back(std::move(entry));
    }
    return Json{{"type", "waveforms"}, {"captures", captures}};
}

Result<Json> exposureFigure(ScriptSession& session, const Json& list) {
    const Arguments arguments("plot.exposure", list);
    if (arguments.at(0).is_null()) return Json{{"type", "exposure"}, {"rows", session.worstExposure()}};
    auto rows = arguments.list(0, "rows");
    if (!rows) return failure(rows);
    return Json{{"type", "exposure"}, {"rows", **rows}};
}

Result<Json> timeline(ScriptSession&, const Json& list) {
    const Arguments arguments("plot.timeline", list);
    auto states = arguments.list(0, "states");
    if (!states) return failure(states);
    Json t = Json::array(), r = Json::array(), p = Json::array(), a = Json::array();
    for (const auto& state : **states) {
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

}  // namespace

std::vector<HostFunction> plotFunctions() {
    constexpr std::string_view kFigure = "A figure, for report.figure().";
    return {
        {"plot",
         "conditions",
         HostKind::Function,
         {{"found", "object", "", "from analysis.separability()"},
          {"captures", "object", "",
           "lists from bench.capture(), by the condition's name: consecutive trains of each, drawn as captured in "
           "lettered lanes; left out: drawn from the means",
           true}},
         "The conditions: trains as captured, a lane for each; or from the means, texture alone, pressure alone, the "
         "two combined.",
         kFigure,
         "",
         conditionsFigure},
        {"plot",
         "plane",
         HostKind::Function,
         {{"found", "object or list", "",
           "from analysis.separability(), or trials with condition, amplitude_v, interval_s"}},
         "Amplitude against interval, a point per trial.",
         kFigure,
         "",
         plane},
        {"plot",
         "confusion",
         HostKind::Function,
         {{"found", "object", "", "from analysis.separability()"}},
         "Presented against recognised condition.",
         kFigure,
         "",
         confusion},
        {"plot",
         "waveforms",
         HostKind::Function,
         {},
         "The first capture of each condition that was recorded as a trial.",
         kFigure,
         "",
         waveforms},
        {"plot",
         "exposure",
         HostKind::Function,
         {{"rows", "list", "", "from bench.exposure(); the run's largest where left out", true}},
         "Exposure against its limits.",
         kFigure,
         "",
         exposureFigure},
        {"plot",
         "timeline",
         HostKind::Function,
         {{"states", "list", "", "from bench.live(), in time order"}},
         "Roughness, pressure and amplitude over time.",
         kFigure,
         "",
         timeline},
    };
}

}  // namespace tacto
