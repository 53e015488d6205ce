#include "app/gui/sessions/Background.h"

#include <QMetaObject>
#include <QPointer>

namespace tacto::gui {

Background::~Background() { join(); }

void Background::join() {
    cancel();
    if (thread_.joinable()) thread_.join();
}

void Background::start(Work work, std::function<void(Result<void>)> then) {
    cancel();
    cancelled_ = std::make_shared<std::atomic<bool>>(false);
    const int number = ++number_;
    busy_ = true;
    emit busyChanged(true);
    // The thread waits for the one before it, the window does not: two exports into one folder never meet.
    thread_ = std::thread([this, number, work = std::move(work), then = std::move(then), cancelled = cancelled_,
                           before = std::move(thread_)]() mutable {
        if (before.joinable()) before.join();
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
