// SideWork.h - work that the window does not wait for: one piece after the other on a thread of its own; each reports
// its end on the GUI thread.
//
// An owner that is the `context` of its work keeps it as a member: it is waited for before the owner is gone.
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

    /// `then` gets what `work` returns on the thread of `context`, unless that is gone by then.
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
    /// Drops the work that has not begun; its `then` is never called.
    void drop() { thread_.clear(); }

private:
    QThreadPool thread_;
};

}  // namespace tacto::gui
