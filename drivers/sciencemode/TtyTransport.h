// TtyTransport.h - a Transport over a terminal device: the kernel's serial port of a USB device, or a pseudo-terminal
// with an emulated device behind it.
//
// The terminal is raw and this program's alone while it is open: locked (flock), and closed to other programs than the
// superuser's (TIOCEXCL).
//
// Thread-safety: as Transport. An urgent message leaves on the caller's thread unless a write() is under way, which
// then sends it before it returns.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <string>

#include "core/devices/TransportPorts.h"

namespace tacto::sciencemode {

class TtyTransport final : public Transport {
public:
    /// Errors: NotFound for a path that is not there; Io for one that may not be opened, is not a terminal,
    /// or is held by another program, which the message names.
    [[nodiscard]] static Result<std::unique_ptr<Transport>> open(const std::string& path);
    ~TtyTransport() override;
    TtyTransport(const TtyTransport&) = delete;
    TtyTransport& operator=(const TtyTransport&) = delete;

    [[nodiscard]] Result<void> write(std::span<const std::uint8_t> bytes, Seconds timeout) override;
    [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) override;
    /// Always 0: the kernel counts nothing.
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
    std::mutex line_;   // held while bytes of one message go out
    std::mutex queue_;  // the rest; held for copies only. May be taken with line_ held
    std::array<Message, 8> urgent_{};
    std::size_t urgentCount_ = 0;
};

}  // namespace tacto::sciencemode
