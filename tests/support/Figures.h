// Figures.h - numbers that a script of tests/reference makes another way, for tests to be held against.
//
// Thread-safety: any thread.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace tacto::test {

/// tests/reference/<name>.json. Read with at(): a figure that is missing fails the test.
[[nodiscard]] const nlohmann::json& figuresOf(std::string_view name);

}  // namespace tacto::test
