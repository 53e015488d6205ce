#include "app/gui/controller/DeviceWatch.h"

namespace tacto::gui {

DeviceWatch::DeviceWatch(std::function<Registry()> makeRegistry, std::chrono::milliseconds period, QObject* parent)
    : QObject(parent), thread_([this, make = std::move(makeRegistry), period] { work(make, period); }) {}

DeviceWatch::~DeviceWatch() {
    {
        const std::scoped_lock lock(mutex_);
        quitting_ = true;
    }
    woken_.notify_all();
    thread_.join();
}

void DeviceWatch::look() {
    {
        const std::scoped_lock lock(mutex_);
        lookNow_ = true;
    }
    woken_.notify_all();
}

void DeviceWatch::work(const std::function<Registry()>& makeRegistry, std::chrono::milliseconds period) {
    const auto registry = makeRegistry();
    std::optional<std::vector<DeviceIdentity>> last;
    for (;;) {
        auto present = registry.list();
        if (last != present) {
            last = present;
            QMetaObject::invokeMethod(
                this,
                [this, found = std::move(present)]() mutable {
                    devices_ = std::move(found);
                    emit changed();
                },
                Qt::QueuedConnection);
        }
        std::unique_lock lock(mutex_);
        woken_.wait_for(lock, period, [this] { return quitting_ || lookNow_; });
        if (quitting_) return;
        lookNow_ = false;
    }
}

}  // namespace tacto::gui

#include "moc_DeviceWatch.cpp"
