// GateSequences.h - random command sequences against the gate, refereed by IndependentBody (hazard H1).
//
// A sequence is a handful of commands: configure, approve, deliver (perhaps late), stop, wait, impedance readings,
// acceptance, garbage. Whatever is delivered goes into a body with a true impedance somewhere in the permitted range;
// the referee holds the limits as numbers of its own.
//
// Thread-safety: the test's own thread.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace tacto::test {

/// What the referee found near its limit, by kind.
enum class Near { Command, Rms5s, Rms500, Power, PeakCurrent, Charge, NetCharge, Energy, Rms1s, Dc, Level, Count };

struct SequenceCount {
    std::uint64_t sequences = 0;
    std::uint64_t delivering = 0;  ///< at least one train was delivered
    std::uint64_t close = 0;       ///< something delivered came within 5 % of a limit
    std::uint64_t edges = 0;       ///< the most that the gate approves was delivered
    std::uint64_t trains = 0;
    std::uint64_t refused = 0;
    std::array<std::uint64_t, static_cast<std::size_t>(Near::Count)> near{};
    std::string violation;  ///< first one found, with its trace; empty when the gate held
};

/// Runs `count` sequences from `seed` and adds to `total`. Stops at the first violation.
void runSequences(std::uint64_t seed, std::uint64_t count, SequenceCount& total);

}  // namespace tacto::test
