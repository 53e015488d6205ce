// MarkerRecorder.h - a test's stand-in for an EEG recorder: connects to a port of this computer and stores the lines
// that arrive.
//
// Thread-safety: the test's own thread; any thread may call lines().
#pragma once

#include <arpa/inet.h>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/base/Loopback.h"

namespace tacto::test {

/// Reserves a port of 127.0.0.1 that no program uses; the socket keeps the port until it is closed.
class HeldPort {
public:
    HeldPort() = default;
    ~HeldPort() { letGo(); }
    HeldPort(const HeldPort&) = delete;
    HeldPort& operator=(const HeldPort&) = delete;
    [[nodiscard]] std::uint16_t port() const { return held_.port; }
    void letGo() {
        if (const int had = std::exchange(held_.descriptor, -1); had >= 0) close(had);
    }

private:
    LoopbackSocket held_ = listenOnLoopback(1).value();
};

[[nodiscard]] inline std::uint16_t freePort() { return HeldPort().port(); }

class MarkerRecorder {
public:
    enum class Reads { Everything, Nothing };
    /// Tries to connect for 20 s.
    explicit MarkerRecorder(std::uint16_t port, Reads reads = Reads::Everything) : reads_(reads) {
        reader_ = std::thread([this, port] { work(port); });
    }
    ~MarkerRecorder() {
        hangUp();
        reader_.join();
    }
    MarkerRecorder(const MarkerRecorder&) = delete;
    MarkerRecorder& operator=(const MarkerRecorder&) = delete;

    [[nodiscard]] bool connected() const { return socket_ >= 0; }
    [[nodiscard]] bool ended() const { return ended_; }
    [[nodiscard]] std::vector<std::string> lines() const {
        const std::scoped_lock lock(mutex_);
        return lines_;
    }
    void say(const std::string& text) const {
        static_cast<void>(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
    }
    void hangUp() {
        leave_ = true;
        if (const int open = socket_; open >= 0) shutdown(open, SHUT_RDWR);
    }

private:
    void work(std::uint16_t port) {
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        at.sin_port = htons(port);
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        int open = -1;
        while (!leave_ && std::chrono::steady_clock::now() < until) {
            open = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
            const int small = 4096;
            if (reads_ == Reads::Nothing) setsockopt(open, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
            if (::connect(open, reinterpret_cast<sockaddr*>(&at), sizeof at) == 0) break;
            close(std::exchange(open, -1));
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        socket_ = open;
        std::string rest;
        char some[4096];
        while (open >= 0 && !leave_) {
            if (reads_ == Reads::Nothing) {
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
                continue;
            }
            const auto got = recv(open, some, sizeof some, 0);
            if (got <= 0) break;
            rest.append(some, std::size_t(got));
            for (auto end = rest.find('\n'); end != std::string::npos; end = rest.find('\n')) {
                const std::scoped_lock lock(mutex_);
                lines_.push_back(rest.substr(0, end));
                rest.erase(0, end + 1);
            }
        }
        ended_ = true;
        if (open >= 0) close(open);
    }

    const Reads reads_;
    std::atomic<int> socket_{-1};
    std::atomic<bool> leave_{false}, ended_{false};
    mutable std::mutex mutex_;
    std::vector<std::string> lines_;
    std::thread reader_;
};

}  // namespace tacto::test
