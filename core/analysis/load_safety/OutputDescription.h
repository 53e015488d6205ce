// OutputDescription.h - the output in words, as the FDA guidance for powered muscle stimulators asks it to be
// disclosed beside the figures of DisclosedOutput: waveform, shape, widths, frequency, symmetry of the phases, how the
// net charge comes to zero, burst duty, on and off time. What was measured into 500 Ω (else the first load measured)
// stands beside what was commanded.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/analysis/load_safety/LoadSafety.h"
#include "core/results/ResultTable.h"

namespace tacto {

struct DescribedOutput {
    std::string output;     ///< "phase width"
    std::string commanded;  ///< "200 µs"
    std::string measured;  ///< "200.1 ± 0.4 µs"; empty where only a command says it, "not evaluated" where unmeasured
};

[[nodiscard]] std::vector<DescribedOutput> describeOutput(const LoadSafetyInput& input);

/// {"output","commanded","measured"}; measured null where there is nothing to measure.
[[nodiscard]] nlohmann::json toJson(const DescribedOutput& output);
[[nodiscard]] std::vector<ResultColumn> outputColumns();

}  // namespace tacto
