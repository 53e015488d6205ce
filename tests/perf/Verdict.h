// Verdict.h - what a benchmark says of its goal, which is always a ratio to a baseline of the same run: a slow machine
// misses none for being slow, and a fast one hides nothing. tests/perf/run fails where it finds a missed one.
//
// Thread-safety: pure functions.
#pragma once

#include <cstdio>
#include <string>

namespace tacto {

/// "1.7 times the empty plot; wanted: at most 3 times: met", or MISSED, as for a ratio that is not a number.
[[nodiscard]] inline std::string verdict(double ratio, const char* baseline, double most) {
    char text[160];
    std::snprintf(text, sizeof text, "%.2g times %s; wanted: at most %g times: %s", ratio, baseline, most,
                  ratio <= most ? "met" : "MISSED");
    return text;
}

/// "; 87 % of the 10 ms that a stop may take": how far off it is from what matters to people. Never judged, for it is
/// the machine's as much as the program's.
[[nodiscard]] inline std::string ofLimit(double value, double limit, const char* what) {
    char text[160];
    std::snprintf(text, sizeof text, "; %.0f %% of the %g %s", 100 * value / limit, limit, what);
    return text;
}

}  // namespace tacto
