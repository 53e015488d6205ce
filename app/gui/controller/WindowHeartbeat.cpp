#include "app/gui/controller/WindowHeartbeat.h"

namespace tacto::gui {

WindowHeartbeat::WindowHeartbeat() {
    beat();
    connect(&timer_, &QTimer::timeout, this, &WindowHeartbeat::beat);
    timer_.start(kBeat);
}

bool WindowHeartbeat::runs() const noexcept {
    const Time::time_point seen{Time::duration(seen_.load(std::memory_order_acquire))};
    return Time::now() - seen < kHangs;
}

}  // namespace tacto::gui

#include "moc_WindowHeartbeat.cpp"
