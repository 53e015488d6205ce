#include "drivers/sigrok/transport/TcpRelay.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "core/base/LocaleFreeText.h"
#include "core/base/Loopback.h"

namespace tacto::sigrok_driver {

namespace {

using SteadyTime = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kBetweenQuestions(50);

void setOption(int socket, int level, int option, int value) {
    ::setsockopt(socket, level, option, &value, sizeof value);
}

/// Closes the socket so that the other side's read fails instead of returning an empty answer.
void reset(int socket) noexcept {
    const linger now{1, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    ::close(socket);
}

/// Connects within `timeout`. Returns the socket, or an errno as a negative number.
int connectWithin(const addrinfo& address, Seconds timeout) {
    const int made = ::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, IPPROTO_TCP);
    if (made < 0) return -errno;
    int error = ::connect(made, address.ai_addr, address.ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
        pollfd waiting{made, POLLOUT, 0};
        const int ready = ::poll(&waiting, 1, static_cast<int>(timeout.count() * 1e3));
        socklen_t size = sizeof error;
        if (ready == 0) {
            error = ETIMEDOUT;
        } else if (::getsockopt(made, SOL_SOCKET, SO_ERROR, &error, &size) != 0) {
            error = errno;
        }
    }
    if (error != 0) {
        ::close(made);
        return -error;
    }
    setOption(made, IPPROTO_TCP, TCP_NODELAY, 1);
    return made;
}

Result<int> connectTo(const std::string& host, const std::string& port, Seconds timeout) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (const int code = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); code != 0) {
        return fail(ErrorCode::NotFound, "no instrument at {}:{}: {}", host, port, ::gai_strerror(code));
    }
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, ::freeaddrinfo);
    int last = -EADDRNOTAVAIL;
    for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
        last = connectWithin(*one, timeout);
        if (last >= 0) return last;
    }
    if (last == -ETIMEDOUT) {
        return fail(ErrorCode::Timeout, "the instrument at {}:{} has not answered within {:.3g} s", host, port,
                    timeout.count());
    }
    return fail(ErrorCode::NotFound, "no instrument at {}:{}: {}", host, port, std::strerror(-last));
}

/// True if the other end of an accepted connection belongs to this process. Both ends of a loopback connection are on
/// this computer, so a socket of this process that is bound to the other end's address is the other end.
bool isOurOwn(int accepted) {
    sockaddr_in there{};
    sockaddr_in here{};
    socklen_t size = sizeof there;
    // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): how the system calls take every kind of address
    if (::getpeername(accepted, reinterpret_cast<sockaddr*>(&there), &size) != 0) return false;
    size = sizeof here;
    if (::getsockname(accepted, reinterpret_cast<sockaddr*>(&here), &size) != 0) return false;
    const auto isAt = [](const sockaddr_in& a, const sockaddr_in& b) {
        return a.sin_family == AF_INET && b.sin_family == AF_INET && a.sin_port == b.sin_port &&
               a.sin_addr.s_addr == b.sin_addr.s_addr;
    };
    std::error_code error;
    for (std::filesystem::directory_iterator at("/proc/self/fd", error), end; !error && at != end;
         at.increment(error)) {
        const int own = parseWhole<int>(at->path().filename().string()).value_or(-1);
        sockaddr_in bound{};
        sockaddr_in connected{};
        size = sizeof bound;
        if (::getsockname(own, reinterpret_cast<sockaddr*>(&bound), &size) != 0 || !isAt(bound, there)) continue;
        size = sizeof connected;
        if (::getpeername(own, reinterpret_cast<sockaddr*>(&connected), &size) == 0 && isAt(connected, here))
            return true;
    }
    // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
    return false;
}

}  // namespace

Result<std::unique_ptr<TcpRelay>> TcpRelay::start(const std::string& host, const std::string& port, Seconds timeout) {
    const auto upstream = connectTo(host, port, timeout);
    if (!upstream) return failure(upstream);
    const auto refused = [&](const std::string& why) {
        ::close(*upstream);
        return fail(ErrorCode::Io, "no loopback connection for the instrument at {}:{}: {}", host, port, why);
    };
    const auto listener = listenOnLoopback(1);
    if (!listener) return refused(listener.error().message);
    const int wake = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (wake < 0) {
        const int error = errno;
        ::close(listener->descriptor);
        return refused(std::strerror(error));
    }
    std::unique_ptr<TcpRelay> relay(
        new TcpRelay(fmt::format("{}:{}", host, port), *upstream, listener->descriptor, listener->port, wake));
    relay->host_ = host;
    relay->service_ = port;
    relay->timeout_ = timeout;
    relay->thread_ = std::thread([&self = *relay] { self.carry(); });
    return relay;
}

TcpRelay::TcpRelay(std::string place, int upstream, int listener, std::uint16_t port, int wake)
    : place_(std::move(place)),
      upstream_(upstream),
      listener_(listener),
      port_(port),
      wake_(wake),
      heard_(SteadyTime::now().time_since_epoch().count()) {}

TcpRelay::~TcpRelay() {
    cut();
    if (thread_.joinable()) thread_.join();
    ::close(wake_);
}

Seconds TcpRelay::silence() const noexcept {
    return SteadyTime::now().time_since_epoch() - SteadyTime::duration(heard_.load());
}

std::optional<Error> TcpRelay::fault() const {
    const std::scoped_lock lock(mutex_);
    return fault_;
}

void TcpRelay::cut() noexcept {
    cut_ = true;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);  // fails only if wake_ is already set
}

void TcpRelay::setFault(ErrorCode code, std::string_view why) {
    const std::scoped_lock lock(mutex_);
    if (!fault_) fault_ = Error{code, fmt::format("the instrument at {} {}", place_, why)};
}

void TcpRelay::hangUp() noexcept {
    if (upstream_ >= 0) ::close(upstream_);
    if (downstream_ >= 0) reset(downstream_);
    upstream_ = downstream_ = -1;
}

bool TcpRelay::reconnect() {
    if (upstream_ >= 0) return true;
    const auto made = connectTo(host_, service_, timeout_);
    if (!made) {
        const std::scoped_lock lock(mutex_);
        if (!fault_) fault_ = made.error();
        return false;
    }
    upstream_ = *made;
    heard_ = SteadyTime::now().time_since_epoch().count();
    return true;
}

bool TcpRelay::pace(std::string_view request) noexcept {
    if (!request.starts_with(":TRIG:STAT?")) return true;
    const auto due = asked_ + kBetweenQuestions;
    while (SteadyTime::now() < due && !cut_) {
        pollfd woken{wake_, POLLIN, 0};
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(due - SteadyTime::now());
        ::poll(&woken, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    }
    asked_ = SteadyTime::now();
    return !cut_;
}

bool TcpRelay::pass(int from, int to) noexcept {
    std::array<char, 65536> buffer{};
    const auto read = ::recv(from, buffer.data(), buffer.size(), 0);
    if (read < 0) return errno == EAGAIN || errno == EINTR;
    if (read == 0) return false;
    if (from == downstream_) {
        setOption(from, IPPROTO_TCP, TCP_QUICKACK, 1);
        if (!pace({buffer.data(), static_cast<std::size_t>(read)})) return false;
    }
    for (decltype(read + 0) sent = 0; sent < read;) {
        const auto part = ::send(to, buffer.data() + sent, static_cast<std::size_t>(read - sent), MSG_NOSIGNAL);
        if (part >= 0) {
            sent += part;
        } else if (errno == EAGAIN) {
            pollfd room[2] = {{to, POLLOUT, 0}, {wake_, POLLIN, 0}};
            ::poll(room, 2, -1);
            if (cut_) return false;
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

void TcpRelay::carry() noexcept {
    while (!cut_) {
        pollfd waiting[4] = {
            {wake_, POLLIN, 0}, {listener_, POLLIN, 0}, {upstream_, POLLIN, 0}, {downstream_, POLLIN, 0}};
        if (downstream_ >= 0) waiting[1].fd = -1;  // only one conversation at a time, as instruments allow
        ::poll(waiting, 4, -1);
        if (cut_) break;
        if (waiting[2].revents != 0) {
            heard_ = SteadyTime::now().time_since_epoch().count();
            if (downstream_ < 0 || !pass(upstream_, downstream_)) {
                // Between two conversations an instrument may hang up; the next conversation connects again.
                if (downstream_ >= 0) setFault(ErrorCode::Device, "has hung up");
                hangUp();
            }
        } else if (waiting[3].revents != 0 && !pass(downstream_, upstream_)) {
            hangUp();  // libsigrok has ended this conversation
        } else if (waiting[1].revents != 0) {
            downstream_ = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
            if (downstream_ < 0) continue;
            if (!isOurOwn(downstream_)) {  // any program on this computer can connect, but only ours is served
                reset(std::exchange(downstream_, -1));
                continue;
            }
            setOption(downstream_, IPPROTO_TCP, TCP_NODELAY, 1);
            setOption(downstream_, IPPROTO_TCP, TCP_QUICKACK, 1);
            if (!reconnect()) hangUp();
        }
    }
    hangUp();
    // Also ends a connection that has not been accepted yet.
    ::close(listener_);
}

}  // namespace tacto::sigrok_driver
