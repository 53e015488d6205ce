// Verdict.h - what a benchmark says of its goal; tests/perf/run fails where it finds a missed one.
//
// Thread-safety: a pure function.
#pragma once

namespace tacto {

/// "met" or "MISSED".
[[nodiscard]] constexpr const char* verdict(bool met) noexcept { return met ? "met" : "MISSED"; }

}  // namespace tacto
