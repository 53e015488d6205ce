// Reads and judges a known load before any measurement on it is trusted.
#include <cmath>
#include <string_view>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/measure/Readings.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/results/ResultBasis.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::bench {

namespace {

/// Returns a sentence that says why a check did not pass.
std::string whyNot(const KnownLoadCheck& check) {
    if (std::isnan(check.measured_ohm))
        return fmt::format(
            "the known-reference check was not evaluated: nothing was measured where {:.4g} ohm is connected",
            check.load_ohm);
    if (std::isnan(check.expanded_ohm))
        return fmt::format(
            "the known-reference check was not evaluated: {:.4g} ohm was measured on {:.4g} ohm, and how well the "
            "oscilloscope knows that is not stated",
            check.measured_ohm, check.load_ohm);
    return fmt::format(
        "the known-reference check {}: {:.4g} ± {:.4g} ohm was measured where {:.4g} ohm is connected; {:.2g} % "
        "of it is accepted, uncertainty included",
        check.verdict == "fail" ? "failed" : "is indeterminate", check.measured_ohm, check.expanded_ohm, check.load_ohm,
        check.allowed_pct);
}

}  // namespace

/// Judges the reading: |reading - reference| + expanded uncertainty must be ≤ tolerance (science.md section 12).
Result<Json> judgeReference(ScriptSession& session, const Json& reading, const KnownLoad& known) {
    KnownLoadCheck check;
    check.load_ohm = known.load_ohm;
    check.measured_ohm = numberOr(reading, "load_ohm");
    // The resistor's tolerance is a rectangular distribution; 0.95 of its half-width covers 95 %.
    check.expanded_ohm =
        std::hypot(numberOr(reading, "load_expanded_ohm"), 0.95 * known.itsTolerance_pct / 100 * known.load_ohm);
    check.deviation_pct = 100 * (check.measured_ohm / check.load_ohm - 1);
    check.expanded_pct = 100 * check.expanded_ohm / check.load_ohm;
    check.allowed_pct = known.tolerance_pct;
    check.verdict = guardBandedName(check.deviation_pct, check.expanded_pct, check.allowed_pct);
    if (!check.passed()) check.reason = whyNot(check);
    const Json out = toJson(check);
    if (session.writer() == nullptr) return out;
    auto& writer = *session.writer();
    Json measured = out;
    measured.erase("reason");
    if (auto kept = writer.measurement(session.now(), "known-reference check", measured); !kept) return failure(kept);
    auto shown = writer.reportItem(session.now(), knownLoadTable(check));
    if (!shown) return failure(shown);
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
         .members = knownLoadMembers(),
         .returns =
             ": verdict \"pass\" when |deviation| + U is allowed, \"fail\" when |deviation| - U is not, else "
             "\"indeterminate\"; \"not evaluated\" where nothing was measured or no uncertainty is stated. passed "
             "is true for a pass alone; reason is a sentence where it did not pass, else null.",
         .errors = "Throws when the session file cannot be written.",
         .call = host::bench::reference},
    };
}

}  // namespace tacto
