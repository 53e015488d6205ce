// Computed transitions: the largest step from one train to the next.
#include "app/scripting/host/analysis/RunAnalysis.h"

namespace tacto::host::analysis {

std::vector<HostParameter> sweepSettings(bool ofOptions) {
    using namespace takes;
    return {
        whole(ofOptions ? "options.lines" : "settings.lines", "lines along R and along P").range(2, 101).otherwise(11),
        number(ofOptions ? "options.traverse_s" : "settings.traverse_s", "s", "from one end of the plane to the other")
            .range(0.1, 600)
            .otherwise(5),
        flag(ofOptions ? "options.jumps" : "settings.jumps", "whether jumps between the corners are judged too")
            .otherwise(true)};
}

Result<ComputedTransitions> computedTransitions(ScriptSession& session, const Arguments& arguments, int lines,
                                                double traverse, bool jumps) {
    // Computing may take only a moment, because a stop cannot interrupt it.
    constexpr double kMaxSweep_s = 12'000;
    if (!(lines * traverse <= kMaxSweep_s))
        return arguments.wrong("traverse_s", traverse, fmt::format("at most {:g} s divided by the lines", kMaxSweep_s));
    return computeTransitions(session.bench().profile().encoding, {lines, Seconds(traverse)}, jumps);
}

namespace {

Result<Json> transitions(ScriptSession& session, const Arguments& arguments) {
    const auto computed = computedTransitions(session, arguments, arguments.whole("options.lines"),
                                              arguments.number("options.traverse_s"), arguments.flag("options.jumps"));
    if (!computed) return failure(computed);
    return toJson(*computed);
}

}  // namespace

}  // namespace tacto::host::analysis

namespace tacto {

std::vector<HostFunction> transitionAnalysis() {
    return {
        {.name = "transitions",
         .parameters = host::analysis::sweepSettings(true),
         .text = "Computes the trains of a sweep of the R-P plane with the bench's encoding and finds the largest step "
                 "from one train to the next, in just-noticeable differences; at most 2 are wanted.",
         .members = computedTransitionsRecord().keys(),
         .returns = "; R and P of a step are those of the later train, and maps are rows of P by columns of R, null "
                    "where no train went.",
         .call = host::analysis::transitions},
    };
}

}  // namespace tacto
