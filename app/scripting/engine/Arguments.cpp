#include "app/scripting/engine/Arguments.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/JsonText.h"
#include "core/base/Statistics.h"
#include "core/electrode/Load.h"

namespace tacto {

namespace {

const nlohmann::json kLeftOut;
constexpr std::string_view kOptions = "options";

std::string_view rootOf(std::string_view name) { return name.substr(0, name.find('.')); }

/// Returns "trains" for "options.trains".
std::string_view spokenName(std::string_view name) {
    return name.starts_with(kOptionPrefix) ? name.substr(kOptionPrefix.size()) : name;
}

}  // namespace

std::string shown(const nlohmann::json& value) {
    if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        return std::isnan(value.get<double>()) ? "NaN" : value.get<double>() > 0 ? "Infinity" : "-Infinity";
    }
    if (value.is_number()) return fmt::format("{}", value.get<double>());
    if (value.is_null()) return "nothing";
    return shownJson(value);
}

tl::unexpected<Error> otherThanExpected(std::string_view function, std::string_view name, const nlohmann::json& value,
                                        std::string_view accepted) {
    return fail(ErrorCode::InvalidArgument, "{}: {} is {}, {} is expected", function, name, shown(value), accepted);
}

const std::vector<HostParameter>& Arguments::parameters() const noexcept {
    return function_.passes.empty() ? function_.parameters : function_.passes;
}

const nlohmann::json& Arguments::passed(std::string_view name) const {
    const auto root = rootOf(name);
    std::size_t position = 0;
    std::string_view last;
    for (const auto& parameter : parameters()) {
        const auto own = rootOf(parameter.name);
        if (own == root) break;
        if (own != last) ++position;
        last = own;
    }
    if (position >= list_.size()) return kLeftOut;
    const nlohmann::json* at = &list_[position];
    for (auto rest = name.substr(root.size()); !rest.empty();) {
        const auto key = rootOf(rest.substr(1));
        if (!at->is_object()) return kLeftOut;
        const auto member = at->find(key);
        if (member == at->end()) return kLeftOut;
        at = &*member;
        rest = rest.substr(1 + key.size());
    }
    return *at;
}

tl::unexpected<Error> Arguments::wrong(std::string_view name, const nlohmann::json& value,
                                       std::string_view accepted) const {
    return otherThanExpected(function_.fullName(), name, value, accepted);
}

/// A mistyped option must not silently leave its default in force.
Result<void> Arguments::checkMembers(std::string_view of) const {
    const auto& value = passed(of);
    if (value.is_null()) return {};
    if (!value.is_object()) return wrong(of == kOptions ? "the options" : spokenName(of), value, "an object");
    std::vector<std::string_view> known;
    for (const auto& parameter : parameters()) {
        const auto dot = parameter.name.rfind('.');
        if (dot == of.size() && parameter.name.starts_with(of)) known.push_back(parameter.name.substr(dot + 1));
    }
    return onlyKeys(value, known, function_.fullName()).map_error(asInvalidArgument);
}

Result<void> Arguments::check(const HostParameter& parameter) const {
    if (parameter.type == ValueType::Any) return {};
    const auto& value = passed(parameter.name);
    const bool isMember = parameter.name.find('.') != std::string_view::npos;
    const bool leftOut = &value == &kLeftOut || (value.is_null() && !isMember);
    if (leftOut ? parameter.mayBeLeftOut || parameter.mayBeNull : parameter.accepts(value)) {
        if (parameter.type != ValueType::Load || !value.is_string()) return {};
        if (auto load = parseLoad(value.get<std::string>()); !load) return failure(load);
        return {};
    }
    const bool ohms = parameter.type == ValueType::Load && value.is_number();
    return wrong(spokenName(parameter.name), value, ohms ? "ohms above 0" : parameter.accepted());
}

Result<Arguments> Arguments::check(const HostFunction& function, const nlohmann::json& list) {
    Arguments arguments(function, list);
    std::string_view checked;
    for (const auto& parameter : arguments.parameters()) {
        if (parameter.name.starts_with(kOptionPrefix)) {
            const auto parent = parameter.name.substr(0, parameter.name.rfind('.'));
            if (parent != checked) {
                if (auto known = arguments.checkMembers(parent); !known) return failure(known);
            }
            checked = parent;
        }
        if (auto fits = arguments.check(parameter); !fits) return failure(fits);
    }
    return arguments;
}

const nlohmann::json& Arguments::value(std::string_view name, ValueType type) const {
    for (const auto& parameter : parameters()) {
        if (parameter.name != name) continue;
        if (parameter.type != type) break;
        const auto& value = passed(name);
        return value.is_null() ? parameter.usual : value;
    }
    throw std::logic_error(fmt::format("{} declares no {} of this type", function_.fullName(), name));
}

double Arguments::number(std::string_view name) const { return number(name, kNaN); }

double Arguments::number(std::string_view name, double fallback) const {
    const auto& given = value(name, ValueType::Number);
    return given.is_null() ? fallback : given.get<double>();
}

int Arguments::whole(std::string_view name, int fallback) const {
    const auto& given = value(name, ValueType::Whole);
    return given.is_null() ? fallback : given.get<int>();
}

bool Arguments::flag(std::string_view name) const {
    const auto& given = value(name, ValueType::Flag);
    return !given.is_null() && given.get<bool>();
}

std::string Arguments::text(std::string_view name) const {
    const auto& given = value(name, ValueType::Text);
    return given.is_null() ? std::string() : given.get<std::string>();
}

const nlohmann::json& Arguments::list(std::string_view name) const {
    static const nlohmann::json kNone = nlohmann::json::array();
    const auto& given = value(name, ValueType::List);
    return given.is_null() ? kNone : given;
}

const nlohmann::json& Arguments::object(std::string_view name) const {
    static const nlohmann::json kNone = nlohmann::json::object();
    const auto& given = value(name, ValueType::Object);
    return given.is_null() ? kNone : given;
}

std::string Arguments::load(std::string_view name) const {
    const auto& given = value(name, ValueType::Load);
    if (given.is_number()) return fmt::format("{} ohm", given.get<double>());
    return given.is_null() ? std::string() : given.get<std::string>();
}

const nlohmann::json& Arguments::any(std::string_view name) const { return value(name, ValueType::Any); }

bool Arguments::isNull(std::string_view name) const {
    const auto& value = passed(name);
    return &value != &kLeftOut && value.is_null();
}

bool Arguments::has(std::string_view name) const { return !passed(name).is_null(); }

}  // namespace tacto
