#include "tests/support/usb_emulation/UsbNode.h"

#include <array>
#include <pty.h>
#include <stdexcept>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

namespace tacto::test {

UsbNode::UsbNode(const std::filesystem::path& path, unsigned mode) : path_(path) {
    std::array<char, 64> name{};
    termios raw{};
    cfmakeraw(&raw);
    if (openpty(&master_, &slave_, name.data(), &raw, nullptr) != 0) {
        throw std::runtime_error("no pseudo-terminal for an emulated USB device");
    }
    setReapable(false);
    setMode(mode);
    std::filesystem::create_directories(path_.parent_path());
    std::filesystem::remove(path_);
    std::filesystem::create_symlink(name.data(), path_);
}

UsbNode::~UsbNode() {
    close(master_);
    close(slave_);
    std::error_code gone;
    std::filesystem::remove(path_, gone);
}

void UsbNode::setReapable(bool reapable) noexcept { ioctl(slave_, TCXONC, reapable ? TCOON : TCOOFF); }
void UsbNode::setMode(unsigned mode) noexcept { fchmod(slave_, static_cast<mode_t>(mode)); }

}  // namespace tacto::test
