// Reads and judges a known load before any measurement on it is trusted.
#include <cmath>
#include <string_view>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/measure/Readings.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::bench {

namespace {

/// Returns a sentence that says why a check did not pass.
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

/// Judges the reading: |reading - reference| + expanded uncertainty must be ≤ tolerance (science.md section 12).
Result<Json> judgeReference(ScriptSession& session, const Json& reading, const KnownLoad& known) {
    const auto [load, tolerance_pct, load_pct] = known;
    const double measured = numberOr(reading, "load_ohm");
    // The resistor's tolerance is a rectangular distribution; 0.95 of its half-width covers 95 %.
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

Result<Json> knownLoad(ScriptSession& session, double load_ohm, double tolerance_pct) {
    if (auto armed = armConfirmed(session, fmt::format("{} ohm", load_ohm)); !armed) return failure(armed);
    if (auto driven = session.bench().drive(DriveSource::Manual, 1, 1); !driven) return failure(driven);
    auto captures = captureTrains(session, {});
    if (!captures) return failure(captures);
    const auto reading = measure::pulseReading(session, session.hold(std::move(*captures)));
    if (!reading) return reading;
    return judgeReference(session, *reading, {load_ohm, tolerance_pct, 0});
}

namespace {

Result<Json> readKnownLoad(ScriptSession& session, const Arguments& arguments) {
    return knownLoad(session, arguments.number("load"), arguments.number("tolerance"));
}

Result<Json> reference(ScriptSession& session, const Arguments& arguments) {
    return judgeReference(session, arguments.object("reading"),
                          {arguments.number("load"), arguments.number("tolerance"), arguments.number("of the load")});
}

}  // namespace

}  // namespace tacto::host::bench

namespace tacto {

std::vector<HostFunction> knownLoadFunctions() {
    using namespace takes;
    return {
        {.name = "readKnownLoad",
         .parameters = {number("load", "ohm", "that is connected").range(1, 1e6),
                        number("tolerance", "%", "how far the reading may lie from the load, its uncertainty included")
                            .range(0, 100)},
         .text = "Before anything is believed: arms, reads one train of the strongest command and judges it as "
                 "record.reference() does. The output stays armed and driven.",
         .returns = "As record.reference().",
         .errors = "As bench.arm() and bench.capture().",
         .asks = {kConfirmArming},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::bench::readKnownLoad},
    };
}

std::vector<HostFunction> referenceFunctions() {
    using namespace takes;
    return {
        {.name = "reference",
         .parameters = {object("reading", "from measure.pulse(), of a load that is known"),
                        number("load", "ohm", "what is connected").atLeast(1e-3),
                        number("tolerance", "%", "how far the reading may lie from the load, its uncertainty included")
                            .range(0, 100),
                        number("of the load", "%", "the load's own tolerance").range(0, 100).otherwise(0)},
         .text = "Judges whether a known load reads as what it is, and records that: instruments that misread it can "
                 "judge nothing else.",
         .returns =
             "{ load_ohm, measured_ohm, expanded_ohm, deviation_pct, expanded_uncertainty_pct, allowed_pct, verdict, "
             "passed, reason }: verdict \"pass\" when |deviation| + U is allowed, \"fail\" when |deviation| - U is "
             "not, "
             "else \"indeterminate\"; \"not evaluated\" where nothing was measured or no uncertainty is stated. passed "
             "is true for a pass alone; reason is a sentence where it did not pass, else null.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::bench::reference},
    };
}

}  // namespace tacto
