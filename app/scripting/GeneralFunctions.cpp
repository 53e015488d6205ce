// Functions without a bench: declaring, randomness, progress, the verdict.
#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"

namespace tacto {

namespace {

using Json = nlohmann::json;
constexpr double kMany = 1e6;

/// 0..n-1 in random order (Fisher and Yates).
void appendOrder(Random& random, std::size_t n, Json& out) {
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = i;
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (const auto index : order) out.push_back(index);
}

Result<Json> blocks(ScriptSession& session, const Json& list) {
    const Arguments arguments("random.blocks", list);
    auto length = arguments.number(0, "the list's length", {0, kMany, true});
    if (!length) return failure(length);
    auto repeats = arguments.number(1, "repeats", {0, kMany / std::max(1.0, *length), true});
    if (!repeats) return failure(repeats);
    Json out = Json::array();
    for (int i = 0; i < static_cast<int>(*repeats); ++i) {
        appendOrder(session.random(), static_cast<std::size_t>(*length), out);
    }
    return out;
}

Result<Json> shuffle(ScriptSession& session, const Json& list) {
    auto length = Arguments("random.shuffle", list).number(0, "the list's length", {0, kMany, true});
    if (!length) return failure(length);
    Json out = Json::array();
    appendOrder(session.random(), static_cast<std::size_t>(*length), out);
    return out;
}

Result<Json> uniform(ScriptSession& session, const Json& list) {
    const Arguments arguments("random.uniform", list);
    auto low = arguments.number(0, "low");
    if (!low) return failure(low);
    auto high = arguments.number(1, "high", NumberRange{*low});
    if (!high) return failure(high);
    return Json(*low + (*high - *low) * session.random().uniform());
}

Result<Json> progress(ScriptSession& session, const Json& list) {
    const Arguments arguments("progress", list);
    auto done = arguments.number(0, "the position", {0, 1e9, true});
    if (!done) return failure(done);
    auto total = arguments.number(1, "the list's length", {0, 1e9, true});
    if (!total) return failure(total);
    const Json& label = arguments.at(2);
    session.progress({label.is_string() ? label.get<std::string>() : "", static_cast<std::size_t>(*done),
                      static_cast<std::size_t>(*total)});
    return Json();
}

Result<Json> verdict(ScriptSession& session, const Json& list) {
    const Arguments arguments("verdict", list);
    auto found = arguments.object(0, "found");
    if (!found) return failure(found);
    const Json name = (*found)->value("verdict", Json());
    ScriptVerdict verdict = ScriptVerdict::None;
    for (const auto known : {ScriptVerdict::Pass, ScriptVerdict::Fail, ScriptVerdict::Indeterminate}) {
        if (name == nameOf(known)) verdict = known;
    }
    if (verdict == ScriptVerdict::None && !name.is_null()) {
        return arguments.wrong("found.verdict", name, "\"pass\", \"fail\", \"indeterminate\" or null");
    }
    std::vector<std::string> reasons;
    const Json given = (*found)->value("reasons", Json::array());
    for (const auto& reason : given) {
        if (reason.is_string()) reasons.push_back(reason.get<std::string>());
    }
    session.judge(verdict, std::move(reasons), **found);
    return name;
}

Result<Json> log(ScriptSession& session, const Json& list) {
    std::string line;
    for (const auto& value : list) {
        if (!line.empty()) line += ' ';
        line += value.is_string() ? value.get<std::string>() : shown(value);
    }
    session.log(line);
    return Json();
}

Result<Json> protocol(ScriptSession&, const Json&) { return Json(); }  // read when the script was declared

}  // namespace

std::vector<HostFunction> generalFunctions() {
    return {
        {"",
         "protocol",
         HostKind::Function,
         {{"declaration", "object", "",
           "{ title, purpose, needs: [\"sensor\", \"stimulator\", \"oscilloscope\", \"massager\"], parameters: { NAME: "
           "{ label, type: number | integer | choice | text | boolean, unit, min, max, choices, value } } }"}},
         "Declares what the script is and what it takes. Once, at top level.",
         "",
         "Throws for a key, type, role or range that does not fit.",
         protocol,
         // Objects keep the order they were written in; JSON does not.
         R"js((declaration) => {
            const keys = (x) => x !== null && typeof x === "object" && !Array.isArray(x) ? Object.keys(x) : [];
            const parameters = declaration && declaration.parameters, names = keys(parameters), choices = [];
            for (let i = 0; i < names.length; ++i) choices[i] = keys(parameters[names[i]] && parameters[names[i]].choices);
            native(declaration, names, choices);
         })js"},
        {"",
         "progress",
         HostKind::Function,
         {{"list", "list", "", "what to go through"}, {"label", "text", "", "what the progress bar says", true}},
         "Goes through a list in a for...of loop and shows how far it is.",
         "What for...of takes.",
         "",
         progress,
         // By hand: a frozen generator's objects do not iterate in this engine.
         R"js((list, label) => {
            const total = list && list.length, done = { value: undefined, done: true };
            native(0, total, label);
            let next = 0;
            const step = () => {
                if (next >= total) return done;
                const value = list[next];
                if (next > 0) native(next, total, label);
                next += 1;
                return { value: value, done: false };
            };
            const end = () => { native(total, total, label); return done; };
            return { [Symbol.iterator]: () => ({ next: () => (next < total ? step() : end()), return: () => done }) };
         })js"},
        {"",
         "verdict",
         HostKind::Function,
         {{"found", "object", "",
           "an analysis' result: { verdict: \"pass\" | \"fail\" | \"indeterminate\" | null, reasons, ... }"}},
         "Makes the run's verdict and results. The last one counts.",
         "The verdict.",
         "",
         verdict},
        {"",
         "log",
         HostKind::Function,
         {{"text", "text", "", "one or more values"}},
         "Writes a line to the run's log.",
         "",
         "",
         log},
        {"random",
         "blocks",
         HostKind::Function,
         {{"list", "list", "", "what is repeated"}, {"repeats", "number", "", "how often, a whole number"}},
         "Every element once per block, each block in a random order of its own, from the run's seed.",
         "A new list of repeats times the elements.",
         "",
         blocks,
         R"js((list, repeats) => {
            const order = native(list && list.length, repeats), out = [];
            for (let i = 0; i < order.length; ++i) out[i] = list[order[i]];
            return out;
         })js"},
        {"random",
         "shuffle",
         HostKind::Function,
         {{"list", "list", "", "what is shuffled"}},
         "The elements in random order, from the run's seed.",
         "A new list.",
         "",
         shuffle,
         R"js((list) => {
            const order = native(list && list.length), out = [];
            for (let i = 0; i < order.length; ++i) out[i] = list[order[i]];
            return out;
         })js"},
        {"random",
         "uniform",
         HostKind::Function,
         {{"low", "number", "", "lower end, included"}, {"high", "number", "", "upper end, not included"}},
         "A random number, from the run's seed. Math.random() is the same from 0 to 1.",
         "Number.",
         "",
         uniform},
    };
}

}  // namespace tacto
