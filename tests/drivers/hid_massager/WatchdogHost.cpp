// A host for WatchdogTest: opens the massager that its argument names, begins a burst of 1 s, prints a line, and dies
// as it is told by its standard input: "abort", "segv", "exit"; it is killed or stopped from outside otherwise.
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
    // libusb's first look at the bus takes a moment.
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
        std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would make an exit of it
        std::raise(SIGSEGV);
    }
    if (how == "exit") _exit(0);
    return 0;
}
