#include "core/base/Loopback.h"

#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace tacto {

Result<LoopbackSocket> listenOnLoopback(int backlog) {
    sockaddr_in local{};
    local.sin_family = AF_INET;
    local.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof local;
    const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): how the system call takes every kind of address
    auto* const address = reinterpret_cast<sockaddr*>(&local);
    if (listener < 0 || ::bind(listener, address, size) != 0 || ::listen(listener, backlog) != 0 ||
        ::getsockname(listener, address, &size) != 0) {
        const int error = errno;
        if (listener >= 0) ::close(listener);
        return fail(ErrorCode::Io, "{}", std::strerror(error));
    }
    return LoopbackSocket{listener, ntohs(local.sin_port)};
}

}  // namespace tacto
