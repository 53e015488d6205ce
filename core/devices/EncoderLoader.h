// EncoderLoader.h - a board into whose encoder the bench writes its profile when it opens: a simulated one. A real
// board has a profile of its own (resources/firmware/tactile_encoder), and the bench only compares its hash.
//
// Thread-safety: before the first read(), by the one who opened the device.
#pragma once

#include <string_view>

#include "core/base/Result.h"

namespace tacto {

class EncoderLoader {
public:
    virtual ~EncoderLoader() = default;
    /// False for a board that is not to encode, or whose address names a profile: it keeps what it has.
    [[nodiscard]] virtual bool wantsProfile() const noexcept = 0;
    /// Switches the board off and on with this profile, as te_read_profile() reads it. Errors: InvalidArgument for
    /// bytes that are no profile; Device if the board refuses it.
    [[nodiscard]] virtual Result<void> load(std::string_view profile) = 0;
};

}  // namespace tacto
