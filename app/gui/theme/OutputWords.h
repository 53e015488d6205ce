// OutputWords.h - what the end of something leaves of the output, behind the sentence that says why it ended.
//
// Thread-safety: pure.
#pragma once

#include "app/gui/theme/Text.h"
#include "core/safety/Interlock.h"

namespace tacto::gui {

/// Whether `why` says that the device does not obey.
[[nodiscard]] inline bool saysMayBeOn(const QString& why) {
    return why.contains(qtext(outputAfter(FaultCause::StuckOn)));
}
/// `why`, and `off` behind it, unless it says that or that the output may still be on.
[[nodiscard]] inline QString withOutput(const QString& why, const QString& off) {
    return saysMayBeOn(why) || why.contains(off) ? why : why + ' ' + off;
}

}  // namespace tacto::gui
