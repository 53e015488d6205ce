// TtyTransport.h - a Transport over a terminal device: the kernel's serial port of a USB device, or a pseudo-terminal
// with an emulated device behind it.
//
// While open, the terminal is in raw mode and belongs to this program alone: locked (flock), and closed to all other
// programs except the superuser's (TIOCEXCL).
//
// Thread-safety: as Transport. An urgent message is sent on the caller's thread; during a write(), that write() sends
// it before it returns.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <string>

#include "core/devices/TransportPorts.h"

namespace tacto::sciencemode {

class TtyTransport final : public Transport {
public:
    /// Errors: NotFound for a missing path; Io if the path may not be opened, is no terminal, or is held by another
    /// program, which the message names.
    [[nodiscard]] static Result<std::unique_ptr<Transport>> open(const std::string& path);
    ~TtyTransport() override;
    TtyTransport(const TtyTransport&) = delete;
    TtyTransport& operator=(const TtyTransport&) = delete;

    [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes, Seconds timeout) override;
    [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override;
    /// Always 0: the kernel does not count lost bytes.
    [[nodiscard]] std::uint64_t dropped() const noexcept override { return 0; }
    void writeUrgent(std::span<const std::uint8_t> bytes) noexcept override;

private:
    struct Message {
        std::array<std::uint8_t, kMaxUrgent> bytes{};
        std::size_t size = 0;
    };
    TtyTransport(int terminal, std::string path) : terminal_(terminal), path_(std::move(path)) {}
    [[nodiscard]] bool takeUrgent(Message& into) noexcept;
    void sendUrgent() noexcept;  // needs line_ held

    const int terminal_;
    const std::string path_;
    std::mutex line_;   // held while the bytes of one message are sent
    std::mutex queue_;  // guards the rest; held only for copies. May be locked while line_ is held
    std::array<Message, 8> urgent_{};
    std::size_t urgentCount_ = 0;
};

}  // namespace tacto::sciencemode
