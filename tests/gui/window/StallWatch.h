// StallWatch.h - measures how long the window could not answer: the longest gap between two beats of a 5 ms timer in
// its event loop. An idle window has gaps of 5 ms.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QEventLoop>
#include <QTimer>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

namespace tacto::test {

struct Stalls {
    static constexpr double kBeat_ms = 5;
    static constexpr double kNoticed_ms = 50;  ///< the shortest gap that a person notices
    double longest_ms = 0;
    std::size_t noticed = 0;  ///< number of gaps above kNoticed_ms
    std::size_t beats = 0;
    double lasted_s = 0;
};

/// Calls `begin` inside the event loop, then lets the window run until `isSo` is true. Returns nothing if that takes
/// longer than `limit_ms`. `isSo` is called at each beat, and its time is not counted, because it is not work of the
/// window.
[[nodiscard]] inline std::optional<Stalls> stallsWhile(const std::function<void()>& begin,
                                                       const std::function<bool()>& isSo, int limit_ms) {
    using SteadyClock = std::chrono::steady_clock;
    const auto since = [](SteadyClock::time_point then) {
        return std::chrono::duration<double, std::milli>(SteadyClock::now() - then).count();
    };
    QEventLoop loop;
    QTimer beat;
    beat.setTimerType(Qt::PreciseTimer);
    Stalls seen;
    bool came = false;
    auto last = SteadyClock::now();
    const auto began = last;
    QObject::connect(&beat, &QTimer::timeout, &loop, [&] {
        const double gap = since(last);
        seen.longest_ms = std::max(seen.longest_ms, gap);
        if (gap > Stalls::kNoticed_ms) ++seen.noticed;
        ++seen.beats;
        came = isSo();
        if (came || since(began) > limit_ms) loop.quit();
        last = SteadyClock::now();
    });
    beat.start(static_cast<int>(Stalls::kBeat_ms));
    QTimer::singleShot(0, &loop, begin);
    last = SteadyClock::now();
    loop.exec();
    seen.lasted_s = since(began) / 1000;
    return came ? std::optional(seen) : std::nullopt;
}

}  // namespace tacto::test
