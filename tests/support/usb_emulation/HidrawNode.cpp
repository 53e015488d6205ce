#include "tests/support/usb_emulation/HidrawNode.h"

#include <array>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

namespace tacto::test {

HidrawNode::HidrawNode(const std::filesystem::path& path) : path_(path) {
    std::filesystem::create_directories(path_.parent_path());
    std::filesystem::remove(path_);
    if (mkfifo(path_.c_str(), 0666) != 0) throw std::runtime_error("no FIFO for an emulated HID device");
    fifo_ = open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    constexpr int kReports = 64;  // HIDRAW_BUFFER_SIZE of the kernel
    if (fifo_ < 0 || fcntl(fifo_, F_SETFL, O_DIRECT | O_NONBLOCK) != 0 ||
        fcntl(fifo_, F_SETPIPE_SZ, kReports * 4096) < 0) {
        throw std::runtime_error("no FIFO in packet mode for an emulated HID device");
    }
}

HidrawNode::~HidrawNode() {
    close(fifo_);
    std::error_code gone;
    std::filesystem::remove(path_, gone);
}

bool HidrawNode::put(std::span<const std::uint8_t> report) noexcept {
    return write(fifo_, report.data(), report.size()) == static_cast<ssize_t>(report.size());
}

void HidrawNode::drain() noexcept {
    std::array<std::uint8_t, 4096> report{};
    while (read(fifo_, report.data(), report.size()) > 0) {
    }
}

}  // namespace tacto::test
