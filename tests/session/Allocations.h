// Allocations.h - counts what the calling thread allocates with new. The test program's operators are replaced.
#pragma once

#include <cstddef>

namespace tacto::test {

[[nodiscard]] std::size_t allocationsOfThisThread() noexcept;

}  // namespace tacto::test
