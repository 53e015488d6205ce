// InputTime.h - when a key, a button or a finger went down, by the computer's steady clock.
//
// Qt hands on the window system's time of an event in milliseconds. X and Wayland on this computer take it from the
// same clock as steady_clock, so the way from the device to the window does not count into a response time. A time that
// is not within the last ten seconds is of another clock (a remote display, a test): then the moment of arrival counts.
//
// Thread-safety: pure functions.
#pragma once

#include <QInputEvent>
#include <chrono>

namespace tacto::gui {

using SteadyTime = std::chrono::steady_clock::time_point;

[[nodiscard]] SteadyTime timeOf(const QInputEvent& event);
/// `stamp_ms`: the event's; only its lowest 32 bits are looked at, as X has no more.
[[nodiscard]] SteadyTime timeOf(quint64 stamp_ms, SteadyTime arrival);

}  // namespace tacto::gui
