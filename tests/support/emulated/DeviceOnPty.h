// DeviceOnPty.h - an emulated device behind a pseudo-terminal, for programs that open a terminal: this project's own,
// in another process, or another program's.
//
// Thread-safety: all members any thread.
#pragma once

#include <string>

#include "core/base/Result.h"
#include "tests/support/emulated/DeviceFeed.h"

namespace tacto::test {

/// A pseudo-terminal whose client may come and go.
class PseudoTerminal {
public:
    /// Errors: Io when the system gives none.
    [[nodiscard]] static Result<std::unique_ptr<PseudoTerminal>> open();
    ~PseudoTerminal();
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;

    /// What to open, "/dev/pts/3".
    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// From now on a thread hands on what the client writes.
    void listen(std::function<void(std::span<const std::uint8_t>)> receive);
    /// Ends that.
    void stop();
    /// As on USB, where the host fetches: waits for a client that does not read. What is not fetched within a second is
    /// lost.
    void send(std::span<const std::uint8_t> bytes) const noexcept;

private:
    PseudoTerminal() = default;

    // Constant once open() has returned:
    int master_ = -1;
    int slave_ = -1;  // held open
    int wake_ = -1;
    std::string path_;
    std::thread listener_;
};

template <class Device>
class DeviceOnPty {
public:
    /// `clock` outlives it and is steady. The others as of DeviceFeed.
    DeviceOnPty(std::unique_ptr<PseudoTerminal> terminal, const Clock& clock,
                typename DeviceFeed<Device>::PowerUp powerUp, Instant rest = Instant(0))
        : terminal_(std::move(terminal)),
          feed_(
              clock, [this](auto bytes) { terminal_->send(bytes); }, std::move(powerUp), rest) {
        terminal_->listen([this](auto bytes) { feed_.receive(bytes); });
    }
    ~DeviceOnPty() { terminal_->stop(); }

    [[nodiscard]] const std::string& path() const noexcept { return terminal_->path(); }
    /// Calls `look(device, now)` while nothing else does.
    template <class Look>
    auto inspect(Look&& look) {
        return feed_.inspect(std::forward<Look>(look));
    }

private:
    const std::unique_ptr<PseudoTerminal> terminal_;
    DeviceFeed<Device> feed_;
};

}  // namespace tacto::test
