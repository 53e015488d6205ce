// Each check of the gate, taken away in turn, must make its case fail: no check is there untested (H1).
// Linked with tacto_safety_mutable, the same sources with removable checks; never with the product's library.
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "core/safety/GateChecks.h"
#include "tests/safety/CheckNames.h"
#include "tests/safety/GateCases.h"
#include "tests/support/Support.h"

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
    for (const auto& named : kCheckNames) checks.push_back(named.check);
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
        const auto name = check < gate::kNamedChecks ? kCheckNames[static_cast<std::size_t>(check)].name : "a limit";
        EXPECT_TRUE(tried) << "no case for check " << check << ' ' << name;
        EXPECT_TRUE(noticed) << "check " << check << ' ' << name << " can be taken away and no case fails";
    }
    gate::skippedCheck = -1;
    RecordProperty("checks", static_cast<int>(checks.size()));
}

/// Every refusal in the files that decide asks for a check by its name, or says on the line before why it cannot.
TEST(GateMutation, EveryRefusalHasItsCheck) {
    RecordProperty("hazard", "H1");
    int refusals = 0;
    for (const char* name : {"AcceptedLevels.cpp", "GateConfigure.cpp", "GateJudge.cpp", "GateRequest.cpp",
                             "Interlock.cpp", "SafetyGate.cpp", "TrainCheck.cpp", "Heartbeat.h"}) {
        std::ifstream in(sourceDir() / "core" / "safety" / name);
        ASSERT_TRUE(in) << name;
        std::vector<std::string> lines;
        for (std::string line; std::getline(in, line);) lines.push_back(line);
        for (std::size_t at = 0; at < lines.size(); ++at) {
            const auto& line = lines[at];
            const bool refuses =
                line.find("fail(ErrorCode") != std::string::npos || line.find("invalid(\"") != std::string::npos ||
                line.ends_with("return invalid(") || line.find("refuse(ErrorCode") != std::string::npos ||
                line.ends_with("return refuse(") || line.find("return found(") != std::string::npos ||
                line.find("return late &&") != std::string::npos || line.find("return beyond(") != std::string::npos ||
                (name == std::string("Heartbeat.h") && line.find("return false;") != std::string::npos);
            const bool words =
                line.find("const auto") != std::string::npos || line.find("std::forward<Args>") != std::string::npos;
            if (!refuses || words) continue;
            ++refusals;
            bool named = false;
            // Up to the start of the condition: a few lines, and not into the function before.
            for (std::size_t back = 0; back <= 24 && back <= at && !named; ++back) {
                const auto& above = lines[at - back];
                named = above.find("checks(") != std::string::npos || above.find("// No check:") != std::string::npos;
                if (back > 0 && (above == "}" || above == "    }")) break;
            }
            EXPECT_TRUE(named) << name << ':' << at + 1 << " refuses without a check of GateChecks.h: " << line;
        }
    }
    EXPECT_GE(refusals, 80) << "the files were not read as expected";
}

}  // namespace tacto::test
