// A profile's encoding section is read or refused, without a crash; a section that was read is valid and can be written
// and read again (hazard H10).
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/encoding/EncodingProfile.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::EncodingSection {

TACTO_FUZZ(EncodingSection, const std::uint8_t* data, std::size_t size) {
    const auto section = nlohmann::json::parse(data, data + size, nullptr, false);
    if (section.is_discarded()) return 0;
    const auto profile = tacto::encodingProfileFrom(section);
    if (!profile) {
        if (profile.error().message.empty()) std::abort();
        return 0;
    }
    if (!tacto::validate(*profile)) std::abort();
    const auto again = tacto::encodingProfileFrom(tacto::toJson(*profile));
    if (!again || !(*again == *profile)) std::abort();
    return 0;
}

}  // namespace tacto::fuzz::EncodingSection
