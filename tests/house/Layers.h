// Layers.h - the build targets of core, drivers and app, as written by tests/house/CMakeLists.txt: their sources, the
// targets they link, and the links they pass on.
//
// Thread-safety: pure functions on plain data.
#pragma once

#include <istream>
#include <map>
#include <string>
#include <vector>

namespace tacto::test {

struct Target {
    std::vector<std::string> sources;  ///< paths in the tree
    std::vector<std::string> links, handsOn;
};
using Targets = std::map<std::string, Target>;

[[nodiscard]] Targets readTargets(std::istream& in);
/// Returns the targets of this build.
[[nodiscard]] Targets targetsOfTheBuild();

}  // namespace tacto::test
