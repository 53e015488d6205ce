// GateCases.h - one directed case per check of the gate, the interlock, the heartbeat and the train's read-back:
// something that this check alone refuses.
//
// The product's gate must hold every case; with a check taken away (GateMutationTest) its case must fail.
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
    std::function<bool()> holds;  ///< true when the gate refused as it must, and permitted what it may
};

/// Cases of the interlock, the heartbeat, accepted levels and what a train reads back: InterlockCases.cpp.
void addInterlockCases(std::vector<GateCase>& cases);

/// Every check of Rules.h, at least once.
[[nodiscard]] std::vector<GateCase> gateCases();

}  // namespace tacto::test
