// A host for KillTest: opens the stimulator behind the terminal it is given, repeats a train every 0.5 s and keeps the
// device alive until it is killed. Prints a line when it delivers.
#include <cstdio>
#include <thread>

#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "drivers/sciencemode/TtyTransport.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"

int main(int argumentCount, char** arguments) {
    using namespace tacto;
    if (argumentCount != 2) return 2;
    const SteadyClock clock;
    // The mode of the device that repeats by itself, which no URI opens.
    sciencemode::StimulatorSettings settings;
    settings.midLevel = true;
    const std::string terminal = arguments[1];
    const auto opened = sciencemode::ScienceModeStimulator::open(
        [&] { return sciencemode::TtyTransport::open(terminal); }, "sciencemode:", {}, settings, clock);
    if (!opened) {
        std::fprintf(stderr, "%s\n", opened.error().message.c_str());
        return 1;
    }
    auto& stimulator = **opened;
    const auto gate = test::wideGate(clock, stimulator.traits());
    const auto begun = stimulator.repeat(test::approve(*gate, clock, test::biphasic(5), Seconds(0.5)), Seconds(0.5));
    if (!begun) {
        std::fprintf(stderr, "%s\n", begun.error().message.c_str());
        return 1;
    }
    std::puts("delivering");
    std::fflush(stdout);
    for (;;) {
        if (const auto kept = stimulator.keepAlive(); !kept) {
            std::fprintf(stderr, "%s\n", kept.error().message.c_str());
            return 1;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
}
