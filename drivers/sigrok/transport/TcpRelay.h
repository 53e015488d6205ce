// TcpRelay.h - relays the bytes between libsigrok and an instrument on the network.
//
// libsigrok connects without a time limit and reads with a recv() that waits forever, so an instrument that is switched
// off or stops in the middle of an answer would block its thread until the program ends. The relay therefore connects
// itself, within a time limit, and libsigrok talks to the relay on loopback: bytes pass unchanged in both directions,
// and cut() ends a read that nothing else would end. The relay also acknowledges each command at once; otherwise every
// command waits 40 ms for the system's delayed acknowledgement. It passes on the question "triggered?" at most 20 times
// a second: libsigrok 0.5.2 repeats it as fast as answers come, and leaks 2 kB of memory each time.
//
// Thread-safety: any thread. The relay's own thread carries the bytes.
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
    /// Connects to `host`:`port`. Errors: NotFound if the host has no address or refuses; Timeout if it has not
    /// answered within `timeout`; Io.
    [[nodiscard]] static Result<std::unique_ptr<TcpRelay>> start(const std::string& host, const std::string& port,
                                                                 Seconds timeout = Seconds(3));
    ~TcpRelay();
    TcpRelay(const TcpRelay&) = delete;
    TcpRelay& operator=(const TcpRelay&) = delete;

    /// The port on 127.0.0.1 to which libsigrok connects. A connection from another process is closed at once, and none
    /// of its bytes reach the instrument.
    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    /// Returns for how long the instrument has sent nothing.
    [[nodiscard]] Seconds silence() const noexcept;
    /// Returns why the connection ended, if it has ended.
    [[nodiscard]] std::optional<Error> fault() const;
    /// Ends the connection on both sides; a waiting read fails. Irreversible.
    void cut() noexcept;

private:
    TcpRelay(std::string place, int upstream, int listener, std::uint16_t port, int wake);
    void carry() noexcept;
    void setFault(ErrorCode code, std::string_view why);
    [[nodiscard]] bool reconnect();
    /// Moves the available bytes from one socket to the other; returns false at the end of the connection.
    [[nodiscard]] bool pass(int from, int to) noexcept;
    void hangUp() noexcept;
    /// Delays a question about the trigger if it comes too soon after the last one. Returns false after cut().
    [[nodiscard]] bool pace(std::string_view request) noexcept;

    const std::string place_;  // for messages, such as "192.0.2.1:5555"
    std::string host_, service_;
    Seconds timeout_{3};
    int upstream_;                                   // the instrument; -1 while not connected. Only thread_ uses it
    int downstream_ = -1;                            // libsigrok. Only thread_ uses it
    std::chrono::steady_clock::time_point asked_{};  // when libsigrok last asked about the trigger; for thread_ only
    const int listener_;                             // closed by the thread when it ends
    const std::uint16_t port_;
    const int wake_;  // eventfd that wakes the thread
    std::atomic<bool> cut_{false};
    std::atomic<std::chrono::steady_clock::rep> heard_;
    mutable std::mutex mutex_;
    std::optional<Error> fault_;  // guarded by mutex_
    std::thread thread_;          // declared last: starts when everything else is ready
};

}  // namespace tacto::sigrok_driver
