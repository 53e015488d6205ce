// EmulatedScopeServer.h - an emulated oscilloscope behind a TCP port on loopback, as instruments have one (5555), with
// the ways in which they fail.
//
// Thread-safety: any thread. A thread of its own serves; one conversation at a time.
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

/// What happens when the next block of samples is asked for.
enum class ScopeFault {
    None,
    HangUp,     ///< the connection ends in the middle of the block
    Silence,    ///< half of the block, then nothing ever
    Garbage,    ///< bytes that are no block at all
    LongBlock,  ///< the header promises more than is sent
    Endless,    ///< announces and sends a whole megabyte where a record was asked for
    Trickle,    ///< a block in pieces of a kilobyte, with a pause after each
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
    /// Answers nothing any longer, whatever is asked.
    void fallSilent() noexcept { silent_ = true; }
    /// The plug is pulled: the conversation ends and no other begins.
    void unplug() noexcept;

    /// Whether it waits for a trigger, at the latest after `timeout`.
    [[nodiscard]] bool waits(Seconds timeout);
    /// Whether `records` were read out, at the latest after `timeout`.
    [[nodiscard]] bool hasReadOut(std::uint64_t records, Seconds timeout);
    [[nodiscard]] std::uint64_t readOut();
    /// Every command so far, oldest first.
    [[nodiscard]] std::vector<std::string> heard();

private:
    EmulatedScopeServer(std::unique_ptr<EmulatedRigol> scope, int listener, std::uint16_t port, int wake);
    void serve() noexcept;
    /// False at the end of the conversation.
    [[nodiscard]] bool answer(int socket, std::string_view command);
    [[nodiscard]] bool send(int socket, std::string_view bytes) noexcept;

    const int listener_;
    const std::uint16_t port_;
    const int wake_;  // eventfd
    std::atomic<bool> ending_{false};
    std::atomic<bool> silent_{false};
    std::atomic<ScopeFault> fault_{ScopeFault::None};
    std::mutex mutex_;
    std::condition_variable changed_;
    const std::unique_ptr<EmulatedRigol> scope_;  // guarded by mutex_
    std::vector<std::string> heard_;              // guarded by mutex_
    std::thread thread_;                          // Last: starts when all else is ready
};

}  // namespace tacto::sigrok_driver
