#include "app/gui/sessions/Background.h"

#include <QMetaObject>
#include <QPointer>

namespace tacto::gui {

Background::~Background() { join(); }

void Background::join() {
    if (cancelled_) cancelled_->store(true);
    if (thread_.joinable()) thread_.join();
}

void Background::start(Work work, std::function<void(Result<void>)> then) {
    join();
    cancelled_ = std::make_shared<std::atomic<bool>>(false);
    const int number = ++number_;
    busy_ = true;
    emit busyChanged(true);
    thread_ = std::thread([this, number, work = std::move(work), then = std::move(then), cancelled = cancelled_] {
        WorkPort port{cancelled, [this](int done, int total) {
                          QMetaObject::invokeMethod(
                              this, [this, done, total] { emit progressed(done, total); }, Qt::QueuedConnection);
                      }};
        auto result = work(port);
        QMetaObject::invokeMethod(
            this,
            [this, number, then, result = std::move(result)] {
                if (number != number_) return;
                busy_ = false;
                emit busyChanged(false);
                then(result);
            },
            Qt::QueuedConnection);
    });
}

void Background::cancel() {
    if (cancelled_) cancelled_->store(true);
}

}  // namespace tacto::gui
