// DeviceWatch.h - what is plugged in, looked at from a thread of its own, so that a slow port never holds up the
// window.
#pragma once

#include <QObject>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "core/devices/Registry.h"

namespace tacto::gui {

class DeviceWatch final : public QObject {
    Q_OBJECT
public:
    /// Looks at once, then every `period`.
    DeviceWatch(std::function<Registry()> makeRegistry, std::chrono::milliseconds period, QObject* parent = nullptr);
    ~DeviceWatch() override;

    /// The devices at the last look; empty before the first look is over.
    [[nodiscard]] const std::vector<DeviceIdentity>& devices() const noexcept { return devices_; }
    /// Looks again now.
    void look();

signals:
    void changed();

private:
    void work(const std::function<Registry()>& makeRegistry, std::chrono::milliseconds period);

    std::vector<DeviceIdentity> devices_;
    std::mutex mutex_;
    std::condition_variable woken_;
    bool lookNow_ = false;   // guarded by mutex_
    bool quitting_ = false;  // guarded by mutex_
    std::thread thread_;     // Last: starts when all else is ready
};

}  // namespace tacto::gui
