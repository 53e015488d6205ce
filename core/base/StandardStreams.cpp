#include "core/base/StandardStreams.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace tacto {

void holdStandardStreams() noexcept {
    std::signal(SIGXFSZ, SIG_IGN);
    for (;;) {
        const int file = ::open("/dev/null", O_RDWR);  // the lowest number that is free
        if (file < 0) std::_Exit(3);
        if (file <= STDERR_FILENO) continue;
        ::close(file);
        return;
    }
}

bool takesMore(int stream) noexcept {
    pollfd out{stream, POLLOUT, 0};
    return ::poll(&out, 1, 0) == 1 && (out.revents & POLLOUT) != 0;
}

}  // namespace tacto
