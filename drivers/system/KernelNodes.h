// KernelNodes.h - the files in /dev by which the kernel's own drivers offer a USB device to programs.
//
// Thread-safety: pure but for reading /sys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacto {

/// The terminals (/dev/ttyACM0) and HID nodes (/dev/hidraw0) of the device in a USB socket ("1-4.2"), by name.
[[nodiscard]] std::vector<std::filesystem::path> kernelNodesOf(const std::string& socket);

}  // namespace tacto
