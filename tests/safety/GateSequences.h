// GateSequences.h - random command sequences against the gate, judged by a referee with IndependentBody (hazard H1).
//
// A sequence is a few commands: configure, approve, deliver (perhaps late), stop, wait, impedance readings, acceptance,
// garbage. Trains go into a body with a true impedance in the permitted range; the referee has its own limits.
//
// Thread-safety: the test's own thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace tacto::test {

/// The kinds of limit that a delivery came close to.
enum class Near { Command, Rms5s, Rms500, Power, PeakCurrent, Charge, NetCharge, Energy, Rms1s, Dc, Level, Count };

struct SequenceCount {
    std::uint64_t sequences = 0;
    std::uint64_t delivering = 0;  ///< sequences with at least one train delivered
    std::uint64_t close = 0;       ///< sequences in which a delivery came within 5 % of a limit
    std::uint64_t edges = 0;       ///< sequences in which the largest approved amplitude was delivered
    std::uint64_t trains = 0;
    std::uint64_t refused = 0;
    std::array<std::uint64_t, static_cast<std::size_t>(Near::Count)> near{};
    std::string violation;  ///< the first violation, with its trace; empty if there was none
};

/// Runs `count` sequences from `seed` and adds to `total`. Stops at the first violation.
void runSequences(std::uint64_t seed, std::uint64_t count, SequenceCount& total);

}  // namespace tacto::test
