// AboutJson.h - SessionAbout and SessionStream as the JSON of their log rows.
//
// Thread-safety: pure functions.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/session/SessionTypes.h"

namespace tacto {

[[nodiscard]] nlohmann::json toJson(const SessionAbout& about);
/// Missing fields stay empty.
[[nodiscard]] SessionAbout aboutFrom(const nlohmann::json& json);
/// What the same seed must reproduce of it: wall time, versions and paths left out.
[[nodiscard]] nlohmann::json reproducible(const SessionAbout& about);

[[nodiscard]] nlohmann::json toJson(const SessionStream& stream);
[[nodiscard]] SessionStream streamFrom(const nlohmann::json& json);

}  // namespace tacto
