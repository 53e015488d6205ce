#include "drivers/system/KernelNodes.h"

#include <algorithm>

namespace tacto {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        found.push_back(at->path());
    }
    return found;
}

}  // namespace

std::vector<fs::path> kernelNodesOf(const std::string& socket) {
    std::vector<fs::path> nodes;
    const auto add = [&](const fs::path& folder) {
        for (const auto& entry : entriesOf(folder)) nodes.push_back("/dev" / entry.filename());
    };
    for (const auto& interface : entriesOf(fs::path("/sys/bus/usb/devices") / socket)) {
        if (!interface.filename().string().starts_with(socket + ":")) continue;
        add(interface / "tty");
        // For HID the path has the HID device in between: 1-1:1.0/0003:054C:0CE6.0001/hidraw/hidraw0.
        for (const auto& device : entriesOf(interface)) {
            std::error_code none;
            if (!fs::is_symlink(device, none)) add(device / "hidraw");
        }
    }
    std::ranges::sort(nodes);
    return nodes;
}

}  // namespace tacto
