// The person at the bench.
#include <limits>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ProtocolLibrary.h"
#include "app/scripting/ScriptSession.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Result<OperatorQuestion> questionFrom(const Arguments& arguments, OperatorQuestion::Kind kind) {
    auto name = arguments.text(0, "name");
    if (!name) return failure(name);
    auto text = arguments.text(1, "text");
    if (!text) return failure(text);
    constexpr std::size_t kMaxText = 2000;  // more than one reads, and than a window draws at once
    if (text->size() > kMaxText) {
        return fail(ErrorCode::InvalidArgument, "the question \"{}\" has {} characters; at most {} are accepted", *name,
                    text->size(), kMaxText);
    }
    OperatorQuestion question;
    question.kind = kind;
    question.name = *name;
    question.text = *text;
    return question;
}

Result<Json> confirm(ScriptSession& session, const Json& list) {
    const Arguments arguments("operator.confirm", list);
    auto question = questionFrom(arguments, OperatorQuestion::Kind::Confirm);
    if (!question) return failure(question);
    auto options = arguments.options(2, {"drawing"});
    if (!options) return failure(options);
    auto drawing = arguments.text(*options, "drawing", "");
    if (!drawing) return failure(drawing);
    if (!drawing->empty()) {
        if (const auto file = drawingFile(*drawing); !file) return failure(file);
    }
    question->drawing = *drawing;
    return session.ask(*question);
}

Result<Json> choose(ScriptSession& session, const Json& list) {
    const Arguments arguments("operator.choose", list);
    auto question = questionFrom(arguments, OperatorQuestion::Kind::Choose);
    if (!question) return failure(question);
    const Json& choices = arguments.at(2);
    if (choices.is_object()) {
        for (const auto& [key, text] : choices.items()) {
            question->choices.emplace_back(key, text.is_string() ? text.get<std::string>() : key);
        }
    } else if (choices.is_array()) {
        for (const auto& key : choices) {
            if (key.is_string()) question->choices.emplace_back(key.get<std::string>(), key.get<std::string>());
        }
    }
    if (question->choices.size() < 2) {
        return arguments.wrong("choices", choices, "a list of at least two texts, or an object of them");
    }
    return session.ask(*question);
}

Result<Json> enter(ScriptSession& session, const Json& list) {
    const Arguments arguments("operator.enter", list);
    auto question = questionFrom(arguments, OperatorQuestion::Kind::Enter);
    if (!question) return failure(question);
    auto options = arguments.options(2, {"unit", "min", "max", "text"});
    if (!options) return failure(options);
    auto unit = arguments.text(*options, "unit", "");
    if (!unit) return failure(unit);
    constexpr double kNone = std::numeric_limits<double>::lowest();
    auto min = arguments.number(*options, "min", kNone);
    if (!min) return failure(min);
    auto max = arguments.number(*options, "max", kNone);
    if (!max) return failure(max);
    question->unit = *unit;
    question->number = options->value("text", Json()) != Json(true);
    if (options->contains("min")) question->min = *min;
    if (options->contains("max")) question->max = *max;
    return session.ask(*question);
}

}  // namespace

std::vector<HostFunction> operatorFunctions() {
    constexpr std::string_view kErrors =
        "Throws when nobody is here and --set NAME=... was not given, when it does not fit, or when the run is "
        "stopped.";
    return {
        {"operator",
         "confirm",
         HostKind::Function,
         {{"name", "text", "", "key of --set; answered with yes"},
          {"text", "text", "", "what the operator confirms"},
          {"options.drawing", "text", "", "name of a shipped drawing to show", true}},
         "Waits until the operator confirms. A refusal ends the run.",
         "true",
         kErrors,
         confirm},
        {"operator",
         "choose",
         HostKind::Function,
         {{"name", "text", "", "key of --set"},
          {"text", "text", "", "the question"},
          {"choices", "object or list", "", "keys with their explanations, or the keys alone; at least two"}},
         "Waits for one of several answers.",
         "The key chosen.",
         kErrors,
         choose},
        {"operator",
         "enter",
         HostKind::Function,
         {{"name", "text", "", "key of --set"},
          {"text", "text", "", "what is to be entered"},
          {"options.unit", "text", "", "unit that the number is shown with", true},
          {"options.min", "number", "as options.unit", "smallest number accepted", true},
          {"options.max", "number", "as options.unit", "largest number accepted", true},
          {"options.text", "boolean", "", "true: any text is accepted, not only a number", true}},
         "Waits for a number, or a text.",
         "The number or text.",
         kErrors,
         enter},
    };
}

}  // namespace tacto
