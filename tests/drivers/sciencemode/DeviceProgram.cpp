// An emulated stimulator behind a pseudo-terminal, for a client that a person runs or that uses another language.
// Prints the terminal to open, and at the end of its input the pulses that it put out.
//
//   sciencemode_device ["200 ohm + 10 kohm || 50 nF"]
#include <cstdio>

#include "tests/support/emulated/sciencemode/EmulatedPty.h"

int main(int argumentCount, char** arguments) {
    using namespace tacto;
    const auto load = parseLoad(argumentCount > 1 ? arguments[1] : "1 kohm");
    if (!load) {
        std::fprintf(stderr, "%s\n", load.error().message.c_str());
        return 2;
    }
    const SteadyClock clock;
    sciencemode::EmulatedSettings settings;
    settings.load = *load;
    const auto pty = sciencemode::EmulatedPty::open(settings, clock);
    if (!pty) {
        std::fprintf(stderr, "%s\n", pty.error().message.c_str());
        return 1;
    }
    std::printf("%s\n", (*pty)->path().c_str());
    std::fflush(stdout);
    while (std::getchar() != EOF) {
    }
    (*pty)->inspect([](auto& device, Instant now) {
        for (const auto& pulse : device.pulses(now)) {
            std::printf("%.6f s, channel %d, %s", toSeconds(pulse.onset), pulse.channel,
                        pulse.midLevel ? "mid" : "low");
            for (const auto& point : pulse.points.span()) {
                std::printf(", %g mA %g us", point.current.value(), point.time.count());
            }
            std::printf("%s\n", pulse.cut ? ", cut" : "");
        }
    });
    return 0;
}
