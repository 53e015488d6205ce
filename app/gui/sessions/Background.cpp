#include "app/gui/sessions/Background.h"

#include <QPromise>
#include <utility>

namespace tacto::gui {

Background::Background(QObject* parent) : QObject(parent) {
    thread_.setMaxThreadCount(1);
    connect(&newest_, &QFutureWatcherBase::progressValueChanged, this, [this](int done) {
        if (newest_.progressMaximum() > 0) emit progressed(done, newest_.progressMaximum());
    });
    connect(&newest_, &QFutureWatcherBase::finished, this, [this] {
        const auto then = std::exchange(then_, nullptr);
        const auto result = newest_.result();  // copied before a slot may start other work
        emit busyChanged(false);
        then(result);
    });
}

Background::~Background() {
    cancel();
    thread_.waitForDone();
}

void Background::start(Work work, std::function<void(Result<void>)> then) {
    cancel();
    cancelled_ = std::make_shared<std::atomic<bool>>(false);
    then_ = std::move(then);
    const auto promise = std::make_shared<QPromise<Result<void>>>();
    promise->start();
    newest_.setFuture(promise->future());  // drops the previous result
    emit busyChanged(true);
    thread_.start([promise, work = std::move(work), cancelled = cancelled_] {
        promise->addResult(work({cancelled, [&](int done, int total) {
                                     promise->setProgressRange(0, total);
                                     promise->setProgressValue(done);
                                 }}));
        promise->finish();
    });
}

void Background::cancel() {
    if (cancelled_) cancelled_->store(true);
}

}  // namespace tacto::gui

#include "moc_Background.cpp"
