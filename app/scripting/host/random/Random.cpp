// Randomness from the seed of the run.
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/random/RandomObject.h"

namespace tacto::host::random {

namespace {

/// 0..n-1 in random order (Fisher and Yates).
void appendOrder(Random& random, std::size_t n, Json& out) {
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (const auto index : order) out.push_back(index);
}

}  // namespace

Result<Json> blocks(ScriptSession& session, const Arguments& arguments) {
    const int length = arguments.whole("the list's length"), repeats = arguments.whole("repeats");
    const double most = kMaxElements / std::max(1, length);
    if (repeats > most) return arguments.wrong("repeats", repeats, fmt::format("a whole number from 0 to {}", most));
    Json out = Json::array();
    for (int i = 0; i < repeats; ++i) appendOrder(session.random(), static_cast<std::size_t>(length), out);
    return out;
}

Result<Json> shuffle(ScriptSession& session, const Arguments& arguments) {
    Json out = Json::array();
    appendOrder(session.random(), static_cast<std::size_t>(arguments.whole("the list's length")), out);
    return out;
}

Result<Json> uniform(ScriptSession& session, const Arguments& arguments) {
    const auto low = arguments.number("low");
    const auto high = arguments.number("high");
    if (high < low) return arguments.wrong("high", high, fmt::format("a number of at least {}", low));
    return Json(low + (high - low) * session.random().uniform());
}

Result<Json> sweeps(ScriptSession& session, const Arguments& arguments) {
    const int levels = arguments.whole("levels");
    Json steps = Json::array();
    for (int repeat = 1; repeat <= arguments.whole("repeats"); ++repeat) {
        Json order = Json::array();
        appendOrder(session.random(), 2, order);
        for (const auto& way : order) {
            const bool isUp = way == 0;
            for (int k = 0; k < levels; ++k) {
                const double share = static_cast<double>(isUp ? k : levels - 1 - k) / (levels - 1);
                steps.push_back({{"repeat", repeat}, {"direction", isUp ? "up" : "down"}, {"share", share}});
            }
        }
    }
    return steps;
}

}  // namespace tacto::host::random
