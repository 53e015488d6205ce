// A host for KillTest: opens the stimulator behind the given terminal, prints a line and sends it a train of 20 s,
// until it is killed or the train fails. With "again" as second argument it sends another train after one that failed
// because the computer was late.
#include <cstdio>
#include <cstring>
#include <thread>

#include "drivers/sciencemode/ScienceModeStimulator.h"
#include "drivers/sciencemode/TtyTransport.h"
#include "tests/drivers/sciencemode/ScienceModeBench.h"

namespace {

using namespace tacto;

/// Sends a train; returns its error once it has failed.
Error sendTrain(sciencemode::ScienceModeStimulator& stimulator, const Clock& clock) {
    const auto gate = test::benchGate(clock, stimulator.traits());
    const auto begun = stimulator.deliver(test::approve(*gate, clock, test::biphasic(5, 400, 20), Seconds(24)));
    if (!begun) return begun.error();
    std::puts("delivering");
    std::fflush(stdout);
    for (;;) {
        const auto status = stimulator.status();
        if (!status) return status.error();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

}  // namespace

int main(int argumentCount, char** arguments) {
    if (argumentCount < 2) return 2;
    const bool again = argumentCount == 3 && std::strcmp(arguments[2], "again") == 0;
    const SteadyClock clock;
    const std::string terminal = arguments[1];
    const auto opened = sciencemode::ScienceModeStimulator::open(
        [&] { return sciencemode::TtyTransport::open(terminal); }, "sciencemode:", {}, {}, clock);
    if (!opened) {
        std::fprintf(stderr, "%s\n", opened.error().message.c_str());
        return 1;
    }
    for (;;) {
        const auto error = sendTrain(**opened, clock);
        std::fprintf(stderr, "%s\n", error.message.c_str());
        if (!again || !test::cameLate(error)) return 1;
    }
}
