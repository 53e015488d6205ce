// HidrawNode.h - the way of input reports into /dev/hidrawN: a FIFO in packet mode (O_DIRECT), so that poll() and
// read() are the kernel's and each read() gives one report. Writes and ioctls go to EmulatedHidDevice.
//
// Thread-safety: none; HidEmulation locks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace tacto::test {

class HidrawNode {
public:
    explicit HidrawNode(const std::filesystem::path& path);
    ~HidrawNode();
    HidrawNode(const HidrawNode&) = delete;
    HidrawNode& operator=(const HidrawNode&) = delete;

    /// False where no more reports fit (64): the kernel, too, keeps 64 and drops the rest.
    [[nodiscard]] bool put(std::span<const std::uint8_t> report) noexcept;
    /// Throws away what the program has not read.
    void drain() noexcept;

private:
    std::filesystem::path path_;
    int fifo_ = -1;
};

}  // namespace tacto::test
