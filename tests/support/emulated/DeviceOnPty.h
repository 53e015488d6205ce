// DeviceOnPty.h - an emulated device behind a pseudo-terminal, for programs in other processes that open a terminal:
// this project's programs or others.
//
// Thread-safety: any thread.
#pragma once

#include <string>

#include "core/base/Result.h"
#include "tests/support/emulated/DeviceFeed.h"

namespace tacto::test {

/// A pseudo-terminal that clients can open and close.
class PseudoTerminal {
public:
    /// Errors: Io if the system provides none.
    [[nodiscard]] static Result<std::unique_ptr<PseudoTerminal>> open();
    ~PseudoTerminal();
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;

    /// Returns the path to open, such as "/dev/pts/3".
    [[nodiscard]] const std::string& path() const noexcept { return path_; }
    /// Starts a thread that passes on what the client writes.
    void listen(std::function<void(std::span<const std::uint8_t>)> receive);
    /// Stops the thread of listen().
    void stop();
    /// Waits for a client that does not read, as on USB, where the host fetches the data. Bytes not fetched within a
    /// second are lost.
    void send(std::span<const std::uint8_t> bytes) const noexcept;

private:
    PseudoTerminal() = default;

    // Constant once open() has returned:
    int master_ = -1;
    int slave_ = -1;  // held open so that clients can come and go
    int wake_ = -1;
    std::string path_;
    std::thread listener_;
};

template <class Device>
class DeviceOnPty {
public:
    /// `clock` must outlive this object and be steady. The other arguments are those of DeviceFeed.
    DeviceOnPty(std::unique_ptr<PseudoTerminal> terminal, const Clock& clock,
                typename DeviceFeed<Device>::PowerUp powerUp, Instant rest = Instant(0))
        : terminal_(std::move(terminal)),
          feed_(
              clock, [this](auto bytes) { terminal_->send(bytes); }, std::move(powerUp), rest) {
        terminal_->listen([this](auto bytes) { feed_.receive(bytes); });
    }
    ~DeviceOnPty() { terminal_->stop(); }

    [[nodiscard]] const std::string& path() const noexcept { return terminal_->path(); }
    /// Calls `look(device, now)` while no other thread can use the device.
    template <class Look>
    auto inspect(Look&& look) {
        return feed_.inspect(std::forward<Look>(look));
    }

private:
    const std::unique_ptr<PseudoTerminal> terminal_;
    DeviceFeed<Device> feed_;
};

}  // namespace tacto::test
