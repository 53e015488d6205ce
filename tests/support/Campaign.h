// Campaign.h - how often a test of a race tries: a few times in CI, many times in `./dev campaign` (TACTO_CAMPAIGN=1).
#pragma once

#include <cstdlib>
#include <string_view>

namespace tacto::test {

[[nodiscard]] inline int campaignTrials(int usually = 20, int inCampaign = 200) {
    const char* set = std::getenv("TACTO_CAMPAIGN");
    return set != nullptr && std::string_view(set) == "1" ? inCampaign : usually;
}

}  // namespace tacto::test
