// The object "random", randomness from the seed of the run: what scripts can call, and what each function takes and
// returns.
#include "app/scripting/host/random/RandomObject.h"

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
        {.name = "sweeps",
         .parameters = {whole("levels", "of a quantity").range(2, 1000),
                        whole("repeats", "of each level, each way").range(1, 1000)},
         .text = "Fully up and fully down through the levels, again and again; which way comes first is drawn for each "
                 "repeat, from the run's seed.",
         .returns = "List of { repeat, direction, share }: direction up or down, share from 0 to 1.",
         .call = host::random::sweeps},
        {.name = "uniform",
         .parameters = {number("low", "", "lower end, included"), number("high", "", "upper end, not included")},
         .text = "A random number, from the run's seed. Math.random() is the same from 0 to 1.",
         .returns = "Number.",
         .call = host::random::uniform},
    };
}

}  // namespace tacto
