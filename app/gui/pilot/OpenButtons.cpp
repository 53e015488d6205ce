#include "app/gui/pilot/OpenButtons.h"

namespace tacto::gui {

OpenButtons::OpenButtons(QObject* parent) : QObject(parent) {}

OpenButtons::~OpenButtons() { close(); }

void OpenButtons::setDevices(std::shared_ptr<const ButtonDevices> devices) {
    close();
    devices_ = std::move(devices);
}

bool OpenButtons::isOpen(const std::string& identity, quint64 number) const {
    const auto found = open_.find(identity);
    return found != open_.end() && found->second.number == number;
}

Result<void> OpenButtons::open(const ButtonDeviceInfo& info, const ButtonListener& atOnce) {
    if (open_.contains(info.identity)) return {};
    if (!devices_) return fail(ErrorCode::NotFound, "{} ({}) is not plugged in any more.", info.name, info.identity);
    const auto number = ++number_;
    // On the device's thread: what it says is handed over, and never waited for.
    ButtonListener listener;
    listener.moved = [this, number, identity = info.identity, first = atOnce.moved](const ButtonPress& press) {
        if (first) first(press);
        QMetaObject::invokeMethod(
            this,
            [this, number, identity, press] {
                if (isOpen(identity, number)) emit moved(identity, press.button, press.down, press.at);
            },
            Qt::QueuedConnection);
    };
    listener.plugged = [this, number, identity = info.identity, first = atOnce.plugged](bool there) {
        if (first) first(there);
        QMetaObject::invokeMethod(
            this,
            [this, number, identity, there] {
                if (isOpen(identity, number)) emit plugged(identity, there);
            },
            Qt::QueuedConnection);
    };
    auto opened = devices_->open(info, std::move(listener));
    if (!opened) return failure(opened);
    open_[info.identity] = {number, std::move(*opened)};
    return {};
}

void OpenButtons::close() { open_.clear(); }

void OpenButtons::close(const std::string& identity) { open_.erase(identity); }

}  // namespace tacto::gui

#include "moc_OpenButtons.cpp"
