// Allocations.h - counts what the calling thread takes with new. Link test_allocations: it replaces the program's
// operators.
//
// Thread-safety: any thread; each counts its own.
#pragma once

#include <cstddef>

namespace tacto::test {

/// False under the sanitizers, which bring their own operators: then `GTEST_SKIP() << kNotCounted;`
[[nodiscard]] bool countsAllocations() noexcept;
inline constexpr const char* kNotCounted = "the sanitizers count allocations themselves";

[[nodiscard]] std::size_t allocationsOfThisThread() noexcept;

}  // namespace tacto::test
