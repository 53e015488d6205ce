// Loopback.h - a socket that accepts connections only from this computer.
//
// Thread-safety: a pure function, apart from the system call.
#pragma once

#include <cstdint>

#include "core/base/Result.h"

namespace tacto {

struct LoopbackSocket {
    int descriptor;  ///< non-blocking; the caller closes it; programs that are started do not inherit it
    std::uint16_t port;
};

/// Listens on 127.0.0.1, on a port that the system chooses. `backlog`: how many connections may wait.
/// Errors: Io with the system's reason.
[[nodiscard]] Result<LoopbackSocket> listenOnLoopback(int backlog);

}  // namespace tacto
