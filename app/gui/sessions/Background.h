// Background.h - runs one long task on a thread, with progress and cancel; its end is signalled on the GUI thread.
//
// Thread-safety: the GUI thread; the work runs on a separate thread and must not touch widgets.
#pragma once

#include <QFutureWatcher>
#include <QObject>
#include <QThreadPool>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>

#include "core/base/Result.h"

namespace tacto::gui {

/// How running work learns that it was cancelled and reports its progress.
struct WorkPort {
    std::shared_ptr<std::atomic<bool>> cancelled;
    std::function<void(int done, int total)> progress;
    [[nodiscard]] bool stopped() const noexcept { return cancelled->load(std::memory_order_relaxed); }
};

class Background final : public QObject {
    Q_OBJECT
public:
    using Work = std::function<Result<void>(const WorkPort&)>;
    explicit Background(QObject* parent = nullptr);
    ~Background() override;  ///< cancels and waits
    /// Cancels earlier work and begins once that has ended, without making the caller wait. `then` gets the result,
    /// unless other work is started first.
    void start(Work work, std::function<void(Result<void>)> then);
    /// Runs work that produces a value: `then` gets Result<Value>.
    template <class Make, class Then>
    void take(Make make, Then then) {
        using Value = typename std::invoke_result_t<Make&, const WorkPort&>::value_type;
        const auto made = std::make_shared<std::optional<Value>>();
        start(
            [made, make = std::move(make)](const WorkPort& port) -> Result<void> {
                auto done = make(port);
                if (!done) return failure(done);
                made->emplace(std::move(*done));
                return {};
            },
            [made, then = std::move(then)](const Result<void>& done) {
                then(done ? Result<Value>(std::move(**made)) : Result<Value>(failure(done)));
            });
    }
    void cancel();
    [[nodiscard]] bool busy() const { return then_ != nullptr; }

signals:
    void progressed(int done, int total);
    void busyChanged(bool busy);

private:
    std::shared_ptr<std::atomic<bool>> cancelled_;
    std::function<void(Result<void>)> then_;
    QFutureWatcher<Result<void>> newest_;
    QThreadPool thread_;  // one thread, so that two exports into one folder never run at once
};

}  // namespace tacto::gui
