// Allocations.h - counts the calling thread's allocations with new. Link test_allocations, which replaces the program's
// operators.
//
// Thread-safety: any thread; each thread has its own count.
#pragma once

#include <cstddef>

namespace tacto::test {

/// Returns false under the sanitizers, which have their own operators: then use `GTEST_SKIP() << kNotCounted;`
[[nodiscard]] bool countsAllocations() noexcept;
inline constexpr const char* kNotCounted = "the sanitizers count allocations themselves";

[[nodiscard]] std::size_t allocationsOfThisThread() noexcept;

}  // namespace tacto::test
