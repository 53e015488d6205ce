// Shape.h - the shapes that cli.md promises.
//
// Thread-safety: the test's own thread.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tests/cli/RunCli.h"

namespace tacto::test {

using Json = nlohmann::json;

/// The JSON on stdout, which must be one value and nothing else.
[[nodiscard]] Json jsonOf(const Ran& ran);

/// Exit code, nothing on stdout, and one sentence on stderr in which every one of `parts` occurs.
void expectRefused(const Ran& ran, int code, const Words& parts);

/// {"mean","sd","median","min","max","n"}, in order, and null where there is nothing.
void expectStatistic(const Json& value, const std::string& what);
/// {"value","low","high"}
void expectEstimate(const Json& value, const std::string& what);
void expectKeys(const Json& value, const Words& keys, const std::string& what);

/// The output that run separability and analyze separability share.
void expectSeparability(const Json& results);

extern const Words kConditions;

}  // namespace tacto::test
