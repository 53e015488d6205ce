// OutputDescription.h - describes the output in words, as the FDA guidance for powered muscle stimulators requires in
// addition to the figures of DisclosedOutput: waveform, shape, widths, frequency, symmetry of the phases, how the net
// charge becomes zero, burst duty, on and off time. Each line gives the commanded value and the value measured into 500
// Ω (else into the first load measured).
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
    std::string measured;   ///< "200.1 ± 0.4 µs"; empty if only a command tells it; "not evaluated" if unmeasured
};

[[nodiscard]] std::vector<DescribedOutput> describeOutput(const LoadSafetyInput& input);

/// {"output","commanded","measured"}; "measured" is null if there is nothing to measure.
[[nodiscard]] nlohmann::json toJson(const DescribedOutput& output);
[[nodiscard]] std::vector<ResultColumn> outputColumns();

}  // namespace tacto
