// Loopback.h - a socket that listens on this computer alone.
//
// Thread-safety: a pure function, apart from the system call.
#pragma once

#include <cstdint>

#include "core/base/Result.h"

namespace tacto {

struct LoopbackSocket {
    int descriptor;  ///< the caller's to close; does not block, and is not handed on to programs that are started
    std::uint16_t port;
};

/// Listens on 127.0.0.1 at a port that the system chooses. `backlog`: how many connections may wait to be accepted.
/// Errors: Io with the system's reason.
[[nodiscard]] Result<LoopbackSocket> listenOnLoopback(int backlog);

}  // namespace tacto
