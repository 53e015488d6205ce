// SideWork.h - work for which the window does not wait: tasks run one after the other on a separate thread, and each
// reports its end on the GUI thread.
//
// An owner that is the `context` of its work keeps this as a member, so that its destructor waits for the work.
//
// Thread-safety: the GUI thread; the work itself must not touch widgets.
#pragma once

#include <QFuture>
#include <QObject>
#include <QPromise>
#include <QThreadPool>
#include <memory>
#include <type_traits>
#include <utility>

namespace tacto::gui {

class SideWork {
public:
    SideWork() { thread_.setMaxThreadCount(1); }
    ~SideWork() { thread_.waitForDone(); }
    SideWork(const SideWork&) = delete;
    SideWork& operator=(const SideWork&) = delete;

    /// `then` gets the result of `work` on the thread of `context`, unless `context` is gone by then.
    template <class Work, class Then>
    void start(QObject* context, Work work, Then then) {
        using Value = std::invoke_result_t<Work&>;
        const auto promise = std::make_shared<QPromise<Value>>();
        promise->start();
        promise->future().then(context, [then = std::move(then)](const Value& value) mutable { then(value); });
        thread_.start([promise, work = std::move(work)]() mutable {
            promise->addResult(work());
            promise->finish();
        });
    }
    template <class Work>
    void start(Work work) {
        thread_.start(std::move(work));
    }
    /// Drops tasks that have not begun; their `then` is never called.
    void drop() { thread_.clear(); }

private:
    QThreadPool thread_;
};

}  // namespace tacto::gui
