// Random numbers and orders from the seed of the run.
#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::random {

namespace {

using Json = nlohmann::json;

constexpr double kMaxElements = 1e6;

/// Appends 0..n-1 in random order (Fisher and Yates).
void appendOrder(Random& random, std::size_t n, Json& out) {
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (const auto index : order) out.push_back(index);
}

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

}  // namespace

}  // namespace tacto::host::random

namespace tacto {

std::vector<HostFunction> randomFunctions() {
    using namespace takes;
    const auto length = whole("the list's length", "").range(0, host::random::kMaxElements);
    const auto repeats =
        whole("repeats", "how often; at most a million elements in all").range(0, host::random::kMaxElements);
    return {
        {.name = "blocks",
         .parameters = {list("list", "what is repeated"), repeats},
         .text = "Every element once per block, each block in a random order of its own, from the run's seed.",
         .returns = "A new list of repeats times the elements.",
         .call = host::random::blocks,
         .javascript = R"js((list, repeats) => {
            const order = native(list && list.length, repeats), out = [];
            for (let i = 0; i < order.length; ++i) out[i] = list[order[i]];
            return out;
         })js",
         .passes = {length, repeats}},
        {.name = "shuffle",
         .parameters = {list("list", "what is shuffled")},
         .text = "The elements in random order, from the run's seed.",
         .returns = "A new list.",
         .call = host::random::shuffle,
         .javascript = R"js((list) => {
            const order = native(list && list.length), out = [];
            for (let i = 0; i < order.length; ++i) out[i] = list[order[i]];
            return out;
         })js",
         .passes = {length}},
        {.name = "uniform",
         .parameters = {number("low", "", "lower end, included"), number("high", "", "upper end, not included")},
         .text = "A random number, from the run's seed. Math.random() is the same from 0 to 1.",
         .returns = "Number.",
         .call = host::random::uniform},
    };
}

}  // namespace tacto
