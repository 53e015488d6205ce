#include "app/scripting/engine/ProtocolDeclaration.h"

#include <algorithm>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/DeclaredText.h"
#include "core/base/JsonText.h"
#include "core/base/Words.h"
#include "core/kinds/ResultKinds.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

Result<std::set<Role>> readNeeds(const Json& given) {
    std::set<Role> needs;
    const Json list = given.value("needs", Json::array());
    if (!list.is_array()) {
        return fail(ErrorCode::InvalidArgument, "\"needs\" is {}; a list of {} is expected", shown(list),
                    namesOf(kRoles));
    }
    for (const auto& name : list) {
        const auto role = name.is_string() ? valueFor(kRoles, name.get_ref<const std::string&>()) : std::nullopt;
        if (!role) {
            return fail(ErrorCode::InvalidArgument, "\"needs\" contains {}; only {} can be needed", shown(name),
                        namesOf(kRoles));
        }
        needs.insert(*role);
    }
    return needs;
}

bool answers(const std::string& question, const std::string& key) {
    if (question.ends_with('*')) return key.starts_with(std::string_view(question).substr(0, question.size() - 1));
    return question == key;
}

constexpr Word<ProtocolView> kViews[] = {{"trials", ProtocolView::Trials},
                                         {"loads", ProtocolView::Loads},
                                         {"calibration", ProtocolView::Calibration},
                                         {"slides", ProtocolView::Slides},
                                         {"none", ProtocolView::None}};

/// Returns the view that the kind and the devices suggest, for a script that declares none.
ProtocolView usualView(const ProtocolDeclaration& declaration) {
    const auto kind = resultTraits(declaration.kind).kind;
    if (kind == ResultKind::LoadSafety) return ProtocolView::Loads;
    if (kind == ResultKind::StimulatorCalibration) return ProtocolView::Calibration;
    if (declaration.needs.contains(Role::Oscilloscope)) return ProtocolView::Trials;
    return declaration.needs == std::set{Role::Sensor} ? ProtocolView::Slides : ProtocolView::None;
}

Result<ProtocolView> readView(const Json& given, const ProtocolDeclaration& declaration) {
    if (!given.contains("view")) return usualView(declaration);
    const Json& said = given["view"];
    const auto view = said.is_string() ? valueFor(kViews, said.get_ref<const std::string&>()) : std::nullopt;
    if (view) return *view;
    return fail(ErrorCode::InvalidArgument, "view is {}; trials, loads, calibration, slides or none is expected",
                shown(said));
}

}  // namespace

std::string fileOf(const ProtocolSource& source) {
    return source.path.empty() ? source.name + ".js" : source.path.string();
}

std::string originOf(const ProtocolSource& source) {
    if (source.shipped) return "shipped with the program";
    return source.path.empty() ? "a text that lies in no file" : source.path.string();
}

Result<ProtocolDeclaration> parseDeclaration(const Json& given, const Json& order, const Json& choiceOrder) {
    if (!given.is_object()) {
        return fail(ErrorCode::InvalidArgument, "protocol() was given {}, an object is expected", shown(given));
    }
    const auto known = onlyKeys(given, {"title", "purpose", "kind", "needs", "view", "parameters"}, "protocol()");
    if (!known) return failure(known.map_error(asInvalidArgument));
    ProtocolDeclaration out;
    auto title = declaredText(given, "protocol()", "title", true, kMaxDeclaredTitle);
    if (!title) return failure(title);
    out.title = *title;
    auto purpose = declaredText(given, "protocol()", "purpose", false);
    if (!purpose) return failure(purpose);
    out.purpose = *purpose;
    auto kind = declaredText(given, "protocol()", "kind", false, kMaxDeclaredTitle);
    if (!kind) return failure(kind);
    out.kind = *kind;
    auto needs = readNeeds(given);
    if (!needs) return failure(needs);
    out.needs = *needs;
    auto view = readView(given, out);
    if (!view) return failure(view);
    out.view = *view;
    const Json parameters = given.value("parameters", Json::object());
    if (!parameters.is_object()) {
        return fail(ErrorCode::InvalidArgument, "parameters is {}, an object is expected", shown(parameters));
    }
    if (!order.is_array() || !choiceOrder.is_array())
        return fail(ErrorCode::InvalidArgument, "the names of the parameters cannot be listed");
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto name = order[i].is_string() ? order[i].get<std::string>() : std::string();
        auto parameter = parseParameter(name, parameters.value(name, Json()),
                                        i < choiceOrder.size() ? choiceOrder[i] : Json::array());
        if (!parameter) return failure(parameter);
        out.parameters.push_back(std::move(*parameter));
    }
    return out;
}

std::string differenceOf(const ProtocolDeclaration& before, const ProtocolDeclaration& now) {
    if (now.title != before.title)
        return fmt::format("another title ({} in place of {})", shown(now.title), shown(before.title));
    if (now.purpose != before.purpose) return "another purpose";
    if (now.kind != before.kind) return "another kind of result";
    if (now.needs != before.needs) return "other devices";
    if (now.view != before.view) return "another view";
    if (now.parameters.size() != before.parameters.size()) return "other parameters";
    for (std::size_t i = 0; i < now.parameters.size(); ++i) {
        if (now.parameters[i] == before.parameters[i]) continue;
        return fmt::format("another parameter {}", shown(now.parameters[i].name));
    }
    return {};
}

Result<ProtocolSettings> applySettings(const ProtocolDeclaration& declaration,
                                       const std::map<std::string, std::string>& settings) {
    ProtocolSettings out;
    for (const auto& parameter : declaration.parameters) out.parameters[parameter.name] = parameter.value;
    for (const auto& [key, text] : settings) {
        const auto parameter = std::find_if(declaration.parameters.begin(), declaration.parameters.end(),
                                            [&wanted = key](const auto& one) { return one.name == wanted; });
        if (parameter != declaration.parameters.end()) {
            auto value = parseSetting(*parameter, text);
            if (!value) return failure(value);
            out.parameters[key] = *value;
            // A choice only selects one of the script's own texts; it contains no words of the operator.
            (parameter->type == ParameterType::Choice ? out.chosen : out.given).insert(key);
            continue;
        }
        const bool asked =
            declaration.hasOtherQuestions ||
            std::any_of(declaration.questions.begin(), declaration.questions.end(),
                        [&wanted = key](const std::string& question) { return answers(question, wanted); });
        if (!asked) {
            std::vector<std::string> known;
            for (const auto& one : declaration.parameters) known.push_back(one.name);
            known.insert(known.end(), declaration.questions.begin(), declaration.questions.end());
            return fail(ErrorCode::InvalidArgument, "{} has no parameter {}; it has {}", declaration.name, key,
                        known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
        }
        out.answers[key] = text;
    }
    return out;
}

Json toJson(const ProtocolDeclaration& declaration) {
    Json needs = Json::array();
    for (const auto role : declaration.needs) needs.push_back(nameOf(role));
    Json parameters = Json::array();
    for (const auto& parameter : declaration.parameters) parameters.push_back(toJson(parameter));
    return {{"name", declaration.name},
            {"title", declaration.title},
            {"purpose", declaration.purpose},
            {"kind", declaration.kind.empty() ? Json() : Json(declaration.kind)},
            {"needs", needs},
            {"view", wordFor(kViews, declaration.view)},
            {"parameters", parameters},
            {"questions", declaration.questions}};
}

}  // namespace tacto
