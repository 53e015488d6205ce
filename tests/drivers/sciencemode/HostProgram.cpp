// A host for KillTest: opens the stimulator behind the terminal it is given and sends it a train of 20 s, until it is
// killed or gives the train up. Prints a line when it delivers.
#include <cstdio>
#include <thread>

#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "drivers/sciencemode/TtyTransport.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"

int main(int argumentCount, char** arguments) {
    using namespace tacto;
    if (argumentCount != 2) return 2;
    const SteadyClock clock;
    const std::string terminal = arguments[1];
    const auto opened = sciencemode::ScienceModeStimulator::open(
        [&] { return sciencemode::TtyTransport::open(terminal); }, "sciencemode:", {}, {}, clock);
    if (!opened) {
        std::fprintf(stderr, "%s\n", opened.error().message.c_str());
        return 1;
    }
    auto& stimulator = **opened;
    const auto gate = test::wideGate(clock, stimulator.traits());
    const auto begun = stimulator.deliver(test::approve(*gate, clock, test::biphasic(5, 400, 20), Seconds(22)));
    if (!begun) {
        std::fprintf(stderr, "%s\n", begun.error().message.c_str());
        return 1;
    }
    std::puts("delivering");
    std::fflush(stdout);
    for (;;) {
        const auto status = stimulator.status();
        if (!status) {
            std::fprintf(stderr, "%s\n", status.error().message.c_str());
            return 1;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(250));
    }
}
