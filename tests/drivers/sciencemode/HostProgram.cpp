// A host for KillTest: opens the stimulator behind the terminal it is given, repeats a train every 0.5 s and keeps the
// device alive until it is killed. Prints a line when it delivers.
#include <cstdio>
#include <thread>

#include "drivers/sciencemode/ScienceModeDriver.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"

int main(int argumentCount, char** arguments) {
    using namespace tacto;
    if (argumentCount != 2) return 2;
    const SteadyClock clock;
    DeviceSet devices;
    const DeviceUri uri{"sciencemode", "", {{"tty", arguments[1]}, {"level", "mid"}}};
    const auto opened = makeScienceModeDriver(nullptr)->open(uri, {}, OpenContext{clock, 1, "1 kohm"}, devices);
    if (!opened) {
        std::fprintf(stderr, "%s\n", opened.error().message.c_str());
        return 1;
    }
    const auto gate = test::wideGate(clock, devices.stimulator->traits());
    auto& repeating = dynamic_cast<RepeatingStimulator&>(*devices.stimulator);
    const auto begun = repeating.repeat(test::approve(*gate, clock, test::biphasic(5), Seconds(0.5)), Seconds(0.5));
    if (!begun) {
        std::fprintf(stderr, "%s\n", begun.error().message.c_str());
        return 1;
    }
    std::puts("delivering");
    std::fflush(stdout);
    for (;;) {
        if (const auto kept = devices.stimulator->keepAlive(); !kept) {
            std::fprintf(stderr, "%s\n", kept.error().message.c_str());
            return 1;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
}
