// DeviceWatch.h - checks which devices are connected, on a separate thread, so that a slow port never delays the
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
    /// Checks at once, then every `period`.
    DeviceWatch(std::function<Registry()> makeRegistry, std::chrono::milliseconds period, QObject* parent = nullptr);
    ~DeviceWatch() override;

    /// Returns the devices at the last check; empty before the first check is done.
    [[nodiscard]] const std::vector<DeviceIdentity>& devices() const noexcept { return devices_; }
    /// Checks again now.
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
    std::thread thread_;     // last: starts when all else is ready
};

}  // namespace tacto::gui
