#include "tests/support/emulated/sigrok/EmulatedScopeServer.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/base/Loopback.h"

namespace tacto::sigrok_driver {

Result<std::unique_ptr<EmulatedScopeServer>> EmulatedScopeServer::start(std::unique_ptr<EmulatedRigol> scope) {
    const auto listener = listenOnLoopback(4);
    if (!listener) return failure(listener);
    const int wake = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (wake < 0) {
        const int error = errno;
        ::close(listener->descriptor);
        return fail(ErrorCode::Io, "nothing wakes an emulated oscilloscope: {}", std::strerror(error));
    }
    std::unique_ptr<EmulatedScopeServer> server(
        new EmulatedScopeServer(std::move(scope), listener->descriptor, listener->port, wake));
    server->thread_ = std::thread([&self = *server] { self.serve(); });
    return server;
}

EmulatedScopeServer::EmulatedScopeServer(std::unique_ptr<EmulatedRigol> scope, int listener, std::uint16_t port,
                                         int wake)
    : listener_(listener), port_(port), wake_(wake), scope_(std::move(scope)) {}

EmulatedScopeServer::~EmulatedScopeServer() {
    unplug();
    if (thread_.joinable()) thread_.join();
    ::close(wake_);
}

void EmulatedScopeServer::unplug() noexcept {
    ending_ = true;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);  // fails only if wake_ is already set
}

bool EmulatedScopeServer::waits(Seconds timeout) {
    const auto until = std::chrono::steady_clock::now() + timeout;
    std::unique_lock lock(mutex_);
    while (!scope_->waiting()) {
        if (changed_.wait_until(lock, until) == std::cv_status::timeout) return scope_->waiting();
    }
    return true;
}

bool EmulatedScopeServer::hasReadOut(std::uint64_t records, Seconds timeout) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, timeout, [&] { return scope_->readOut() >= records; });
}

std::uint64_t EmulatedScopeServer::readOut() {
    const std::scoped_lock lock(mutex_);
    return scope_->readOut();
}

std::vector<std::string> EmulatedScopeServer::heard() {
    const std::scoped_lock lock(mutex_);
    return heard_;
}

bool EmulatedScopeServer::send(int socket, std::string_view bytes) noexcept {
    while (!bytes.empty()) {
        const auto sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(sent));
            continue;
        }
        if (errno != EAGAIN && errno != EINTR) return false;
        std::array<pollfd, 2> room{{{socket, POLLOUT, 0}, {wake_, POLLIN, 0}}};
        ::poll(room.data(), room.size(), -1);
        if (ending_) return false;
    }
    return true;
}

bool EmulatedScopeServer::answer(int socket, std::string_view command) {
    std::string reply;
    bool waiting = false;
    {
        const std::scoped_lock lock(mutex_);
        heard_.emplace_back(command.substr(0, command.find('\r')));
        reply = scope_->take(command);
        waiting = reply == "WAIT\n";
        changed_.notify_all();
    }
    if (silent_) return true;
    if (waiting) {
        // An instrument also takes time to answer; without this wait the repeated questions would keep a core busy.
        std::array<pollfd, 1> woken{{{wake_, POLLIN, 0}}};
        ::poll(woken.data(), woken.size(), 2);
    }
    const ScopeFault fault = reply.starts_with('#') ? fault_.load() : ScopeFault::None;
    switch (fault) {
        case ScopeFault::None:
            break;
        case ScopeFault::HangUp:
            (void)send(socket, std::string_view(reply).substr(0, reply.size() / 2));
            return false;
        case ScopeFault::Silence:
            silent_ = true;
            reply.resize(reply.size() / 2);
            break;
        case ScopeFault::Garbage:
            reply = "\x01\x7f?%garbage\r\n";
            break;
        case ScopeFault::LongBlock:
            reply.replace(2, 9, "000999999");
            break;
        case ScopeFault::Endless:
        case ScopeFault::Trickle:
            reply = "#9001000000" + std::string(1'000'000, '\x7f') + "\n";
            break;
    }
    if (fault != ScopeFault::Trickle) return send(socket, reply);
    constexpr std::size_t kPiece = 1000;
    for (std::size_t at = 0; at < reply.size() && !ending_; at += kPiece) {
        if (!send(socket, std::string_view(reply).substr(at, kPiece))) return false;
        std::array<pollfd, 1> woken{{{wake_, POLLIN, 0}}};
        ::poll(woken.data(), woken.size(), 1);
    }
    return true;
}

void EmulatedScopeServer::serve() noexcept {
    int socket = -1;
    std::string line;
    while (!ending_) {
        std::array<pollfd, 3> ready{
            {{wake_, POLLIN, 0}, {socket < 0 ? listener_ : -1, POLLIN, 0}, {socket, POLLIN, 0}}};
        ::poll(ready.data(), ready.size(), -1);
        if (ready[1].revents != 0) {
            socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
            line.clear();
            const int yes = 1;
            if (socket >= 0) ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        }
        if (ready[2].revents == 0) continue;
        std::array<char, 4096> bytes{};
        const auto count = ::recv(socket, bytes.data(), bytes.size(), 0);
        bool goes = count > 0;
        for (std::ptrdiff_t i = 0; i < count && goes; ++i) {
            const char one = bytes[static_cast<std::size_t>(i)];
            if (one != '\n') {
                line.push_back(one);
                continue;
            }
            goes = answer(socket, line);
            line.clear();
        }
        if (!goes) {
            ::close(socket);
            socket = -1;
        }
    }
    if (socket >= 0) ::close(socket);
    ::close(listener_);
}

}  // namespace tacto::sigrok_driver
