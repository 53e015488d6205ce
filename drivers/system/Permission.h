// Permission.h - the advice for a device that the system does not let this user open: a sentence with a command, used
// by every driver.
//
// The shipped udev rules give devices to the user at the computer (uaccess). They do not help a user who is logged in
// over ssh and has no seat; membership in a group does.
//
// Thread-safety: any thread; reads the environment.
#pragma once

#include <string>
#include <string_view>

namespace tacto {

enum class Login {
    Seat,    ///< at the computer itself
    Ssh,     ///< logged in from another computer
    Unknown  ///< cannot be told: a service, a container
};
/// Looks at XDG_SEAT, the display's variables and SSH_CONNECTION.
[[nodiscard]] Login thisLogin();

/// Returns what installs the udev rules: "tactoscope-install-rules" if that lies beside this program, as in a package,
/// else "./dev install-rules".
[[nodiscard]] std::string rulesCommand();

/// Returns "run \"./dev install-rules\" once, then plug the device in again." `device` is "1234:5678" if the shipped
/// rules may not name the device, else empty.
[[nodiscard]] std::string permissionAdvice(std::string_view device = {}, Login login = thisLogin(),
                                           const std::string& command = rulesCommand());

}  // namespace tacto
