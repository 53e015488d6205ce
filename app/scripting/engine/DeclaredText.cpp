#include "app/scripting/engine/DeclaredText.h"

#include "app/scripting/engine/Arguments.h"

namespace tacto {

Result<void> noLongerThan(std::string_view where, std::string_view what, const std::string& text, std::size_t most) {
    if (text.size() <= most) return {};
    return fail(ErrorCode::InvalidArgument, "{}: {} has {} characters, at most {} are accepted", where, what,
                text.size(), most);
}

Result<std::string> declaredText(const nlohmann::json& object, std::string_view where, const char* key, bool required,
                                 std::size_t most) {
    const auto at = object.find(key);
    if (at == object.end() && !required) return std::string();
    if (at == object.end() || !at->is_string() || (required && at->get_ref<const std::string&>().empty())) {
        return fail(ErrorCode::InvalidArgument, "{}: {} is {}, a text is expected", where, key,
                    at == object.end() ? "missing" : shown(*at));
    }
    auto text = at->get<std::string>();
    if (const auto fits = noLongerThan(where, key, text, most); !fits) return failure(fits);
    return text;
}

}  // namespace tacto
