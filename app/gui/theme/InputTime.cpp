#include "app/gui/theme/InputTime.h"

namespace tacto::gui {

SteadyTime timeOf(quint64 stamp_ms, SteadyTime arrival) {
    using std::chrono::milliseconds;
    constexpr quint32 kSameClock_ms = 10'000;
    const auto now_ms = std::chrono::duration_cast<milliseconds>(arrival.time_since_epoch()).count();
    const auto age_ms = quint32(now_ms) - quint32(stamp_ms);  // both wrap round
    return age_ms <= kSameClock_ms ? arrival - milliseconds(age_ms) : arrival;
}

SteadyTime timeOf(const QInputEvent& event) { return timeOf(event.timestamp(), std::chrono::steady_clock::now()); }

}  // namespace tacto::gui
