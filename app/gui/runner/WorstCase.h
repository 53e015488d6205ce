// WorstCase.h - what the strongest command of a profile would do, before anything is armed: every limit with the value
// it would be held against, worst case over 80 to 120 % of the declared load.
//
// Thread-safety: pure.
#pragma once

#include <QString>
#include <vector>

#include "core/bench/Profile.h"
#include "core/safety/TrainExposure.h"

namespace tacto::gui {

struct WorstCase {
    std::vector<ExposureRow> rows;
    QString refused;  ///< the limit that would be broken, in words; empty when none is
};

/// The preview (core/bench/arming/CommandPreview.h) of the profile's largest amplitude at its shortest interval.
/// Errors: as parseLoad() and previewOf().
[[nodiscard]] Result<WorstCase> worstCase(const Profile& profile, const std::vector<LimitSet>& limits,
                                          const std::string& load);

}  // namespace tacto::gui
