// Comes.h - waits until a condition becomes true, checking it again and again.
//
// Thread-safety: the caller's thread.
#pragma once

#include <chrono>
#include <thread>

namespace tacto::test {

/// Returns whether `condition` became true within `within`; the default is as long as a person would wait.
template <class Condition>
[[nodiscard]] bool comes(Condition condition, std::chrono::milliseconds within = std::chrono::seconds(5)) {
    const auto end = std::chrono::steady_clock::now() + within;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

}  // namespace tacto::test
