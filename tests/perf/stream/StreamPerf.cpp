// StreamPerf.cpp - a sensor board's stream for ten minutes of real time: 4 kHz × 3 and 9 × 200 Hz through a
// pseudo-terminal between two processes, read every 2 ms as in a session. Prints the losses and the reader's cost.
//
//   perf_stream [SECONDS]
//
// Goal: no losses, and at most ten times the cost of a thread that only wakes as often.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "core/acquisition/StreamHealth.h"
#include "core/devices/Device.h"
#include "drivers/sciencemode/TtyTransport.h"
#include "drivers/sensor_board/UsbSensorBoards.h"
#include "tests/drivers/sensor_board/BoardOnPty.h"
#include "tests/perf/Verdict.h"

namespace tacto {
namespace {

using namespace std::chrono_literals;

/// Runs the board in a separate process, so that its work is not the reader's. Ends when `stop` is closed.
[[noreturn]] void beBoard(int tell, int stop) {
    SteadyClock clock;
    sensorboard::EmulatedBoardSettings settings;
    settings.drift_ppm = 50;
    test::BoardOnPty board(clock, settings);
    if (write(tell, board.path().c_str(), board.path().size() + 1) < 0) _exit(1);
    char nothing;
    while (read(stop, &nothing, 1) > 0) {
    }
    _exit(0);
}

double processorSeconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Returns the share of a core, in percent, for only waking every 2 ms.
double wakingAlone_percent() {
    const double before = processorSeconds();
    const auto end = std::chrono::steady_clock::now() + 3s;
    while (std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(2ms);
    return 100 * (processorSeconds() - before) / 3;
}

int measure(const std::string& path, double duration_s) {
    const double waking = wakingAlone_percent();
    SteadyClock clock;
    const auto driver = makeSensorBoardDriver(
        makeUsbSensorBoards([] { return fail(ErrorCode::Io, "no USB here"); }, sciencemode::TtyTransport::open));
    DeviceSet devices;
    if (const auto opened = driver->open(*DeviceUri::parse("sensor:?tty=" + path), {}, {clock}, devices); !opened) {
        std::fprintf(stderr, "%s\n", opened.error().message.c_str());
        return 3;
    }
    auto& sensor = *devices.sensor;
    std::vector<SampleBlock> blocks(sensor.streams().size());
    std::vector<StreamHealth> health;
    std::vector<std::size_t> samples(blocks.size());
    for (const auto& stream : sensor.streams()) health.emplace_back(stream.rate_hz);
    const double before = processorSeconds();
    const auto begun = std::chrono::steady_clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(); };
    while (passed() < duration_s) {
        std::this_thread::sleep_for(2ms);
        if (const auto got = sensor.read(blocks); !got) {
            std::fprintf(stderr, "after %.1f s: %s\n", passed(), got.error().message.c_str());
            return 1;
        }
        for (std::size_t s = 0; s < blocks.size(); ++s) {
            samples[s] += blocks[s].samples();
            health[s].feed(blocks[s], sensor.streams()[s].channels);
            blocks[s].clear();
        }
    }
    const double wall = passed();
    const double percent = 100 * (processorSeconds() - before) / wall;
    const auto report = dynamic_cast<const ReportingDevice&>(sensor).deviceReport();
    std::printf("sensor board, %.0f s of real time: %zu + %zu + %zu samples, %llu lost; %.2f %% of a core\n", wall,
                samples[0], samples[1], samples[2], static_cast<unsigned long long>(report.losses), percent);
    std::printf("  %s%s\n", verdict(percent / waking, "waking as often", 10).c_str(),
                ofLimit(percent, 5, "% of a core").c_str());
    bool continuous = true;
    for (std::size_t s = 0; s < health.size(); ++s) {
        continuous = continuous && health[s].report().continuous();
        std::printf("  %-13s %s\n", sensor.streams()[s].name.c_str(), health[s].report().text().c_str());
    }
    for (const auto& row : report.rows()) std::printf("  %-28s %.6g %s\n", row.name, row.value, row.unit);
    if (report.losses != 0 || !continuous) std::printf("  MISSED: every sample, in one piece\n");
    return 0;
}

}  // namespace
}  // namespace tacto

int main(int argc, char** argv) {
    const double duration_s = argc > 1 ? std::atof(argv[1]) : 600;
    if (!(duration_s > 0 && duration_s <= 86'400)) {
        std::fprintf(stderr, "perf_stream: %s s; above 0 to 86400 s is expected\n", argv[1]);
        return 2;
    }
    int tell[2], stop[2];
    if (pipe(tell) != 0 || pipe(stop) != 0) return 3;
    const pid_t board = fork();
    if (board == 0) {
        close(stop[1]);
        tacto::beBoard(tell[1], stop[0]);
    }
    std::array<char, 64> path{};
    if (board < 0 || read(tell[0], path.data(), path.size() - 1) <= 0) return 3;
    const int result = tacto::measure(path.data(), duration_s);
    close(stop[1]);
    waitpid(board, nullptr, 0);
    return result;
}
