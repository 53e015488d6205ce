// TcpRelay.h - stands between libsigrok and an instrument on the network.
//
// libsigrok connects without a time limit and reads with a recv() that waits forever, so an instrument that is
// switched off, or falls silent in mid-answer, would hold its thread until the program ends. The relay makes the
// connection itself, within a time, and libsigrok talks to the relay on loopback: what both say passes unchanged; cut()
// ends a read that nothing else would end. It also acknowledges each command at once, without which every command
// waits 40 ms for the system's delayed acknowledgement. And it lets the question whether the instrument has triggered
// pass at most 20 times a second: libsigrok 0.5.2 asks as fast as it is answered, and loses 2 kB of memory each time.
//
// Thread-safety: any thread. A thread of its own carries the bytes.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto::sigrok_driver {

class TcpRelay {
public:
    /// Connects to `host`:`port`. Errors: NotFound for a host without an address or one that refuses; Timeout when it
    /// has not answered within `timeout`; Io.
    [[nodiscard]] static Result<std::unique_ptr<TcpRelay>> start(const std::string& host, const std::string& port,
                                                                 Seconds timeout = Seconds(3));
    ~TcpRelay();
    TcpRelay(const TcpRelay&) = delete;
    TcpRelay& operator=(const TcpRelay&) = delete;

    /// The port on 127.0.0.1 to which libsigrok connects. A connection from another process is closed at once, and
    /// nothing of it reaches the instrument.
    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    /// How long the instrument has said nothing.
    [[nodiscard]] Seconds silence() const noexcept;
    /// Why the connection is over, once it is.
    [[nodiscard]] std::optional<Error> fault() const;
    /// Ends the connection for both; a read that waits ends with an error. Irreversible.
    void cut() noexcept;

private:
    TcpRelay(std::string place, int upstream, int listener, std::uint16_t port, int wake);
    void carry() noexcept;
    void setFault(ErrorCode code, std::string_view why);
    [[nodiscard]] bool reconnect();
    /// Moves what is there from one to the other; false at the end of the connection.
    [[nodiscard]] bool pass(int from, int to) noexcept;
    void hangUp() noexcept;
    /// Waits before a question after the trigger that comes too soon after the one before. False when cut.
    [[nodiscard]] bool pace(std::string_view request) noexcept;

    const std::string place_;  // "192.0.2.1:5555"
    std::string host_, service_;
    Seconds timeout_{3};
    int upstream_;                                   // the instrument; -1 while not connected. The thread's.
    int downstream_ = -1;                            // libsigrok. The thread's.
    std::chrono::steady_clock::time_point asked_{};  // when it was asked, after the trigger; only its thread uses it
    const int listener_;                             // closed by the thread when it ends
    const std::uint16_t port_;
    const int wake_;  // eventfd
    std::atomic<bool> cut_{false};
    std::atomic<std::chrono::steady_clock::rep> heard_;
    mutable std::mutex mutex_;
    std::optional<Error> fault_;  // guarded by mutex_
    std::thread thread_;          // Last: starts when all else is ready
};

}  // namespace tacto::sigrok_driver
