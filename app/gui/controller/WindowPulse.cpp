#include "app/gui/controller/WindowPulse.h"

namespace tacto::gui {

WindowPulse::WindowPulse() {
    beat();
    connect(&timer_, &QTimer::timeout, this, &WindowPulse::beat);
    timer_.start(kBeat);
}

bool WindowPulse::runs() const noexcept {
    const Time::time_point seen{Time::duration(seen_.load(std::memory_order_acquire))};
    return Time::now() - seen < kHangs;
}

}  // namespace tacto::gui

#include "moc_WindowPulse.cpp"
