// Whatever tactoscope-declare answers, be it taken over by the script: a declaration or a sentence, and every default
// of a declaration that was read is one that its parameter accepts (hazard H10).
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/scripting/engine/DeclarationReader.h"
#include "app/scripting/engine/ProtocolDeclaration.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::DeclarationFuzz {

TACTO_FUZZ(DeclarationFuzz, const std::uint8_t* data, std::size_t size) {
    const auto answer = tacto::readAnswer({reinterpret_cast<const char*>(data), size}, "fuzz.js");
    if (!answer) {
        if (answer.error().message.empty()) std::abort();
        return 0;
    }
    const auto declared = tacto::parseDeclaration((*answer)[0], (*answer)[1], (*answer)[2]);
    if (!declared) {
        if (declared.error().message.empty()) std::abort();
        return 0;
    }
    if (!tacto::applySettings(*declared, {})) std::abort();
    static_cast<void>(tacto::toJson(*declared));
    return 0;
}

}  // namespace tacto::fuzz::DeclarationFuzz
