#include "core/exchange/lsl/LslClock.h"

#include <cmath>

namespace tacto {

Result<LslClock> LslClock::match(const LslLibrary& library, const Clock& session) {
    constexpr Instant kEnough = std::chrono::microseconds(20), kMaxWidth = std::chrono::microseconds(500);
    auto closest = Instant::max();
    double offset_s = 0;
    for (int i = 0; i < 1000 && closest > kEnough; ++i) {
        const auto before = session.now();
        const double theirs_s = library.localClock();
        const auto width = session.now() - before;
        if (!std::isfinite(theirs_s))
            return fail(ErrorCode::Unsupported, "the clock of {} says no number", library.file.string());
        if (width >= closest) continue;
        closest = width;
        offset_s = theirs_s - toSeconds(before + width / 2);
    }
    if (closest > kMaxWidth)
        return fail(ErrorCode::Timeout,
                    "the clock of LSL cannot be read within 0.5 ms on this computer now; with less to do it can");
    return LslClock(offset_s);
}

}  // namespace tacto
