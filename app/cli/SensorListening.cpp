#include "app/cli/SensorListening.h"

#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

#include "app/cli/Say.h"

namespace tacto::cli {

namespace {

using SteadyTime = std::chrono::steady_clock::time_point;

constexpr std::chrono::milliseconds kReadEvery(2);
constexpr double kShowEvery_s = 0.25;

/// Says on a terminal how much longer it will take.
class Countdown {
public:
    explicit Countdown(double whole_s) : whole_s_(whole_s), terminal_(isatty(STDERR_FILENO) != 0) {}
    ~Countdown() {
        if (terminal_) say(stderr, "\r\033[K");
    }
    Countdown(const Countdown&) = delete;
    Countdown& operator=(const Countdown&) = delete;
    void show(double passed_s) {
        if (!terminal_ || passed_s < next_s_) return;
        next_s_ = passed_s + kShowEvery_s;
        say(stderr, "\r\033[Klistening, {:.0f} s left", whole_s_ - passed_s);
        std::fflush(stderr);
    }

private:
    const double whole_s_;
    const bool terminal_;
    double next_s_ = 0;
};

}  // namespace

Result<Listened> listenTo(SensorBoard& board, Seconds time, const SignalStop& interrupts) {
    const auto streams = board.streams();
    std::vector<StreamHealth> health;
    for (const auto& stream : streams) health.emplace_back(stream.rate_hz);
    std::vector<SampleBlock> blocks(streams.size());
    Countdown countdown(time.count());
    const SteadyTime begin = std::chrono::steady_clock::now();
    Listened heard;
    while (heard.seconds < time.count() && !interrupts.signalled()) {
        std::this_thread::sleep_for(kReadEvery);
        for (auto& block : blocks) block.clear();
        if (const auto read = board.read(blocks); !read) return failure(read);
        for (std::size_t i = 0; i < blocks.size(); ++i) health[i].feed(blocks[i], streams[i].channels);
        heard.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        countdown.show(heard.seconds);
    }
    for (const auto& one : health) heard.health.push_back(one.report());
    heard.report = board.report();
    return heard;
}

}  // namespace tacto::cli
