// WindowPerf.h - shared by the parts of perf_window: lines of one table, each value with its goal and its baseline.
//
// Thread-safety: the GUI thread, except secondsOf().
#pragma once

#include <ctime>
#include <functional>
#include <string>

#include "app/gui/controller/BenchController.h"

namespace tacto::perf {

/// Prints a heading and the titles of its columns.
void heading(const char* what, const char* columns);
/// Prints one line. `figures` are already formatted; `remark` gives the goal and the ratio to the baseline.
void line(const std::string& what, const std::string& figures, const std::string& remark = {});
/// Prints what could not be measured, and why; the program continues and ends with an error.
void notMeasured(const std::string& what, const std::string& why);
[[nodiscard]] bool everythingWasMeasured() noexcept;

/// Returns CPU time of the calling thread (CLOCK_THREAD_CPUTIME_ID) or of the process (CLOCK_PROCESS_CPUTIME_ID).
[[nodiscard]] double secondsOf(clockid_t clock) noexcept;

/// Runs the event loop until `isSo` is true; returns false after `limit_ms`.
[[nodiscard]] bool comes(const std::function<bool()>& isSo, int limit_ms = 10'000);
/// Runs the event loop for `ms` milliseconds.
void pass(int ms);

/// Opens the simulated bench at `speed` times real time.
[[nodiscard]] bool openBench(gui::BenchController& controller, double speed = 1);
/// Arms the bench and drives by hand, which takes a few trains. Returns false if the bench does not deliver.
[[nodiscard]] bool deliver(gui::BenchController& controller);

void measureRedraw();
void measureStalls(const std::string& cli);
void measureStop();

}  // namespace tacto::perf
