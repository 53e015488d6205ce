// Before anything is believed: the wiring as drawn, and a known load that must read as what it is.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "core/analysis/ResultJson.h"
#include "core/analysis/UncertaintyBudget.h"
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

/// What is wrong with a check that did not pass, as a sentence.
std::string whyNot(Verdict verdict, const Json& check, double load, double tolerance_pct) {
    const auto at = [&check](const char* key) { return check.value(key, Json()); };
    const auto text = [&](const char* key, const char* missing) {
        return at(key).is_number() ? fmt::format("{:.4g}", at(key).get<double>()) : std::string(missing);
    };
    if (at("measured_ohm").is_null()) {
        return fmt::format("the known-reference check failed: nothing was measured where {:.4g} ohm is connected",
                           load);
    }
    if (at("expanded_ohm").is_null()) {
        return fmt::format(
            "the known-reference check was not evaluated: {} ohm was measured on {:.4g} ohm, and how well the "
            "oscilloscope knows that is not stated",
            text("measured_ohm", ""), load);
    }
    return fmt::format(
        "the known-reference check {}: {} ± {} ohm was measured where {:.4g} ohm is connected; {:.2g} % "
        "of it is accepted, uncertainty included",
        verdict == Verdict::Fail ? "failed" : "is indeterminate", text("measured_ohm", ""), text("expanded_ohm", ""),
        load, tolerance_pct);
}

/// One rule everywhere: |reading - reference| + U ≤ tolerance (science.md section 12).
Result<Json> reference(ScriptSession& session, const Json& list) {
    const Arguments arguments("record.reference", list);
    const auto reading = arguments.object(0, "reading");
    if (!reading) return failure(reading);
    const auto load = arguments.number(1, "load", {.min = 1e-3});
    if (!load) return failure(load);
    const auto tolerance_pct = arguments.number(2, "tolerance", {.min = 0, .max = 100});
    if (!tolerance_pct) return failure(tolerance_pct);
    double load_pct = 0;
    if (!arguments.at(3).is_null()) {
        const auto given = arguments.number(3, "of the load", {.min = 0, .max = 100});
        if (!given) return failure(given);
        load_pct = *given;
    }
    const auto at = [&](const char* key) {
        const Json value = (*reading)->value(key, Json());
        return value.is_number() ? value.get<double>() : std::nan("");
    };
    const double measured = at("load_ohm");
    // 95 % of a rectangle of the resistor's own tolerance.
    const double expanded = std::hypot(at("load_expanded_ohm"), 0.95 * load_pct / 100 * *load);
    const double off_pct = 100 * (measured / *load - 1);
    const Verdict verdict = guardBanded(off_pct, 100 * expanded / *load, *tolerance_pct);
    const Json check = {{"load_ohm", *load},
                        {"measured_ohm", numberOrNull(measured)},
                        {"expanded_ohm", numberOrNull(expanded)},
                        {"deviation_pct", numberOrNull(off_pct)},
                        {"expanded_uncertainty_pct", numberOrNull(100 * expanded / *load)},
                        {"allowed_pct", *tolerance_pct},
                        {"passed", verdict == Verdict::Pass}};
    if (session.writer() != nullptr) {
        auto& writer = *session.writer();
        if (auto kept = writer.measurement(session.now(), "known-reference check", check); !kept) return failure(kept);
        auto shown = writer.reportItem(session.now(), {{"kind", "table"},
                                                       {"caption", "Known-reference check"},
                                                       {"rows", Json::array({check})},
                                                       {"columns",
                                                        {"load_ohm", "measured_ohm", "expanded_ohm", "deviation_pct",
                                                         "expanded_uncertainty_pct", "allowed_pct", "passed"}}});
        if (!shown) return failure(shown);
    }
    Json out = check;
    out["reason"] = verdict == Verdict::Pass ? Json() : Json(whyNot(verdict, check, *load, *tolerance_pct));
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
          {"tolerance", "number", "%", "how far the reading may lie from the load, its uncertainty included"},
          {"of the load", "number", "%", "the load's own tolerance; 0 where left out", true}},
         "Judges whether a known load reads as what it is, and records that: instruments that cannot tell it can judge "
         "nothing else.",
         "{ load_ohm, measured_ohm, expanded_ohm, deviation_pct, expanded_uncertainty_pct, allowed_pct, passed, reason "
         "}: "
         "passed when |deviation| + U is allowed; reason is a sentence where it did not pass, else null. What could "
         "not "
         "be measured, or has no uncertainty that anyone states, has not passed.",
         "Throws when the session file cannot be written.",
         reference},
    };
}

}  // namespace tacto
