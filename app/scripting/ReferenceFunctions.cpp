// Before anything is believed: the wiring as drawn, and a known load that must read as what it is.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"
#include "core/session/SessionWriter.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

bool isSimulated(const DeviceSet& devices) {
    const auto all = devices.identities();
    return std::all_of(all.begin(), all.end(), [](const DeviceIdentity& device) { return device.simulated; });
}

Result<Json> wired(ScriptSession& session, const Json& list) {
    const Arguments arguments("operator.wired", list);
    std::string load = "Connected";
    if (!arguments.at(0).is_null()) {
        const auto ohm = arguments.number(0, "load", {.min = 0});
        if (!ohm) return failure(ohm);
        load = fmt::format("The load of {} ohm is connected", *ohm);
    }
    if (!isSimulated(session.bench().devices())) {
        OperatorQuestion question;
        question.name = "wiring";
        question.text = load +
                        " as drawn: both oscilloscope grounds at one node, the shunt in the low side, its drop "
                        "subtracted from the voltage; no person is connected";
        question.drawing = "wiring";
        return session.ask(question);
    }
    if (session.writer() == nullptr) return Json(true);
    auto written = session.writer()->reportItem(
        session.now(), {{"kind", "text"}, {"text", "Wiring: the simulated bench, wired as the drawing shows."}});
    if (!written) return failure(written);
    return Json(true);
}

Result<Json> reference(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.reference", list);
    const auto reading = arguments.object(0, "reading");
    if (!reading) return failure(reading);
    const auto load = arguments.number(1, "load", {.min = 1e-3});
    if (!load) return failure(load);
    const auto tolerance_pct = arguments.number(2, "tolerance", {.min = 0, .max = 100});
    if (!tolerance_pct) return failure(tolerance_pct);
    const double measured =
        (*reading)->value("load_ohm", Json()).is_number() ? (**reading)["load_ohm"].get<double>() : std::nan("");
    const Json limit = (*reading)->value("load_limit", Json());
    const double allowed_pct = *tolerance_pct + 100 * (limit.is_number() ? limit.get<double>() : 0);
    const double off_pct = 100 * (measured / *load - 1);
    // Written so that what was not measured (NaN) has not passed.
    const bool passed = std::abs(off_pct) <= allowed_pct;
    const Json check = {{"load_ohm", *load},
                        {"measured_ohm", numberOrNull(measured)},
                        {"deviation_pct", numberOrNull(off_pct)},
                        {"allowed_pct", allowed_pct},
                        {"passed", passed}};
    if (session.writer() != nullptr) {
        auto& writer = *session.writer();
        if (auto kept = writer.measurement(session.now(), "known-reference check", check); !kept) return failure(kept);
        auto shown = writer.reportItem(
            session.now(), {{"kind", "table"},
                            {"caption", "Known-reference check"},
                            {"rows", Json::array({check})},
                            {"columns", {"load_ohm", "measured_ohm", "deviation_pct", "allowed_pct", "passed"}}});
        if (!shown) return failure(shown);
    }
    Json out = check;
    out["reason"] = passed ? Json()
                           : Json(fmt::format("the known-reference check failed: {} was measured where {:.4g} ohm ± "
                                              "{:.2g} % is connected",
                                              std::isnan(measured) ? "nothing" : fmt::format("{:.4g} ohm", measured),
                                              *load, allowed_pct));
    return out;
}

}  // namespace

std::vector<HostFunction> referenceFunctions() {
    return {
        {"operator",
         "wired",
         HostKind::Function,
         {{"load", "number", "ohm", "the load that is to be connected", true}},
         "Shows how to wire load, shunt and oscilloscope, and waits until the operator confirms \"wiring\". A "
         "simulated bench is wired; the report says so and nobody is asked.",
         "true",
         "Throws when nobody is here and --set wiring=yes was not given, or when the run is stopped.",
         wired},
        {"record",
         "reference",
         HostKind::Function,
         {{"reading", "object", "", "from measure.pulse(), of a load that is known"},
          {"load", "number", "ohm", "what is connected"},
          {"tolerance", "number", "%", "of the load; what the instruments may add is in the reading"}},
         "Judges whether a known load reads as what it is, and records that: instruments that cannot tell it can judge "
         "nothing else.",
         "{ load_ohm, measured_ohm, deviation_pct, allowed_pct, passed, reason }: reason is a sentence where it "
         "failed, else null; a load that could not be measured has not passed.",
         "Throws when the session file cannot be written.",
         reference},
    };
}

}  // namespace tacto
