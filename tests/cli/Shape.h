// Shape.h - checks the output formats that cli.md promises.
//
// Thread-safety: the test's own thread.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tests/cli/RunCli.h"

namespace tacto::test {

using Json = nlohmann::json;

/// Returns the JSON on stdout, which must contain one value and nothing else.
[[nodiscard]] Json jsonOf(const Ran& ran);

/// Expects this exit code, nothing on stdout, and one sentence on stderr that contains all `parts`.
void expectRefused(const Ran& ran, int code, const Words& parts);

/// Expects {"mean","sd","median","min","max","n"}, in order, with null for missing values.
void expectStatistic(const Json& value, const std::string& what);
/// Expects {"value","low","high"}.
void expectEstimate(const Json& value, const std::string& what);
void expectKeys(const Json& value, const Words& keys, const std::string& what);

/// Checks the output that run separability and analyze separability share.
void expectSeparability(const Json& results);

extern const Words kConditions;

}  // namespace tacto::test
