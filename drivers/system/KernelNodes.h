// KernelNodes.h - finds the files in /dev through which the kernel's own drivers offer a USB device to programs.
//
// Thread-safety: any thread; reads /sys.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacto {

/// Returns the terminals (/dev/ttyACM0) and HID nodes (/dev/hidraw0) of the device in a USB socket ("1-4.2"), by name.
[[nodiscard]] std::vector<std::filesystem::path> kernelNodesOf(const std::string& socket);

}  // namespace tacto
