// EncoderLoader.h - a board into whose encoder the bench writes its profile: a simulated one. A real board has a
// profile of its own (resources/firmware/tactile_encoder), and the bench only compares its hash.
//
// Thread-safety: load() as TactileSensor::read(), and never at the same time; wantsProfile() is constant.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// The profile for a board's encoder, as te_read_profile() reads it, and its hash.
struct BoardProfile {
    std::uint32_t hash = 0;
    std::string bytes;
};

class EncoderLoader {
public:
    virtual ~EncoderLoader() = default;
    /// False for a board that is not to encode, or whose address names a profile: it keeps what it has.
    [[nodiscard]] virtual bool wantsProfile() const noexcept = 0;
    /// Switches the board off and on with this profile (BoardProfile::bytes); if it does not begin so, with the one
    /// before. Unless it is `rested`, which says that nothing was put out in the last 8 s, its encoder is silent for
    /// the first 8 s. Errors: InvalidArgument for bytes that are no profile; Device if the board refuses it.
    [[nodiscard]] virtual Result<void> load(std::string_view profile, bool rested) = 0;
};

}  // namespace tacto
