// Transport.h - bytes to and from a device: a USB CDC data interface, a pseudo-terminal in tests. A protocol
// makes frames of them, a driver makes a device of frames.
//
// Thread-safety: write() and read() have one caller, the device's session thread. writeUrgent() any thread, at any
// moment, also while write() or read() waits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/Result.h"
#include "core/base/Units.h"

namespace tacto {

class Transport {
public:
    static constexpr std::size_t kMaxUrgent = 64;  ///< bytes of one writeUrgent()

    virtual ~Transport() = default;

    /// Sends all of `bytes` as one transfer, so that two writers never mix frames; returns when the device took them.
    /// Errors: Timeout (the rest was cancelled); Device (gone, stalled, took fewer bytes).
    [[nodiscard]] virtual Result<void> write(std::span<const std::uint8_t> bytes, Seconds timeout) = 0;

    /// What has arrived, oldest first, at least one byte; waits for it. A zero timeout looks and does not wait.
    /// What a reader leaves too long is dropped oldest first and counted by dropped().
    /// Errors: Timeout; Device (gone, or the transfer failed).
    [[nodiscard]] virtual Result<std::size_t> read(std::span<std::uint8_t> into, Seconds timeout) = 0;
    [[nodiscard]] virtual std::uint64_t dropped() const noexcept = 0;

    /// Queues `bytes` (at most kMaxUrgent) for sending at once, behind a transfer that is already under way and
    /// ahead of any later one. Returns without waiting; never throws, never allocates. For the stop.
    virtual void writeUrgent(std::span<const std::uint8_t> bytes) noexcept = 0;
};

}  // namespace tacto
