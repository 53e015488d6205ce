// Permission.h - what lets this user open a device that the system keeps from them: the sentence that every driver
// gives, and the command in it.
//
// The shipped udev rules give devices to the user at the computer (uaccess). That does nothing for a login over
// ssh, which has no seat; a group does.
//
// Thread-safety: pure but for reading the environment.
#pragma once

#include <string>
#include <string_view>

namespace tacto {

enum class Login {
    Seat,    ///< at the computer itself
    Ssh,     ///< logged in from another computer
    Unknown  ///< neither shows: a service, a container
};
/// Found by XDG_SEAT, the display's variables and SSH_CONNECTION.
[[nodiscard]] Login thisLogin();

/// "run \"./dev install-rules\" once, then plug the device in again." `device` is "1234:5678" for one that may not be
/// in the shipped rules, else empty.
[[nodiscard]] std::string permissionAdvice(std::string_view device = {}, Login login = thisLogin());

}  // namespace tacto
