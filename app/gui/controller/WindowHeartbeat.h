// WindowHeartbeat.h - whether the window's thread still runs: one that hangs shows no STOP and hears no Esc, so what
// it ordered is then unattended (hazard H2).
//
// Thread-safety: made on the window's thread; runs() any thread.
#pragma once

#include <QObject>
#include <QTimer>
#include <atomic>
#include <chrono>

namespace tacto::gui {

class WindowHeartbeat final : public QObject {
    Q_OBJECT
public:
    static constexpr std::chrono::milliseconds kBeat{100};
    static constexpr std::chrono::milliseconds kHangs{1000};  ///< without a beat for that long
    WindowHeartbeat();
    [[nodiscard]] bool runs() const noexcept;

private:
    using Time = std::chrono::steady_clock;
    void beat() noexcept { seen_.store(Time::now().time_since_epoch().count(), std::memory_order_release); }
    QTimer timer_;
    std::atomic<Time::rep> seen_{0};
};

}  // namespace tacto::gui
