// StreamCheck.h - which streams the roughness chain can judge.
//
// Thread-safety: pure function.
#pragma once

#include <span>

#include "core/base/Result.h"
#include "core/base/Stream.h"

namespace tacto {

/// Errors: InvalidArgument as RoughnessChain::create() lists them.
[[nodiscard]] Result<void> checkStreams(std::span<const StreamInfo> streams);

}  // namespace tacto
