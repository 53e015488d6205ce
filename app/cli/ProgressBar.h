// ProgressBar.h - how far a command is, for a person at a terminal.
//
// Thread-safety: one owner.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <unistd.h>

#include "app/cli/Say.h"

namespace tacto::cli {

/// Shows "reading [#####.....] 52 %" on a terminal if that takes over a second; the destructor clears the line.
class ProgressBar {
public:
    explicit ProgressBar(const char* what) : what_(what), shown_(isatty(STDERR_FILENO) != 0) {}
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() {
        if (percent_ >= 0) say(stderr, "\r\033[K");
    }
    void show(double fraction) {
        constexpr std::chrono::seconds kProgressDelay{1};
        const auto percent = static_cast<int>(100 * fraction);
        if (!shown_ || percent == percent_ || std::chrono::steady_clock::now() - begun_ < kProgressDelay) return;
        percent_ = percent;
        const auto filled = static_cast<std::size_t>(30 * fraction);
        say(stderr, "\r\033[K{} [{}{}] {} %", what_, std::string(filled, '#'), std::string(30 - filled, '.'), percent);
        std::fflush(stderr);
    }

private:
    const char* what_;
    bool shown_;
    int percent_ = -1;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace tacto::cli
