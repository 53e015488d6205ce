// SessionBasis.h - on whom and on what the figures of a session rest. It is noted when the session begins, and every
// count, figure, name and sentence made of the session says it; what rests on one is never counted with another.
//
// Thread-safety: values and pure functions.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/Words.h"

namespace tacto {

enum class SessionBasis {
    Person,           ///< a person answered what real devices gave
    PersonSimulated,  ///< a person answered, as in a rehearsal; the devices were simulated, and nothing was felt
    Virtual,          ///< a virtual participant on simulated devices
};
inline constexpr Word<SessionBasis> kSessionBases[] = {{"person", SessionBasis::Person},
                                                       {"person on simulated devices", SessionBasis::PersonSimulated},
                                                       {"virtual participant", SessionBasis::Virtual}};
[[nodiscard]] constexpr std::string_view nameOf(SessionBasis basis) noexcept {
    return wordFor(Words<SessionBasis>(kSessionBases), basis);
}

[[nodiscard]] constexpr bool isSimulatedBasis(SessionBasis basis) noexcept { return basis != SessionBasis::Person; }

/// "P-7K3D", "P-7K3D (simulated devices)", "P-7K3D (virtual)".
[[nodiscard]] std::string namedWith(SessionBasis basis, std::string_view name);
/// "people", "people on simulated devices", "virtual participants"; of one "person", ...
[[nodiscard]] std::string_view peopleOf(SessionBasis basis, std::size_t n = 2) noexcept;
/// "3 people and 12 virtual participants"; "0 people" where there are none.
[[nodiscard]] std::string countsText(const std::map<SessionBasis, std::size_t>& counts);

/// What the results of a pilot protocol rest on: their member `participant` says it.
[[nodiscard]] SessionBasis basisIn(const nlohmann::json& results);

}  // namespace tacto
