#include "core/base/ProgramVersion.h"

namespace tacto {

// Weak: the programs have a definition of their own that changes with each commit, and only they are linked again.
[[gnu::weak]] const ProgramVersion& programVersion() noexcept {
    static constexpr ProgramVersion release{TACTOSCOPE_VERSION, "unknown", "", false, "", {}};
    return release;
}

}  // namespace tacto
