// Any output of a script's process, even of a hostile script, becomes a value or a sentence. The argument of protocol()
// becomes a declaration or a sentence, and each default in a declaration is accepted by its parameter (hazard H10).
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/base/JsonText.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::DeclarationFuzz {

TACTO_FUZZ(DeclarationFuzz, const std::uint8_t* data, std::size_t size) {
    const auto given =
        tacto::parseCbor({reinterpret_cast<const char*>(data), size}, "a message", {.depth = 32, .values = 100'000});
    if (!given) {
        if (given.error().message.empty()) std::abort();
        return 0;
    }
    if (!given->is_array() || given->size() != 3) return 0;
    const auto declared = tacto::parseDeclaration((*given)[0], (*given)[1], (*given)[2]);
    if (!declared) {
        if (declared.error().message.empty()) std::abort();
        return 0;
    }
    if (!tacto::applySettings(*declared, {})) std::abort();
    static_cast<void>(tacto::toJson(*declared));
    return 0;
}

}  // namespace tacto::fuzz::DeclarationFuzz
