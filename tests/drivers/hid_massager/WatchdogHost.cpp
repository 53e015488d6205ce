// A host for WatchdogTest: opens the massager named by its argument, begins a burst of 1 s, prints a line, and ends as
// standard input says: "abort", "segv", "exit"; otherwise a signal from outside kills or stops it.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

#include "drivers/hid_massager/HidDriver.h"
#include "tests/support/Support.h"

int main(int argumentCount, char** arguments) {
    using namespace tacto;
    if (argumentCount != 2) return 2;
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    const SteadyClock clock;
    const auto usb = makeUsbProvider();
    const auto driver = hid::makeHidDriver(hid::systemHid(test::sourceDir() / "resources" / "massagers", usb));
    const auto uri = DeviceUri::parse(arguments[1]);
    DeviceSet devices;
    Result<void> opened;
    // libusb needs a moment to list the bus.
    for (int attempt = 0; attempt < 50; ++attempt) {
        opened = driver->open(*uri, {}, OpenContext{clock}, devices);
        if (opened || opened.error().code != ErrorCode::NotFound) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    if (!opened) {
        std::fprintf(stderr, "%s\n", opened.error().message.c_str());
        return 1;
    }
    SafetyGate gate(clock);
    const auto begun = devices.massager->vibrate(std::move(*gate.approve(VibrationBurst{1, Seconds(1)})));
    if (!begun) {
        std::fprintf(stderr, "%s\n", begun.error().message.c_str());
        return 1;
    }
    std::puts("vibrating");
    std::fflush(stdout);
    char word[16] = "";
    if (std::scanf("%15s", word) != 1) return 2;
    const std::string how = word;
    if (how == "abort") std::abort();
    if (how == "segv") {
        std::signal(SIGSEGV, SIG_DFL);  // a sanitizer's handler would turn the signal into an exit
        std::raise(SIGSEGV);
    }
    if (how == "exit") _exit(0);
    return 0;
}
