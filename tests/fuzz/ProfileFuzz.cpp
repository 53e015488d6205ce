// Any text as a profile is read or refused with a sentence; a profile that was read is written and read again as the
// same text (hazard H10).
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/bench/Profile.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::ProfileFuzz {

TACTO_FUZZ(ProfileFuzz, const std::uint8_t* data, std::size_t size) {
    const auto profile = tacto::parseProfile({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    if (!profile) {
        if (profile.error().message.empty()) std::abort();
        return 0;
    }
    const auto text = tacto::toJson(*profile).dump();
    const auto again = tacto::parseProfile(text, "again.json");
    if (!again || tacto::toJson(*again).dump() != text) std::abort();
    return 0;
}

}  // namespace tacto::fuzz::ProfileFuzz
