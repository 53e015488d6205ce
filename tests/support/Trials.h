// Trials.h - how many trials a random test makes: a few during development (./dev test), as many as its claim needs in
// CI (.ci/run: TACTO_TRIALS=ci), and ten times as many on demand (./dev campaign: TACTO_TRIALS=campaign).
//
// Thread-safety: reads the environment.
#pragma once

#include <cstdlib>
#include <string_view>

namespace tacto::test {

template <class Count>
struct TrialCounts {
    Count local;
    Count ci;
    Count campaign;
};

template <class Count>
[[nodiscard]] Count trials(TrialCounts<Count> counts) {
    const char* set = std::getenv("TACTO_TRIALS");
    const std::string_view wanted = set == nullptr ? "" : set;
    if (wanted == "campaign") return counts.campaign;
    return wanted == "ci" ? counts.ci : counts.local;
}

/// Number of trials of a race, for trials of about a second.
[[nodiscard]] inline int raceTrials() { return trials<int>({.local = 20, .ci = 20, .campaign = 200}); }

}  // namespace tacto::test
