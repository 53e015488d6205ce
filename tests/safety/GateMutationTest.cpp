// With each rule of the gate disabled in turn, the rule's case must fail: every rule is tested (H1). Linked with
// tacto_safety_mutable, the same sources with removable rules; never with the product's library.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/safety/Rules.h"
#include "tests/safety/CheckNames.h"
#include "tests/safety/GateCases.h"
#include "tests/support/Support.h"

#ifndef TACTO_GATE_MUTATION
#error "this test belongs to the mutable library"
#endif

namespace tacto::test {

TEST(GateMutation, EveryCaseHoldsWithEveryCheckInPlace) {
    gate::removedRule = -1;
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
        gate::removedRule = check;
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
    gate::removedRule = -1;
    RecordProperty("checks", static_cast<int>(checks.size()));
}

/// Returns the rule whose table entry begins in `line`; empty if there is none.
std::string_view ruleBegunIn(const std::string& line) {
    const auto brace = line.find_first_not_of(' ');
    if (brace == std::string::npos || line[brace] != '{') return {};
    std::string_view entry = std::string_view(line).substr(brace + 1);
    if (entry.starts_with("gate::")) entry.remove_prefix(6);
    const auto named = std::ranges::find(kCheckNames, entry.substr(0, entry.find(',')), &CheckName::name);
    return named != kCheckNames.end() ? named->name : std::string_view();
}

/// Every refusal in the deciding files is in a rule's entry, or in a function that only writes the message, or the line
/// before it says why neither applies.
TEST(GateMutation, EveryRefusalHasItsRule) {
    RecordProperty("hazard", "H1");
    int refusals = 0;
    std::map<std::string_view, std::string> rules;  // the place of each rule
    for (const char* name :
         {"AcceptedLevels.cpp", "SetupRules.cpp", "TrainRules.cpp", "LimitRules.cpp", "Interlock.cpp", "SafetyGate.cpp",
          "TrainCheck.cpp", "DeliveryBounds.cpp", "Heartbeat.h"}) {
        std::ifstream in(sourceDir() / "core" / "safety" / name);
        ASSERT_TRUE(in) << name;
        std::vector<std::string> lines;
        for (std::string line; std::getline(in, line);) lines.push_back(line);
        for (std::size_t at = 0; at < lines.size(); ++at) {
            const auto& line = lines[at];
            const auto says = [&line](const char* words) { return line.find(words) != std::string::npos; };
            // If two rules shared a name, a wrong one could be hidden from the mutation test by the other.
            if (const auto rule = ruleBegunIn(line); !rule.empty()) {
                const auto [first, isNew] = rules.try_emplace(rule, fmt::format("{}:{}", name, at + 1));
                EXPECT_TRUE(isNew) << name << ':' << at + 1 << ": " << rule << " is a rule already, " << first->second;
            }
            if (line.starts_with("tl::unexpected<Error> ")) continue;
            const bool refuses = says("fail(ErrorCode") || line.ends_with("fail(") || says("invalid(") ||
                                 says("beyond(") || says("refused(") || says("failure(") ||
                                 says("finding = TrainFinding::") ||
                                 (name == std::string("Heartbeat.h") && says("return false;") && !says("firstBroken("));
            // Lines that only pass on the refusal of a table need no rule.
            if (!refuses || says("return failure(kept)") || says("return failure(sound)") ||
                says("finding = TrainFinding::Ok;"))
                continue;
            ++refusals;
            bool named = false;
            for (std::size_t back = 0; back <= at && !named; ++back) {
                const auto& above = lines[at - back];
                named = !ruleBegunIn(above).empty() || above.starts_with("tl::unexpected<Error> ") ||
                        (back <= 1 && above.find("// No rule:") != std::string::npos);
                if (back > 0 && above.starts_with("}")) break;
            }
            EXPECT_TRUE(named) << name << ':' << at + 1 << " refuses without a rule of Rules.h: " << line;
        }
    }
    RecordProperty("refusals", refusals);
    EXPECT_GE(refusals, 80) << "the files were not read as expected";
    EXPECT_GE(rules.size(), 100U) << "the tables were not read as expected";
}

}  // namespace tacto::test
