#include "tests/support/usb_emulation/UsbTestbed.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <sys/prctl.h>
#include <umockdev.h>
#include <unistd.h>

namespace tacto::test {

UsbTestbed::UsbTestbed() {
    // umockdev_in_mock_environment() relies on a link count of /sys that some containers do not have.
    const char* preloaded = std::getenv("LD_PRELOAD");
    if (preloaded == nullptr || std::string_view(preloaded).find("libumockdev-preload") == std::string_view::npos) {
        throw std::runtime_error(
            "no umockdev in this process: start it through tests/support/usb_emulation/"
            "with-emulated-usb, as ctest does");
    }
    // umockdev sleeps 0 us after each system call that it answers; the usual timer slack makes this 50 us.
    prctl(PR_SET_TIMERSLACK, 1UL);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGHUP, SIG_IGN);  // unplugging hangs up the pseudo-terminal of a device
    testbed_ = umockdev_testbed_new();
    // UnprivilegedUser must have access too.
    std::filesystem::permissions(root(), std::filesystem::perms(0755));
}

UsbTestbed::~UsbTestbed() { g_object_unref(testbed_); }

std::filesystem::path UsbTestbed::root() const {
    gchar* text = umockdev_testbed_get_root_dir(testbed_);
    std::filesystem::path path = text;
    g_free(text);
    return path;
}

namespace {
constexpr uid_t kUnprivilegedUser = 65534;
}

UnprivilegedUser::UnprivilegedUser(const UsbTestbed& testbed) {
    if (geteuid() != 0) return;
    // The permissions that tests check do not concern umockdev's own sockets.
    for (const auto& entry : std::filesystem::recursive_directory_iterator(testbed.root() / "ioctl")) {
        std::filesystem::permissions(entry, std::filesystem::perms(0777));
    }
    if (setresuid(kUnprivilegedUser, kUnprivilegedUser, 0) != 0)
        throw std::runtime_error("setresuid to an unprivileged user was refused");
    changed_ = true;
}

UnprivilegedUser::~UnprivilegedUser() {
    if (changed_ && setresuid(0, 0, 0) != 0) std::abort();
}

}  // namespace tacto::test
