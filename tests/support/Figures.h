// Figures.h - numbers that a script in tests/reference computes in another way, for tests to compare with.
//
// Thread-safety: any thread.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace tacto::test {

/// Returns tests/reference/<name>.json. Read values with at(), so that a missing figure fails the test.
[[nodiscard]] const nlohmann::json& figuresOf(std::string_view name);

}  // namespace tacto::test
