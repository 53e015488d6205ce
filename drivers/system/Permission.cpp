#include "drivers/system/Permission.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>

namespace tacto {

namespace {

bool isSet(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

}  // namespace

Login thisLogin() {
    if (isSet("SSH_CONNECTION")) return Login::Ssh;
    constexpr std::array kOfASeat{"XDG_SEAT", "WAYLAND_DISPLAY", "DISPLAY"};
    return std::ranges::any_of(kOfASeat, isSet) ? Login::Seat : Login::Unknown;
}

std::string permissionAdvice(std::string_view device, Login login) {
    const auto chosen = device.empty() ? std::string() : fmt::format(" --device {}", device);
    if (login == Login::Seat) {
        return fmt::format("run \"./dev install-rules{}\" once, then plug the device in again.", chosen);
    }
    return fmt::format(
        "{}: run \"./dev install-rules{} --group plugdev\" once, add yourself to that group with "
        "\"sudo usermod -aG plugdev $USER\", log in again, then plug the device in again.",
        login == Login::Ssh
            ? "this login is over ssh and has no seat, so a rule for the person at the computer does not "
              "help"
            : "this login shows no seat, so a rule for the person at the computer may not help",
        chosen);
}

}  // namespace tacto
