#include "drivers/sciencemode/TtyTransport.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "drivers/system/FileHolders.h"

namespace tacto::sciencemode {
namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

std::string reason() { return std::strerror(errno); }

SteadyTime deadlineOf(Seconds timeout) {
    // An invalid or negative timeout means no wait; more than an hour becomes an hour.
    const double s = timeout.count() > 0 ? std::min(timeout.count(), 3600.0) : 0;
    return std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(Seconds(s));
}

tl::unexpected<Error> inUse(const std::string& path) {
    return fail(ErrorCode::Io, "terminal {} is held by {}; close that program first", path, textOf(holdersOf(path)));
}

enum class Wait { Ready, Late, Gone };

Wait waitFor(int terminal, short events, SteadyTime deadline) {
    for (;;) {
        const auto left = std::max(std::chrono::nanoseconds(0),
                                   std::chrono::nanoseconds(deadline - std::chrono::steady_clock::now()));
        const timespec time{left.count() / 1'000'000'000, left.count() % 1'000'000'000};
        pollfd look{terminal, events, 0};
        const int found = ppoll(&look, 1, &time, nullptr);
        if (found < 0 && errno == EINTR) continue;
        if (found < 0) return Wait::Gone;
        if (found == 0) return Wait::Late;
        if ((look.revents & events) != 0) return Wait::Ready;
        return Wait::Gone;  // hung up, or no longer a terminal
    }
}

}  // namespace

Result<std::unique_ptr<Transport>> TtyTransport::open(const std::string& path) {
    const int terminal = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (terminal < 0) {
        if (errno == EBUSY) return inUse(path);
        const auto code = errno == ENOENT ? ErrorCode::NotFound : ErrorCode::Io;
        return fail(code, "terminal {} cannot be opened: {}", path, reason());
    }
    // TIOCEXCL below keeps out other programs except the superuser's; the file lock keeps out those that ask for one.
    if (flock(terminal, LOCK_EX | LOCK_NB) != 0) {
        const bool locked = errno == EWOULDBLOCK;
        const auto why = reason();
        ::close(terminal);
        if (locked) return inUse(path);
        return fail(ErrorCode::Io, "terminal {} cannot be locked: {}", path, why);
    }
    std::unique_ptr<TtyTransport> transport(new TtyTransport(terminal, path));
    termios settings{};
    if (tcgetattr(terminal, &settings) != 0) {
        return fail(ErrorCode::Io, "{} is not a terminal: {}", path, reason());
    }
    cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    if (cfsetspeed(&settings, B115200) != 0 || tcsetattr(terminal, TCSANOW, &settings) != 0 ||
        ioctl(terminal, TIOCEXCL) != 0) {
        return fail(ErrorCode::Io, "terminal {} cannot be set up: {}", path, reason());
    }
    tcflush(terminal, TCIFLUSH);
    return transport;
}

TtyTransport::~TtyTransport() {
    ioctl(terminal_, TIOCNXCL);
    ::close(terminal_);
}

Result<void> TtyTransport::write(std::span<const std::uint8_t> bytes, Seconds timeout) {
    const auto deadline = deadlineOf(timeout);
    Result<void> outcome;
    {
        const std::scoped_lock line(line_);
        sendUrgent();
        auto rest = bytes;
        while (!rest.empty()) {
            const auto sent = ::write(terminal_, rest.data(), rest.size());
            if (sent > 0) {
                rest = rest.subspan(static_cast<std::size_t>(sent));
                continue;
            }
            if (sent < 0 && errno == EINTR) continue;
            if (sent < 0 && errno != EAGAIN) {
                outcome = fail(ErrorCode::Device, "terminal {} is gone: {}", path_, reason());
                break;
            }
            const auto waited = waitFor(terminal_, POLLOUT, deadline);
            if (waited == Wait::Ready) continue;
            outcome = waited == Wait::Late
                          ? fail(ErrorCode::Timeout, "terminal {} took {} of {} bytes in time", path_,
                                 bytes.size() - rest.size(), bytes.size())
                          : fail(ErrorCode::Device, "terminal {} is gone: its other end hung up", path_);
            break;
        }
        sendUrgent();
    }
    writeUrgent({});  // sends an urgent message that came while the lock was being released
    return outcome;
}

Result<std::size_t> TtyTransport::read(std::span<std::uint8_t> into, Seconds timeout) {
    const auto deadline = deadlineOf(timeout);
    for (;;) {
        const auto got = ::read(terminal_, into.data(), into.size());
        if (got > 0) return static_cast<std::size_t>(got);
        if (got < 0 && errno == EINTR) continue;
        if (got == 0 || errno != EAGAIN)
            return fail(ErrorCode::Device, "terminal {} is gone: its other end hung up", path_);
        const auto waited = waitFor(terminal_, POLLIN, deadline);
        if (waited == Wait::Late) return fail(ErrorCode::Timeout, "nothing came from terminal {} in time", path_);
        if (waited == Wait::Gone) return fail(ErrorCode::Device, "terminal {} is gone: its other end hung up", path_);
    }
}

bool TtyTransport::takeUrgent(Message& into) noexcept {
    const std::scoped_lock queue(queue_);
    if (urgentCount_ == 0) return false;
    into = urgent_[0];
    std::move(urgent_.begin() + 1, urgent_.begin() + static_cast<std::ptrdiff_t>(urgentCount_), urgent_.begin());
    --urgentCount_;
    return true;
}

void TtyTransport::sendUrgent() noexcept {
    Message message;
    while (takeUrgent(message)) {
        // A terminal takes these few bytes at once. If it does not, nobody reads it, and waiting is not allowed here.
        std::size_t sent = 0;
        for (int attempt = 0; attempt < 4 && sent < message.size; ++attempt) {
            const auto part = ::write(terminal_, message.bytes.data() + sent, message.size - sent);
            if (part > 0) sent += static_cast<std::size_t>(part);
        }
    }
}

void TtyTransport::writeUrgent(std::span<const std::uint8_t> bytes) noexcept {
    if (!bytes.empty() && bytes.size() <= kMaxUrgent) {
        const std::scoped_lock queue(queue_);
        const auto waiting = std::span(urgent_).first(urgentCount_);
        const bool queued = std::ranges::any_of(waiting, [&](const Message& message) {
            return std::ranges::equal(std::span(message.bytes).first(message.size), bytes);
        });
        if (!queued && urgentCount_ < urgent_.size()) {
            auto& message = urgent_[urgentCount_++];
            std::ranges::copy(bytes, message.bytes.begin());
            message.size = bytes.size();
        }
    }
    // The thread that holds the line sends the queued messages before and after releasing it. The queue is checked
    // again after each release, so that no message stays behind.
    for (;;) {
        if (!line_.try_lock()) return;
        sendUrgent();
        line_.unlock();
        const std::scoped_lock queue(queue_);
        if (urgentCount_ == 0) return;
    }
}

}  // namespace tacto::sciencemode
