#include "app/scripting/Arguments.h"

#include <algorithm>
#include <cmath>

namespace tacto {

namespace {
const nlohmann::json kNull;

std::string describe(NumberRange range) {
    const char* kind = range.whole ? "a whole number" : "a number";
    const bool low = range.min > std::numeric_limits<double>::lowest();
    const bool high = range.max < std::numeric_limits<double>::max();
    if (low && high) return fmt::format("{} from {} to {}", kind, range.min, range.max);
    if (low) return fmt::format("{} of at least {}", kind, range.min);
    if (high) return fmt::format("{} of at most {}", kind, range.max);
    return kind;
}
}  // namespace

std::string shown(const nlohmann::json& value) {
    if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        return std::isnan(value.get<double>()) ? "NaN" : value.get<double>() > 0 ? "Infinity" : "-Infinity";
    }
    if (value.is_number()) return fmt::format("{}", value.get<double>());
    if (value.is_null()) return "nothing";
    std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    if (text.size() > 60) {
        std::size_t end = 57;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // whole characters only
        text = text.substr(0, end) + "...";
    }
    return text;
}

const nlohmann::json& Arguments::at(std::size_t index) const { return index < list_.size() ? list_[index] : kNull; }

tl::unexpected<Error> Arguments::wrong(std::string_view name, const nlohmann::json& value,
                                       std::string_view accepted) const {
    return fail(ErrorCode::InvalidArgument, "{}: {} is {}, {} is expected", function_, name, shown(value), accepted);
}

Result<double> Arguments::checked(const nlohmann::json& value, std::string_view name, NumberRange range) const {
    if (!value.is_number()) return wrong(name, value, describe(range));
    const double x = value.get<double>();
    if (!(x >= range.min && x <= range.max) || !std::isfinite(x) || (range.whole && x != std::floor(x))) {
        return wrong(name, value, describe(range));
    }
    return x;
}

Result<double> Arguments::number(std::size_t index, std::string_view name, NumberRange range) const {
    return checked(at(index), name, range);
}

Result<std::string> Arguments::text(std::size_t index, std::string_view name) const {
    const auto& value = at(index);
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) return wrong(name, value, "a text");
    return value.get<std::string>();
}

Result<nlohmann::json> Arguments::options(std::size_t index, std::vector<std::string_view> known) const {
    const auto& value = at(index);
    if (value.is_null()) return nlohmann::json::object();
    if (!value.is_object()) return wrong("the options", value, "an object");
    for (const auto& [key, member] : value.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            return fail(ErrorCode::InvalidArgument, "{}: there is no option {}, only {}", function_, key,
                        fmt::join(known, ", "));
        }
    }
    return value;
}

Result<const nlohmann::json*> Arguments::list(std::size_t index, std::string_view name) const {
    if (!at(index).is_array()) return wrong(name, at(index), "a list");
    return &at(index);
}

Result<const nlohmann::json*> Arguments::object(std::size_t index, std::string_view name) const {
    if (!at(index).is_object()) return wrong(name, at(index), "an object");
    return &at(index);
}

Result<double> Arguments::number(const nlohmann::json& object, std::string_view key, double fallback,
                                 NumberRange range) const {
    const auto member = object.find(key);
    if (member == object.end()) return fallback;
    return checked(*member, key, range);
}

Result<std::string> Arguments::text(const nlohmann::json& object, std::string_view key,
                                    std::string_view fallback) const {
    const auto member = object.find(key);
    if (member == object.end()) return std::string(fallback);
    if (!member->is_string()) return wrong(key, *member, "a text");
    return member->get<std::string>();
}

Result<bool> Arguments::flag(const nlohmann::json& object, std::string_view key, bool fallback) const {
    const auto member = object.find(key);
    if (member == object.end()) return fallback;
    if (!member->is_boolean()) return wrong(key, *member, "true or false");
    return member->get<bool>();
}

}  // namespace tacto
