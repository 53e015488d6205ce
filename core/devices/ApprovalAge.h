// ApprovalAge.h - how a driver refuses what it was handed after its approval expired.
//
// Thread-safety: a pure function.
#pragma once

#include <string_view>

#include "core/base/Clock.h"
#include "core/base/Result.h"

namespace tacto {

/// `who` is the device within a sentence, `what` the train or burst: "the stimulator", "a train". Errors: Timeout where
/// `expires` is before `now`.
[[nodiscard]] inline Result<void> notExpired(Instant expires, Instant now, std::string_view who,
                                             std::string_view what) {
    if (now <= expires) return {};
    return fail(ErrorCode::Timeout, "{} refused {} whose approval expired {:.1f} ms ago", who, what,
                toSeconds(now - expires) * 1e3);
}

}  // namespace tacto
