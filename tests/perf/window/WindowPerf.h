// WindowPerf.h - shared by the parts of perf_window: lines of one table, each figure beside its goal and its baseline.
//
// Thread-safety: the GUI thread, but for secondsOf().
#pragma once

#include <ctime>
#include <functional>
#include <string>

#include "app/gui/controller/BenchController.h"

namespace tacto::perf {

/// A heading and what stands in the columns below it.
void heading(const char* what, const char* columns);
/// Prints one line. `figures` are formatted already; `remark` says goal and baseline ratio.
void line(const std::string& what, const std::string& figures, const std::string& remark = {});
/// Tells what could not be measured, and why; the program continues and ends with an error.
void notMeasured(const std::string& what, const std::string& why);
[[nodiscard]] bool everythingWasMeasured() noexcept;

/// CPU time of the calling thread (CLOCK_THREAD_CPUTIME_ID) or of the process (CLOCK_PROCESS_CPUTIME_ID).
[[nodiscard]] double secondsOf(clockid_t clock) noexcept;

/// Lets the event loop run until `isSo`; false after `limit_ms`.
[[nodiscard]] bool comes(const std::function<bool()>& isSo, int limit_ms = 10'000);
/// Lets it run so long.
void pass(int ms);

/// Opens the simulated bench at `speed` times real time.
[[nodiscard]] bool openBench(gui::BenchController& controller, double speed = 1);
/// Arms it and drives by hand: both within a few trains. False, when the bench does not deliver.
[[nodiscard]] bool deliver(gui::BenchController& controller);

void measureRedraw();
void measureStalls(const std::string& cli);
void measureStop();

}  // namespace tacto::perf
