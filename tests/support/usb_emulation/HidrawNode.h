// HidrawNode.h - delivers input reports to /dev/hidrawN: a FIFO in packet mode (O_DIRECT), so that the kernel itself
// does poll() and read(), and each read() gives one report. Writes and ioctls go to EmulatedHidDevice.
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

    /// Returns false if no more reports fit: like the kernel, keeps 64 reports and drops the rest.
    [[nodiscard]] bool put(std::span<const std::uint8_t> report) noexcept;
    /// Discards what the program has not read.
    void drain() noexcept;

private:
    std::filesystem::path path_;
    int fifo_ = -1;
};

}  // namespace tacto::test
