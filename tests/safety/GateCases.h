// GateCases.h - one directed case for each check of the gate, the interlock, the heartbeat and the train's read-back:
// an input that only this check refuses.
//
// The product's gate must satisfy every case; if a check is removed (GateMutationTest), its case must fail.
//
// Thread-safety: the test's own thread.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tacto::test {

struct GateCase {
    int check;  ///< gate::Check, or limitCheck()
    std::string name;
    std::function<bool()> holds;  ///< true if the gate refused what it must, and permitted what it may
};

/// Adds cases of the interlock, the heartbeat, accepted levels and a train's read-back: InterlockCases.cpp.
void addInterlockCases(std::vector<GateCase>& cases);

/// Returns at least one case for every check of Rules.h.
[[nodiscard]] std::vector<GateCase> gateCases();

}  // namespace tacto::test
