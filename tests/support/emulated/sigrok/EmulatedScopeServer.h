// EmulatedScopeServer.h - an emulated oscilloscope behind a TCP port on loopback, like an instrument's port 5555, with
// typical failures.
//
// Thread-safety: any thread. Its own thread serves one conversation at a time.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/Result.h"
#include "tests/support/emulated/sigrok/EmulatedRigol.h"

namespace tacto::sigrok_driver {

/// What happens at the next request for a block of samples.
enum class ScopeFault {
    None,
    HangUp,     ///< the connection ends in the middle of the block
    Silence,    ///< half of the block, then silence
    Garbage,    ///< bytes that are no block
    LongBlock,  ///< the header promises more than is sent
    Endless,    ///< a whole megabyte instead of a record
    Trickle,    ///< a block in pieces of a kilobyte with pauses
};

class EmulatedScopeServer {
public:
    /// Errors: Io.
    [[nodiscard]] static Result<std::unique_ptr<EmulatedScopeServer>> start(std::unique_ptr<EmulatedRigol> scope);
    ~EmulatedScopeServer();
    EmulatedScopeServer(const EmulatedScopeServer&) = delete;
    EmulatedScopeServer& operator=(const EmulatedScopeServer&) = delete;

    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    void setFault(ScopeFault fault) noexcept { fault_ = fault; }
    /// Answers no request from now on.
    void fallSilent() noexcept { silent_ = true; }
    /// Acts as if unplugged: the conversation ends and no other begins.
    void unplug() noexcept;

    /// Waits at most `timeout`; true if the instrument waits for a trigger.
    [[nodiscard]] bool waits(Seconds timeout);
    /// Waits at most `timeout`; true if `records` records were read out.
    [[nodiscard]] bool hasReadOut(std::uint64_t records, Seconds timeout);
    [[nodiscard]] std::uint64_t readOut();
    /// Returns every command so far, oldest first.
    [[nodiscard]] std::vector<std::string> heard();

private:
    EmulatedScopeServer(std::unique_ptr<EmulatedRigol> scope, int listener, std::uint16_t port, int wake);
    void serve() noexcept;
    /// Returns false at the end of the conversation.
    [[nodiscard]] bool answer(int socket, std::string_view command);
    [[nodiscard]] bool send(int socket, std::string_view bytes) noexcept;

    const int listener_;
    const std::uint16_t port_;
    const int wake_;  // eventfd that wakes the thread
    std::atomic<bool> ending_{false};
    std::atomic<bool> silent_{false};
    std::atomic<ScopeFault> fault_{ScopeFault::None};
    std::mutex mutex_;
    std::condition_variable changed_;
    const std::unique_ptr<EmulatedRigol> scope_;  // guarded by mutex_
    std::vector<std::string> heard_;              // guarded by mutex_
    std::thread thread_;                          // declared last: starts when everything else is ready
};

}  // namespace tacto::sigrok_driver
