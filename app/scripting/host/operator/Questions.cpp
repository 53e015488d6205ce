// The person at the bench: what is asked, and the wiring as drawn.
#include <algorithm>

#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/engine/ScriptSession.h"
#include "app/scripting/host/operator/OperatorObject.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::operators {

namespace {

OperatorQuestion questionFrom(const Arguments& arguments, OperatorQuestion::Kind kind) {
    OperatorQuestion question;
    question.kind = kind;
    question.name = arguments.text("name");
    question.text = arguments.text("text");
    return question;
}

bool isSimulated(const DeviceSet& devices) {
    const auto all = devices.identities();
    return std::all_of(all.begin(), all.end(), [](const DeviceIdentity& device) { return device.simulated; });
}

}  // namespace

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
    if (!isSimulated(session.bench().devices())) {
        OperatorQuestion question;
        question.name = "wiring";
        question.text = load +
                        " as drawn: both oscilloscope grounds at one node, the shunt in the low side, its drop "
                        "subtracted from the voltage; no person is connected";
        question.drawing = "wiring";
        return session.ask(question);
    }
    if (session.writer() == nullptr) return Json(true);
    auto written = session.writer()->reportItem(
        session.now(), {{"kind", "text"}, {"text", "Wiring: the simulated bench, wired as the drawing shows."}});
    if (!written) return failure(written);
    return Json(true);
}

}  // namespace tacto::host::operators
