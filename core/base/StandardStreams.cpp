#include "core/base/StandardStreams.h"

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
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

}  // namespace tacto
