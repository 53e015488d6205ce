// Questions to the person at the bench, and the wiring diagram.
#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/DeclaredText.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptSession.h"

namespace tacto::host::operators {

namespace {

using Json = nlohmann::json;

OperatorQuestion questionFrom(const Arguments& arguments, OperatorQuestion::Kind kind) {
    OperatorQuestion question;
    question.kind = kind;
    question.name = arguments.text("name");
    question.text = arguments.text("text");
    return question;
}

Result<Json> confirm(ScriptSession& session, const Arguments& arguments) {
    auto question = questionFrom(arguments, OperatorQuestion::Kind::Confirm);
    const auto drawing = arguments.text("options.drawing");
    if (!drawing.empty()) {
        if (const auto file = drawingFile(drawing); !file) return failure(file);
    }
    question.drawing = drawing;
    return session.ask(question);
}

Result<Json> choose(ScriptSession& session, const Arguments& arguments) {
    auto question = questionFrom(arguments, OperatorQuestion::Kind::Choose);
    const Json& choices = arguments.any("choices");
    if (choices.is_object()) {
        for (const auto& [key, text] : choices.items()) {
            question.choices.emplace_back(key, text.is_string() ? text.get<std::string>() : key);
        }
    } else if (choices.is_array()) {
        for (const auto& key : choices) {
            if (key.is_string()) question.choices.emplace_back(key.get<std::string>(), key.get<std::string>());
        }
    }
    if (question.choices.size() < 2) {
        return arguments.wrong("choices", choices, "a list of at least two texts, or an object of them");
    }
    return session.ask(question);
}

Result<Json> enter(ScriptSession& session, const Arguments& arguments) {
    auto question = questionFrom(arguments, OperatorQuestion::Kind::Enter);
    question.unit = arguments.text("options.unit");
    question.number = !arguments.flag("options.text");
    if (arguments.has("options.min")) question.min = arguments.number("options.min");
    if (arguments.has("options.max")) question.max = arguments.number("options.max");
    return session.ask(question);
}

Result<Json> wired(ScriptSession& session, const Arguments& arguments) {
    const auto load = arguments.has("load") ? fmt::format("The load of {} ohm is connected", arguments.number("load"))
                                            : std::string("Connected");
    if (!session.isSimulated()) {
        OperatorQuestion question;
        question.name = "wiring";
        question.text = load +
                        " as drawn: both oscilloscope grounds at one node, the shunt in the low side, its drop "
                        "subtracted from the voltage; no person is connected";
        question.drawing = "wiring";
        return session.ask(question);
    }
    if (auto said = session.reportText("Wiring: the simulated bench, wired as the drawing shows."); !said)
        return failure(said);
    return Json(true);
}

}  // namespace

}  // namespace tacto::host::operators

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
         .asks = {"wiring"},
         .call = host::operators::wired},
    };
}

}  // namespace tacto
