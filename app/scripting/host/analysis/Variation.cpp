// Predictions without a device: virtual participants and the spread of benches.
#include <stop_token>

#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/analysis/AnalysisObject.h"
#include "app/scripting/host/analysis/VariationArguments.h"
#include "core/analysis/variation/VariationJson.h"

namespace tacto::host::analysis {

Result<Json> variation(ScriptSession& session, const Arguments& arguments) {
    const auto label = arguments.text("options.label");
    const auto options = variationOptionsFrom(session, arguments);
    if (!options) return failure(options);

    // The bench's stop is asked for while the threads work: a wait of no time fails once it came.
    std::stop_source stop;
    std::optional<Error> stopped;
    const auto found = predictVariation(*options, stop.get_token(), [&](std::size_t done, std::size_t total) {
        session.progress({label, done, total});
        if (stopped) return;
        if (auto waited = session.bench().wait(Seconds(0)); !waited) {
            stopped = waited.error();
            stop.request_stop();
        }
    });
    if (!found && found.error().code != ErrorCode::Stopped) return failure(found);
    if (stopped) {
        // What is done by then stands as a partial result, in the run's outcome and its report.
        if (found) session.keepPartial(toJson(*found, *options), Json::array());
        return tl::unexpected<Error>(*stopped);
    }
    if (!found) return failure(found);
    return toJson(*found, *options);
}

Result<Json> uncertainBench(ScriptSession& session, const Arguments& arguments) {
    const BenchTolerances tolerances{.stimulatorGain = arguments.number("options.gain_pct") / 100,
                                     .stimulatorOffset = Volts(arguments.number("options.offset_v")),
                                     .load = arguments.number("options.load_pct") / 100,
                                     .scopeGain = arguments.number("options.scope_gain_pct") / 100,
                                     .scopeOffset = arguments.number("options.scope_offset_pct") / 100,
                                     .clock = arguments.number("options.clock_ppm") / 1e6,
                                     .jitter = Micros(arguments.number("options.jitter_us"))};
    const auto found = predictBench(session.bench().profile().encoding, variationSourceFrom(arguments), tolerances,
                                    static_cast<std::size_t>(arguments.whole("options.draws")), session.request().seed);
    if (!found) return failure(found);
    return toJson(*found);
}

}  // namespace tacto::host::analysis
