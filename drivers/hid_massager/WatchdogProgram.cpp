// tactoscope-watchdog - sends a massager's stop report if the program that started it dies in any way (kill -9, abort,
// out of memory), or is silent while output is on. Started by drivers/hid_massager/WatchdogProcess; useless when
// started by hand.
//
// It has its own session and ignores a terminal's signals, so that Ctrl-C and Ctrl-Z reach only the program. It opens
// the device's node once, at the start, and keeps that device. All memory is taken before the first beat.
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/hid_massager/StopWay.h"
#include "drivers/hid_massager/WatchdogLine.h"

namespace tacto::hid {
namespace {

using SteadyTime = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kRetry{20};
constexpr std::chrono::seconds kMaxRetries{60};  // a device that refuses a stop for this long cannot be helped
constexpr unsigned kTransfer_ms = 200;

enum class Sent { Taken, Gone, Failed };

Sent outcomeOf(bool taken) {
    if (taken) return Sent::Taken;
    return errno == ENODEV || errno == ESHUTDOWN ? Sent::Gone : Sent::Failed;
}

class Device {
public:
    explicit Device(StopWay way) : way_(std::move(way)), node_(open(way_.node.c_str(), O_RDWR | O_CLOEXEC)) {}
    [[nodiscard]] bool isOpen() const noexcept { return node_ >= 0; }

    Sent sendStop() {
        if (way_.kind == StopWay::Kind::Hidraw) {
            return outcomeOf(write(node_, way_.bytes.data(), way_.bytes.size()) == std::ssize(way_.bytes));
        }
        return outcomeOf(sendControl());
    }

    /// Returns interface 0 to the kernel's driver, from which the dead program had taken it.
    void giveBack() {
        if (way_.kind != StopWay::Kind::Usb) return;
        usbdevfs_ioctl command{0, USBDEVFS_CONNECT, nullptr};
        ioctl(node_, USBDEVFS_IOCTL, &command);
    }

private:
    bool sendControl() {
        const auto word = [&](std::size_t at) {
            return static_cast<std::uint16_t>(way_.bytes[at] | way_.bytes[at + 1] << 8);
        };
        usbdevfs_ctrltransfer transfer{};
        transfer.bRequestType = way_.bytes[0];
        transfer.bRequest = way_.bytes[1];
        transfer.wValue = word(2);
        transfer.wIndex = word(4);
        transfer.timeout = kTransfer_ms;
        return ioctl(node_, USBDEVFS_CONTROL, &transfer) == 0;
    }

    StopWay way_;
    const int node_;
};

void tell(WatchdogWord word, int error = 0) {
    char message[1 + sizeof error] = {static_cast<char>(word)};
    std::memcpy(message + 1, &error, sizeof error);
    send(kWatchdogSocket, message, sizeof message, MSG_NOSIGNAL);
}

/// Returns the milliseconds until `when` for poll(), rounded up.
int timeUntil(SteadyTime::time_point when) {
    const auto left = std::chrono::ceil<milliseconds>(when - SteadyTime::now()).count();
    return left < 0 ? 0 : static_cast<int>(left);
}

/// Watches until nothing is left to watch.
int watch(Device& device) {
    bool orphaned = false;
    bool stopDue = false;
    bool on = false;
    SteadyTime::time_point silentAt{};  // used while output is on
    SteadyTime::time_point giveUpAt{};  // used while orphaned
    for (;;) {
        if (stopDue) {
            const auto sent = device.sendStop();
            if (sent == Sent::Gone && orphaned) return 0;
            if (sent != Sent::Failed) stopDue = on = false;
        }
        if (orphaned && !stopDue) {
            device.giveBack();
            return 0;
        }
        if (orphaned && SteadyTime::now() >= giveUpAt) return 1;
        pollfd line{orphaned ? -1 : kWatchdogSocket, POLLIN, 0};
        const int timeout = stopDue ? static_cast<int>(kRetry.count()) : on ? timeUntil(silentAt) : -1;
        const int came = poll(&line, 1, timeout);
        if (came < 0) continue;
        if (came == 0) {
            stopDue = true;
            continue;
        }
        char word = 0;
        const auto length = recv(kWatchdogSocket, &word, 1, 0);
        if (length < 0 && errno == EINTR) continue;
        if (length <= 0) {
            orphaned = stopDue = true;
            giveUpAt = SteadyTime::now() + kMaxRetries;
        } else if (word == static_cast<char>(WatchdogWord::Beat)) {
            on = true;
            silentAt = SteadyTime::now() + kWatchdogSilence;
            send(kWatchdogSocket, &word, 1, MSG_NOSIGNAL | MSG_DONTWAIT);
        } else if (word == static_cast<char>(WatchdogWord::Rest)) {
            on = stopDue = false;
        } else if (word == static_cast<char>(WatchdogWord::Leave)) {
            return 0;
        }
    }
}

}  // namespace
}  // namespace tacto::hid

int main(int argumentCount, char** arguments) {
    using namespace tacto::hid;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP, SIGTTIN, SIGTTOU, SIGUSR1, SIGUSR2}) {
        std::signal(signal, SIG_IGN);
    }
    // Closes inherited files of the program, which must not stay open after the program's death.
    close_range(kWatchdogSocket + 1, ~0U, 0);
    auto way = StopWay::read(argumentCount - 1, arguments + 1);
    if (!way || fcntl(kWatchdogSocket, F_GETFD) < 0) {
        std::fputs("tactoscope-watchdog is started by Tactoscope, which gives it a massager to stop.\n", stderr);
        return 2;
    }
    fcntl(kWatchdogSocket, F_SETFD, FD_CLOEXEC);
    Device device(std::move(*way));
    if (!device.isOpen()) {
        tell(WatchdogWord::Failed, errno);
        return 1;
    }
    mlockall(MCL_CURRENT | MCL_FUTURE);  // if permitted, because the watchdog must run when memory is short
    tell(WatchdogWord::Ready);
    return watch(device);
}
