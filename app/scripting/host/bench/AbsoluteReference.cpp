// An absolute reference in addition to the known load. A gain error shared by voltage and current cancels in V/I; only
// a voltage of known size shows it (science.md section 12).
#include <cmath>
#include <fmt/format.h>

#include "app/scripting/host/bench/BenchCalls.h"
#include "core/analysis/load_safety/LoadReading.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/measure/CaptureFile.h"
#include "core/measure/InstrumentStatement.h"
#include "core/results/ResultBasis.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::bench {

namespace {

/// A level of the voltage channel: mean, noise and its capture.
struct Level {
    double mean = kNaN, noise = kNaN;
    std::size_t samples = 0;
    Capture capture;
};

/// Puts `volts` of the reference source on the voltage input (0: with its leads shorted). A simulated bench does this
/// by itself; otherwise the operator does it.
Result<void> apply(ScriptSession& session, double volts) {
    if (auto& source = session.bench().devices().reference) return source->applyVoltage(volts);
    session.forgetConfirmed();
    if (!(volts > 0)) {
        return session.askTo("reference-zero",
                             "Short the oscilloscope's voltage input in place of the reference source, then confirm");
    }
    return session.askTo("reference-source",
                         fmt::format("Connect the reference source at {:g} V to the oscilloscope's voltage input in "
                                     "place of the load, then confirm",
                                     volts));
}

/// Errors: Unsupported if the oscilloscope cannot record without a trigger; Timeout.
Result<Level> levelAt(ScriptSession& session, double volts, double range_V) {
    if (auto applied = apply(session, volts); !applied) return failure(applied);
    Bench& bench = session.bench();
    ScopeSettings settings;
    settings.sampleRate = std::min(Hertz(1e5), bench.devices().oscilloscope->traits().maxRate);
    settings.samples = 5000;
    settings.voltageRange = Volts(range_V);
    settings.triggerLevel = 0.98 * range_V;  // a level that no signal reaches
    if (auto asked = bench.requestCaptures(1, settings, Seconds(0.2)); !asked) return failure(asked);
    constexpr double kTimeout_s = 10, kPoll_s = 0.05;
    for (double waited = 0; waited < kTimeout_s; waited += kPoll_s) {
        if (auto passed = bench.wait(Seconds(kPoll_s)); !passed) return failure(passed);
        auto captures = bench.takeCaptures();
        if (!captures) return failure(captures);
        if (captures->empty()) continue;
        bench.cancelCaptures();
        Level level;
        level.capture = std::move(captures->front());
        const auto voltage = findChannel(level.capture, "voltage");
        if (!voltage) return failure(voltage);
        std::vector<double> samples(level.capture.channels[*voltage].samples.begin(),
                                    level.capture.channels[*voltage].samples.end());
        const auto statistics = statisticsOf(samples);
        level.mean = statistics.mean;
        level.noise = statistics.sd;
        level.samples = statistics.n;
        return level;
    }
    bench.cancelCaptures();
    return fail(ErrorCode::Timeout, "bench.readReference: the oscilloscope gave no record in {} s", kTimeout_s);
}

/// Returns the difference of both levels, in which an offset cancels.
Reading differenceOf(const Level& high, const Level& zero, double source_pct) {
    const auto voltage = findChannel(high.capture, "voltage");
    const auto& channel = high.capture.channels[*voltage];
    const double value = high.mean - zero.mean;
    const double step = channel.lsb > 0 ? channel.lsb : kNaN;
    const double noise = std::hypot(high.noise, zero.noise) / std::sqrt(static_cast<double>(high.samples));
    std::vector<Contribution> rows{
        {"gain of voltage", Distribution::Rectangular, channel.gainTolerance, std::sqrt(3.0), value},
        {"probe of voltage", Distribution::Rectangular, channel.probeTolerance, std::sqrt(3.0), value},
        {"linearity of voltage", Distribution::Rectangular, channel.linearityTolerance, std::sqrt(3.0)},
        {"resolution of voltage", Distribution::Rectangular, step, std::sqrt(6.0)},
        {"noise of voltage", Distribution::Normal, noise},
        {"reference source", Distribution::Normal, source_pct / 100 * value, 2}};
    return readingOf(value, std::move(rows), {});
}

/// Judges the reading: |reading - reference| + expanded uncertainty must be ≤ tolerance.
Result<Json> read(ScriptSession& session, double volts, double source_pct, double tolerance_pct) {
    Bench& bench = session.bench();
    bench.disarm();
    const double range_V = 1.25 * volts;
    auto high = levelAt(session, volts, range_V);
    if (!high) return failure(high);
    auto zero = levelAt(session, 0, range_V);
    if (!zero) return failure(zero);
    const Reading reading = differenceOf(*high, *zero, source_pct);
    const double scale = 100 / volts;
    AbsoluteCheck check;
    check.reference_v = volts;
    check.reference_u_pct = source_pct;
    check.measured_v = reading.value;
    check.expanded_v = reading.expanded;
    check.deviation_pct = scale * (reading.value - volts);
    check.expanded_pct = scale * reading.expanded;
    check.allowed_pct = tolerance_pct;
    check.verdict = guardBandedName(check.deviation_pct, check.expanded_pct, tolerance_pct);
    const auto lacking = notStatedText(high->capture);
    check.text = fmt::format("{:.4g} V of a reference source read as {:.4g} V", volts, reading.value);
    if (std::isfinite(reading.expanded)) check.text += fmt::format(" ± {:.2g} V", reading.expanded);
    check.text +=
        fmt::format("; ± {:.3g} % are allowed: {}", tolerance_pct,
                    std::isnan(reading.expanded) ? "not evaluated, since " + lacking : std::string(check.verdict));
    Json out = toJson(check);
    session.scopeSeen().setAbsolute(check.text);
    std::vector<Capture> shown;
    shown.push_back(std::move(high->capture));
    shown.push_back(std::move(zero->capture));
    Json handles = session.hold(std::move(shown));
    if (session.writer() != nullptr) {
        if (auto kept = session.writer()->measurement(session.now(), "absolute reference", out); !kept) {
            return failure(kept);
        }
    }
    out["captures"] = std::move(handles);
    return out;
}

}  // namespace

std::vector<HostParameter> absoluteSettings() {
    return {
        takes::number("settings.reference_v", "V", "of a reference source on the oscilloscope; 0: none").range(0, 500),
        takes::number("settings.reference_u_pct", "%", "of it, k = 2").range(0, 10)};
}

Result<Json> absoluteReading(ScriptSession& session, const Arguments& arguments, double tolerance_pct) {
    const double volts = arguments.number("settings.reference_v"), u_pct = arguments.number("settings.reference_u_pct");
    if (!(volts > 0)) return Json();
    if (!(u_pct > 0)) return arguments.wrong("reference_u_pct", u_pct, "above 0 with a reference source");
    return read(session, volts, u_pct, tolerance_pct);
}

namespace {

Result<Json> readReference(ScriptSession& session, const Arguments& arguments) {
    return read(session, arguments.number("volts"), arguments.number("uncertainty"), arguments.number("tolerance"));
}

}  // namespace

}  // namespace tacto::host::bench

namespace tacto {

std::vector<HostFunction> absoluteReferenceFunctions() {
    using namespace takes;
    return {
        {.name = "readReference",
         .parameters = {number("volts", "V",
                               "of the reference source, as its certificate or a calibrated multimeter says")
                            .range(1e-3, 500),
                        number("uncertainty", "%", "of it, k = 2").range(1e-6, 10),
                        number("tolerance", "%",
                               "how far the reading may lie from the reference, its uncertainty included")
                            .range(1e-3, 50)},
         .text = "Reads a voltage of known size and its zero on the oscilloscope's voltage channel, with the output "
                 "disarmed: a gain error that voltage and current share does not show in a known load. The operator "
                 "connects the source (questions \"reference-source\" and \"reference-zero\"); a simulated bench does "
                 "it by itself.",
         .members = absoluteMembers(),
         .returns = " and captures: verdict \"not evaluated\" where the oscilloscope does not state its accuracy.",
         .errors = "Throws without an oscilloscope, for one that takes no record without a trigger, or when no "
                   "operator can answer.",
         .needs = Role::Oscilloscope,
         .call = host::bench::readReference},
    };
}

}  // namespace tacto
