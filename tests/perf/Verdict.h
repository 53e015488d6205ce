// Verdict.h - the verdict on a benchmark's goal, which is always a ratio to a baseline of the same run: a slow machine
// does not miss goals, and a fast one does not hide faults. tests/perf/run fails if a goal was missed.
//
// Thread-safety: pure functions.
#pragma once

#include <cstdio>
#include <string>

namespace tacto {

/// Returns "1.7 times the empty plot; wanted: at most 3 times: met", or MISSED, also if the ratio is not a number.
[[nodiscard]] inline std::string verdict(double ratio, const char* baseline, double most) {
    char text[160];
    std::snprintf(text, sizeof text, "%.2g times %s; wanted: at most %g times: %s", ratio, baseline, most,
                  ratio <= most ? "met" : "MISSED");
    return text;
}

/// Returns "; 87 % of the 10 ms that a stop may take": the value relative to a limit that matters to people. This is
/// not a goal, as it depends on the machine as much as on the program.
[[nodiscard]] inline std::string ofLimit(double value, double limit, const char* what) {
    char text[160];
    std::snprintf(text, sizeof text, "; %.0f %% of the %g %s", 100 * value / limit, limit, what);
    return text;
}

}  // namespace tacto
