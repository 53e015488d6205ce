#include "drivers/system/Permission.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

#include "core/base/ProgramStart.h"

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

std::string rulesCommand() {
    constexpr const char* kInstalled = "tactoscope-install-rules";
    std::error_code error;
    return std::filesystem::exists(programBeside(kInstalled), error) ? kInstalled : "./dev install-rules";
}

std::string permissionAdvice(std::string_view device, Login login, const std::string& command) {
    const auto chosen = device.empty() ? std::string() : fmt::format(" --device {}", device);
    if (login == Login::Seat) {
        return fmt::format("run \"{}{}\" once, then plug the device in again.", command, chosen);
    }
    return fmt::format(
        "{}: run \"{}{} --group plugdev\" once, add yourself to that group with "
        "\"sudo usermod -aG plugdev $USER\", log in again, then plug the device in again.",
        login == Login::Ssh
            ? "this login is over ssh and has no seat, so a rule for the person at the computer does not "
              "help"
            : "this login shows no seat, so a rule for the person at the computer may not help",
        command, chosen);
}

}  // namespace tacto
