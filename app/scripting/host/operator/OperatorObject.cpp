// The object "operator", the person at the bench: what scripts can call, and what each function takes and returns.
#include "app/scripting/host/operator/OperatorObject.h"

#include "app/scripting/engine/DeclaredText.h"

namespace tacto {

std::vector<HostFunction> operatorFunctions() {
    using namespace takes;
    constexpr std::string_view kErrors =
        "Throws when the run has no operator and --set NAME=... was not given, when it does not fit, or when the run "
        "is stopped.";
    const auto name = text("name", "key of --set");
    const auto asked = [](std::string_view about) { return text("text", about).atMost(kMaxDeclaredText); };
    return {
        {.name = "confirm",
         .parameters = {text("name", "key of --set; answered with yes"), asked("what the operator confirms"),
                        text("options.drawing", "name of a shipped drawing to show").optional()},
         .text = "Waits until the operator confirms. A refusal ends the run.",
         .returns = "true",
         .errors = kErrors,
         .call = host::operators::confirm},
        {.name = "choose",
         .parameters = {name, asked("the question"),
                        any("choices", "keys with their explanations, or the keys alone; at least two")},
         .text = "Waits for one of several answers.",
         .returns = "The key chosen.",
         .errors = kErrors,
         .call = host::operators::choose},
        {.name = "enter",
         .parameters = {name, asked("what to enter"),
                        text("options.unit", "unit that the number is shown with").optional(),
                        number("options.min", "as options.unit", "smallest number accepted").optional(),
                        number("options.max", "as options.unit", "largest number accepted").optional(),
                        flag("options.text", "true: any text is accepted, not only a number").otherwise(false)},
         .text = "Waits for a number, or a text.",
         .returns = "The number or text.",
         .errors = kErrors,
         .call = host::operators::enter},
        {.name = "wired",
         .parameters = {number("load", "ohm", "the load to connect").atLeast(0).optional()},
         .text = "Shows how to wire load, shunt and oscilloscope, and waits until the operator confirms \"wiring\". A "
                 "simulated bench is wired; the report says so and no question is asked.",
         .returns = "true",
         .errors =
             "Throws when the run has no operator and --set wiring=yes was not given, or when the run is stopped.",
         .asks = "wiring",
         .call = host::operators::wired},
    };
}

}  // namespace tacto
