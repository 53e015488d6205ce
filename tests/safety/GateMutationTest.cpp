// Each check of the gate, taken away in turn, must make its case fail: no check is there untested (H1).
// Linked with tacto_safety_mutable, the same sources with removable checks; never with the product's library.
#include <gtest/gtest.h>

#include "core/safety/GateChecks.h"
#include "tests/safety/GateCases.h"

#ifndef TACTO_GATE_MUTATION
#error "this test belongs to the mutable library"
#endif

namespace tacto::test {

TEST(GateMutation, EveryCaseHoldsWithEveryCheckInPlace) {
    gate::skippedCheck = -1;
    for (const auto& c : gateCases()) EXPECT_TRUE(c.holds()) << c.name;
}

TEST(GateMutation, EveryCheckTakenAwayIsNoticed) {
    RecordProperty("hazard", "H1");
    const auto cases = gateCases();
    std::vector<int> checks;
    for (int c = 0; c < gate::kNamedChecks; ++c) checks.push_back(c);
    for (std::size_t k = 0; k < kQuantityCount; ++k) {
        const auto q = static_cast<Quantity>(k);
        checks.push_back(gate::limitCheck(gate::RequestLimit, q));
        checks.push_back(gate::limitCheck(gate::RequestCeiling, q));
        if (windowOf(q) == 0) continue;
        checks.push_back(gate::limitCheck(gate::MeterLimit, q));
        checks.push_back(gate::limitCheck(gate::MeterCeiling, q));
    }
    for (const int check : checks) {
        gate::skippedCheck = check;
        bool tried = false;
        bool noticed = false;
        for (const auto& c : cases) {
            if (c.check != check) continue;
            tried = true;
            noticed = noticed || !c.holds();
        }
        EXPECT_TRUE(tried) << "no case for check " << check;
        EXPECT_TRUE(noticed) << "check " << check << " can be taken away and no case fails";
    }
    gate::skippedCheck = -1;
    RecordProperty("checks", static_cast<int>(checks.size()));
}

}  // namespace tacto::test
