#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

#include "app/cli/ResultText.h"
#include "app/cli/Say.h"
#include "app/cli/Verdicts.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

/// "14.5 (11.2 to 19.0)": the middle, 5 and 95 % of the participants.
std::string range(const json& object, const char* key, const char* middle = "value", double factor = 1) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_object()) return "–";
    if (!found->value(middle, json()).is_number()) return "–";
    return fmt::format("{} ({} to {})", resultNumber(*found, middle, factor), resultNumber(*found, "low", factor),
                       resultNumber(*found, "high", factor));
}

void printAim(const char* aim, const json& alone, const json& pooled) {
    say("  {:<34} one participant {:>6}, pooled {:>6} ({} each)\n", aim, alone.is_number() ? alone.dump() : "–",
        resultNumber(pooled, "total"), resultNumber(pooled, "per_participant"));
}

}  // namespace

void printVariation(const json& results) {
    say("\n  {} virtual participants, {} of them presented every condition; refused {}, not felt {}\n",
        resultNumber(results, "participants"), resultNumber(results, "complete"), resultNumber(results, "refused"),
        resultNumber(results, "not_felt"));
    say("\n  {:<28} {:>26} {:>26} {:>26}\n", "pair, JND", "together", "amplitude", "interval");
    for (const auto& pair : results.value("separability", json::array())) {
        say("  {:<28} {:>26} {:>26} {:>26}\n", resultText(pair, "a") + " / " + resultText(pair, "b"),
            range(pair, "jnd"), range(pair, "amplitude_jnd"), range(pair, "interval_jnd"));
    }
    say("\n  accuracy {} %, information {} bits\n", range(results, "accuracy", "median", 100),
        range(results, "information_bits", "median"));
    const json needed = results.value("trials_needed", json());
    if (!needed.is_object()) return;
    say("\n  trials, so that with {} % probability\n", resultNumber(needed, "assurance", 100));
    const json& alone = needed.at("per_participant");
    const json& pooled = needed.at("pooled");
    printAim(fmt::format("the interval is {} % wide or less", resultNumber(needed, "width", 100)).c_str(),
             alone.at("for_width"), pooled.at("for_width"));
    printAim("its lower end lies above chance", alone.at("above_chance"), pooled.at("above_chance"));
}

}  // namespace tacto::cli
