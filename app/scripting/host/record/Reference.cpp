// Before anything is believed: a known load must read as what it is.
#include <cmath>
#include <string_view>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/record/RecordObject.h"
#include "app/scripting/host/record/ReferenceCheck.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::record {

namespace {

/// What is wrong with a check that did not pass, as a sentence.
std::string whyNot(std::string_view verdict, const Json& check, double load, double tolerance_pct) {
    const auto at = [&check](const char* key) { return check.value(key, Json()); };
    const auto text = [&](const char* key, const char* missing) {
        return at(key).is_number() ? fmt::format("{:.4g}", at(key).get<double>()) : std::string(missing);
    };
    if (at("measured_ohm").is_null()) {
        return fmt::format(
            "the known-reference check was not evaluated: nothing was measured where {:.4g} ohm is connected", load);
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
        verdict == "fail" ? "failed" : "is indeterminate", text("measured_ohm", ""), text("expanded_ohm", ""), load,
        tolerance_pct);
}

}  // namespace

Result<Json> reference(ScriptSession& session, const Arguments& arguments) {
    return judgeReference(session, arguments.object("reading"),
                          {arguments.number("load"), arguments.number("tolerance"), arguments.number("of the load")});
}

/// One rule everywhere: |reading - reference| + U ≤ tolerance (science.md section 12).
Result<Json> judgeReference(ScriptSession& session, const Json& reading, const KnownLoad& known) {
    const auto [load, tolerance_pct, load_pct] = known;
    const double measured = numberOr(reading, "load_ohm");
    // 95 % of a rectangle of the resistor's own tolerance.
    const double expanded = std::hypot(numberOr(reading, "load_expanded_ohm"), 0.95 * load_pct / 100 * load);
    const double off_pct = 100 * (measured / load - 1);
    const auto verdict = guardBandedName(off_pct, 100 * expanded / load, tolerance_pct);
    const bool passed = verdict == "pass";
    const Json check = {{"load_ohm", load},
                        {"measured_ohm", numberOrNull(measured)},
                        {"expanded_ohm", numberOrNull(expanded)},
                        {"deviation_pct", numberOrNull(off_pct)},
                        {"expanded_uncertainty_pct", numberOrNull(100 * expanded / load)},
                        {"allowed_pct", tolerance_pct},
                        {"verdict", verdict},
                        {"passed", passed}};
    if (session.writer() != nullptr) {
        auto& writer = *session.writer();
        if (auto kept = writer.measurement(session.now(), "known-reference check", check); !kept) return failure(kept);
        const auto withU = [](const Json& value, const Json& u, const char* unit) -> Json {
            return {{"value", value}, {"expanded", u}, {"unit", unit}};
        };
        const Json row = {{"load_ohm", load},
                          {"measured ± U", withU(check["measured_ohm"], check["expanded_ohm"], "ohm")},
                          {"off ± U", withU(check["deviation_pct"], check["expanded_uncertainty_pct"], "%")},
                          {"allowed_pct", tolerance_pct},
                          {"verdict", verdict}};
        auto shown = writer.reportItem(
            session.now(), {{"kind", "table"},
                            {"caption", "Known-reference check"},
                            {"rows", Json::array({row})},
                            {"columns", {"load_ohm", "measured ± U", "off ± U", "allowed_pct", "verdict"}}});
        if (!shown) return failure(shown);
    }
    Json out = check;
    out["reason"] = passed ? Json() : Json(whyNot(verdict, check, load, tolerance_pct));
    return out;
}

}  // namespace tacto::host::record
