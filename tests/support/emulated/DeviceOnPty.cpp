#include "tests/support/emulated/DeviceOnPty.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <termios.h>
#include <unistd.h>

namespace tacto::test {

Result<std::unique_ptr<PseudoTerminal>> PseudoTerminal::open() {
    std::unique_ptr<PseudoTerminal> made(new PseudoTerminal);
    made->master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    made->wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    std::array<char, 64> name{};
    if (made->master_ < 0 || made->wake_ < 0 || grantpt(made->master_) != 0 || unlockpt(made->master_) != 0 ||
        ptsname_r(made->master_, name.data(), name.size()) != 0) {
        return fail(ErrorCode::Io, "the system gives no pseudo-terminal: {}", std::strerror(errno));
    }
    made->path_ = name.data();
    made->slave_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios raw{};
    if (made->slave_ < 0 || tcgetattr(made->slave_, &raw) != 0)
        return fail(ErrorCode::Io, "pseudo-terminal {} cannot be opened: {}", made->path_, std::strerror(errno));
    cfmakeraw(&raw);  // otherwise what a client sends before it sets up the terminal is echoed
    tcsetattr(made->slave_, TCSANOW, &raw);
    return made;
}

PseudoTerminal::~PseudoTerminal() {
    stop();
    for (const int end : {master_, slave_, wake_}) {
        if (end >= 0) ::close(end);
    }
}

void PseudoTerminal::listen(std::function<void(std::span<const std::uint8_t>)> receive) {
    listener_ = std::thread([this, receive = std::move(receive)] {
        std::array<std::uint8_t, 1024> bytes{};
        for (;;) {
            pollfd look[] = {{master_, POLLIN, 0}, {wake_, POLLIN, 0}};
            if (poll(look, 2, -1) < 0 && errno != EINTR) return;
            if ((look[1].revents & POLLIN) != 0) return;
            const auto got = ::read(master_, bytes.data(), bytes.size());
            if (got > 0) receive(std::span<const std::uint8_t>(bytes).first(static_cast<std::size_t>(got)));
        }
    });
}

void PseudoTerminal::stop() {
    if (!listener_.joinable()) return;
    const std::uint64_t one = 1;
    static_cast<void>(!::write(wake_, &one, sizeof one));
    listener_.join();
}

void PseudoTerminal::send(std::span<const std::uint8_t> bytes) const noexcept {
    while (!bytes.empty()) {
        const auto written = ::write(master_, bytes.data(), bytes.size());
        if (written < 0 && errno != EAGAIN && errno != EINTR) return;
        if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
        pollfd room{master_, POLLOUT, 0};
        if (!bytes.empty() && poll(&room, 1, 1000) == 0) return;
    }
}

}  // namespace tacto::test
