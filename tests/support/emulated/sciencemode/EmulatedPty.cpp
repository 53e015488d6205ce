#include "tests/support/emulated/sciencemode/EmulatedPty.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <termios.h>
#include <unistd.h>

namespace tacto::sciencemode {

Result<std::unique_ptr<EmulatedPty>> EmulatedPty::open(EmulatedSettings settings, const Clock& clock) {
    std::unique_ptr<EmulatedPty> pty(new EmulatedPty(std::move(settings), clock));
    pty->master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    pty->wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    std::array<char, 64> name{};
    termios raw{};
    if (pty->master_ < 0 || pty->wake_ < 0 || grantpt(pty->master_) != 0 || unlockpt(pty->master_) != 0 ||
        ptsname_r(pty->master_, name.data(), name.size()) != 0) {
        return fail(ErrorCode::Io, "the system gives no pseudo-terminal: {}", std::strerror(errno));
    }
    pty->path_ = name.data();
    pty->slave_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (pty->slave_ < 0 || tcgetattr(pty->slave_, &raw) != 0) {
        return fail(ErrorCode::Io, "pseudo-terminal {} cannot be opened: {}", pty->path_, std::strerror(errno));
    }
    cfmakeraw(&raw);  // else what a client sends before it has set up the terminal comes back as an echo
    tcsetattr(pty->slave_, TCSANOW, &raw);
    pty->thread_ = std::thread([self = pty.get()] { self->run(); });
    return pty;
}

EmulatedPty::~EmulatedPty() {
    quitting_ = true;
    if (thread_.joinable()) {
        const std::uint64_t one = 1;
        static_cast<void>(!::write(wake_, &one, sizeof one));
        thread_.join();
    }
    for (const int end : {master_, slave_, wake_}) {
        if (end >= 0) ::close(end);
    }
}

void EmulatedPty::answer() {
    std::array<std::uint8_t, 1024> bytes{};
    std::size_t size = 0;
    {
        const std::scoped_lock lock(mutex_);
        size = device_.transmit(bytes, clock_.now());
    }
    std::span<const std::uint8_t> rest(bytes.data(), size);
    while (!rest.empty() && !quitting_) {
        const auto sent = ::write(master_, rest.data(), rest.size());
        if (sent > 0) {
            rest = rest.subspan(static_cast<std::size_t>(sent));
        } else if (sent < 0 && errno != EAGAIN && errno != EINTR) {
            return;
        } else {
            pollfd room[] = {{master_, POLLOUT, 0}, {wake_, POLLIN, 0}};
            poll(room, 2, -1);  // a client that does not read holds its device up, as a USB pipe does
        }
    }
}

void EmulatedPty::run() {
    std::array<std::uint8_t, 1024> bytes{};
    while (!quitting_) {
        std::optional<Instant> due;
        {
            const std::scoped_lock lock(mutex_);
            due = device_.nextTransmit();
        }
        const auto left = due ? std::max(Instant(0), *due - clock_.now()) : Instant(std::chrono::hours(1));
        const timespec time{left.count() / 1'000'000'000, left.count() % 1'000'000'000};
        pollfd look[] = {{master_, POLLIN, 0}, {wake_, POLLIN, 0}};
        ppoll(look, 2, &time, nullptr);
        if (const auto got = ::read(master_, bytes.data(), bytes.size()); got > 0) {
            const std::scoped_lock lock(mutex_);
            device_.receive(std::span<const std::uint8_t>(bytes).first(static_cast<std::size_t>(got)), clock_.now());
        }
        answer();
    }
}

}  // namespace tacto::sciencemode
