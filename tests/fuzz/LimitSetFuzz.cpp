// Any text as a limit set is refused with a sentence, or gives limits that can be checked (H10).
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/safety/LimitSet.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::LimitSetFuzz {

TACTO_FUZZ(LimitSetFuzz, const std::uint8_t* data, std::size_t size) {
    const auto set = tacto::parseLimitSet({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    if (!set) {
        if (set.error().code != tacto::ErrorCode::ParseError || !set.error().message.starts_with("fuzz.json: "))
            std::abort();
        return 0;
    }
    if (set->id.empty() || set->id.size() > 31 || set->rows.empty()) std::abort();
    for (const auto& row : set->rows) {
        if (!(row.max > 0) || !std::isfinite(row.max) || row.source.empty()) std::abort();
        if (tacto::indexOf(row.quantity) >= tacto::kQuantityCount) std::abort();
        if (row.upToHz != 0 && !(row.upToHz > row.aboveHz)) std::abort();
    }
    return 0;
}

}  // namespace tacto::fuzz::LimitSetFuzz
