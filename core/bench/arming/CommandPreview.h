// CommandPreview.h - how the gate would judge a command, before a bench is open: the same in the window and in the
// terminal.
//
// The train goes to an ideal voltage source (any amplitude up to 500 V, any width, no gap of its own) into a declared
// load, ± 20 %, on the bench.
//
// Thread-safety: pure.
#pragma once

#include <optional>
#include <vector>

#include "core/bench/Profile.h"
#include "core/encoding/Encoder.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

struct CommandPreview {
    Ohms impedance{0};              ///< of the load at the end of the leading phase
    std::vector<ExposureRow> rows;  ///< exposureTable() of the train
    std::optional<Error> refusal;   ///< the gate's; nothing where it approves
};

/// Errors: as validate() of an encoding and SafetyGate::configure().
[[nodiscard]] Result<CommandPreview> previewOf(const Command& command, const Profile& profile,
                                               const std::vector<LimitSet>& limits, const Load& load);

}  // namespace tacto
