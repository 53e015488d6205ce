// Oscilloscope records of the next trains.
#include <algorithm>
#include <cmath>

#include "app/scripting/host/bench/BenchCalls.h"

namespace tacto::host::bench {

namespace {

/// Fewest and most trains in one record that must show their intervals.
constexpr int kMinTrainsInOne = 2, kMaxTrainsInOne = 8;

double given(double option, double usual) { return std::isfinite(option) ? option : usual; }

ScopeSettings scopeSettings(Bench& bench, const CaptureOptions& options) {
    const Telemetry now = bench.telemetry();
    const double expected_v =
        std::isfinite(now.amplitude_v) ? now.amplitude_v : bench.profile().encoding.amplitudeMax.value();
    const double fastest_hz = bench.devices().oscilloscope->traits().maxRate.value();
    ScopeSettings settings = trainRecord(bench, Hertz(given(options.rate_hz, std::min(1e6, fastest_hz))));
    if (options.samples > 0) settings.samples = options.samples;
    settings.triggerLevel = given(options.trigger_v, std::max(0.05, 0.2 * expected_v));
    settings.voltageRange = Volts(given(options.voltageRange_v, std::max(1.0, 1.3 * expected_v)));
    settings.currentRange =
        Milliamps(given(options.currentRange_ma, std::max(1.0, 2e3 * expected_v / presentLoad(now).value())));
    return settings;
}

/// Takes one record with `trains` trains at the present interval. Between two records the interval is known only as
/// well as the records' time stamps (science.md section 12).
Result<std::vector<Capture>> captureInOne(Bench& bench, int trains, ScopeSettings settings) {
    constexpr double kBefore = 0.05, kSpare = 0.1;  // shares: kBefore of the record, kSpare of an interval
    constexpr double kMaxSamples = 5e5, kMinRate_hz = 1e5;
    const double interval_s = bench.telemetry().interval_s;
    if (!(interval_s > 0) || !std::isfinite(interval_s))
        return fail(ErrorCode::InvalidArgument, "bench.capture: intervals are wanted and nothing is driven");
    const double seconds = (trains - 1 + kSpare) * interval_s / (1 - kBefore);
    const double rate_hz = std::min(settings.sampleRate.value(), std::max(kMinRate_hz, kMaxSamples / seconds));
    settings.sampleRate = Hertz(rate_hz);
    settings.samples = static_cast<std::size_t>(std::ceil(rate_hz * seconds));
    settings.preTrigger = kBefore;
    return bench.capture(1, settings);
}

}  // namespace

ScopeSettings trainRecord(const Bench& bench, Hertz rate) {
    const Seconds train = bench.profile().encoding.train.outputDuration();
    ScopeSettings settings;
    settings.sampleRate = rate;
    settings.samples =
        static_cast<std::size_t>(std::max(1.0, std::ceil((1.4 * train + kTrainTail).count() * rate.value())));
    settings.preTrigger = kPreTrigger;
    return settings;
}

Ohms presentLoad(const Telemetry& now) noexcept {
    return Ohms(std::isfinite(now.impedance_ohm) && now.impedance_ohm > 0 ? now.impedance_ohm : 1000);
}

Result<std::vector<Capture>> captureTrains(ScriptSession& session, const CaptureOptions& options) {
    const ScopeSettings settings = scopeSettings(session.bench(), options);
    if (!options.intervals || session.scopeSeen().stampsStated()) {
        auto captures = session.bench().capture(options.trains, settings);
        if (!captures || !options.intervals || std::isfinite(captures->front().stampTolerance_s)) return captures;
    }
    return captureInOne(session.bench(), options.trains, settings);
}

namespace {

Result<Json> capture(ScriptSession& session, const Arguments& arguments) {
    const auto intervals = arguments.flag("options.intervals");
    const int trains = arguments.whole("options.trains", intervals ? kMinTrainsInOne : 1);
    if (intervals && (trains < kMinTrainsInOne || trains > kMaxTrainsInOne))
        return arguments.wrong("trains", trains,
                               fmt::format("a whole number from {} to {}", kMinTrainsInOne, kMaxTrainsInOne));
    auto captures = captureTrains(session, {.trains = trains,
                                            .rate_hz = arguments.number("options.rate_hz"),
                                            .samples = static_cast<std::size_t>(arguments.whole("options.samples")),
                                            .voltageRange_v = arguments.number("options.voltage_range_v"),
                                            .currentRange_ma = arguments.number("options.current_range_ma"),
                                            .trigger_v = arguments.number("options.trigger_v"),
                                            .intervals = intervals});
    if (!captures) return failure(captures);
    return session.hold(std::move(*captures));
}

}  // namespace

}  // namespace tacto::host::bench

namespace tacto {

std::vector<HostFunction> captureFunctions() {
    using namespace takes;
    return {
        {.name = "capture",
         .parameters =
             {whole("options.trains", "how many; 2 to 8 with intervals")
                  .range(1, static_cast<double>(ScriptSession::kHeldCaptures))
                  .optional("1, or 2 with intervals,"),
              number("options.rate_hz", "Hz", "sampling rate")
                  .range(1, 1e9)
                  .optional("1e6 or the instrument's largest"),
              whole("options.samples", "per capture").range(1, 1e8).optional("the whole train"),
              number("options.voltage_range_v", "V", "full scale is ± this")
                  .range(1e-3, 1e4)
                  .optional("1.3 times the command"),
              number("options.current_range_ma", "mA", "full scale is ± this")
                  .range(1e-3, 1e5)
                  .optional("a range for command and |Z|"),
              number("options.trigger_v", "V", "trigger level").range(1e-6, 1e4).optional("a fifth of the command"),
              flag("options.intervals",
                   "the intervals between the trains are wanted: where the oscilloscope does not state how "
                   "good the time stamps of its records are, one record holds them all, at a lower rate where it would "
                   "be longer than half a million samples")
                  .otherwise(false)},
         .text = "Waits for the next trains and takes one oscilloscope record of each.",
         .returns =
             "List of captures { capture, start_s, trigger_s, rate_hz, samples, stamp_tolerance_s, not_stated }, for "
             "measure.train(): stamp_tolerance_s is how good trigger_s is against other records, null where the "
             "oscilloscope does not state it; not_stated says what else it does not, \"\" where it states all.",
         .errors = "Throws without an oscilloscope; when fewer trains came; when the run is stopped.",
         .needs = Role::Oscilloscope,
         .call = host::bench::capture},
    };
}

}  // namespace tacto
