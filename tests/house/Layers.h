// Layers.h - the targets of core, drivers and app, as tests/house/CMakeLists.txt writes them: their sources, what they
// link and what they hand on.
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
/// The targets of this build.
[[nodiscard]] Targets targetsOfTheBuild();

}  // namespace tacto::test
