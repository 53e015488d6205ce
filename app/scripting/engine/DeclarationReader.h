// DeclarationReader.h - runs a script's top level and takes what it gives to protocol(). Unlike
// readDeclaration() it does so in this process, which a script can crash (nested regular expressions, circles of
// proxies): for the program tactoscope-declare, and for scripts that come with the program (hazard H10).
//
// Thread-safety: pure function but for the thread that it runs the script on.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>

#include "app/scripting/engine/ProtocolDeclaration.h"
#include "core/base/Result.h"

namespace tacto {

/// The three lists that parseDeclaration() takes, in that order. Errors: as readDeclaration().
[[nodiscard]] Result<nlohmann::json> declareHere(const ProtocolSource& source, std::chrono::milliseconds limit);

/// What tactoscope-declare answers on its standard output: the lists, or the error.
[[nodiscard]] nlohmann::json answerOf(const Result<nlohmann::json>& declared);
/// `from` names the script in the error of an answer that is none. Errors: the one of the answer; ParseError.
[[nodiscard]] Result<nlohmann::json> readAnswer(std::string_view answer, std::string_view from);

}  // namespace tacto
