#include "core/base/Stream.h"

namespace tacto {

std::string_view nameOf(StreamKind kind) noexcept { return wordFor(kStreamKinds, kind); }

std::string_view symbolOf(StreamUnit unit) noexcept { return wordFor(kStreamUnits, unit); }

}  // namespace tacto
