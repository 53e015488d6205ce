// Limits.h - the shipped limit sets, read from their files.
//
// Thread-safety: the test's own thread.
#pragma once

#include <vector>

#include "core/base/Csv.h"
#include "core/safety/LimitSet.h"
#include "tests/support/Support.h"

namespace tacto::test {

/// Returns the limit sets in resources/limits.
inline const std::vector<LimitSet>& limitSets() {
    static const auto all = [] {
        std::vector<LimitSet> sets;
        for (const auto* name : {"fda-pms.json", "iec-60601-2-10.json", "paper.json"})
            sets.push_back(
                parseLimitSet(readTextFile(sourceDir() / "resources" / "limits" / name, 1'000'000).value(), name)
                    .value());
        return sets;
    }();
    return all;
}

}  // namespace tacto::test
