// SigrokLibrary.h - starts libsigrok and owns the process's only context; collects the errors that libsigrok logs.
//
// There is only one context per process, because libsigrok's drivers are process-wide variables: ending a second
// context would clean up the devices of the first. The context lives while a shared pointer holds it.
//
// libsigrok's calls throw sigrok::Error or Glib::Exception; an exception that escapes from one of its C callbacks would
// end the program. guarded() turns every exception into a Result.
//
// Thread-safety: get() any thread. Scans, opens and closes touch shared lists of drivers: hold calls() during them.
// Sessions of different devices may run at the same time, each on its own thread.
#pragma once

#include <condition_variable>
#include <exception>
#include <libsigrokcxx/libsigrokcxx.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/Result.h"

namespace tacto::sigrok_driver {

/// The errors that libsigrok logged on the calling thread, which is also the thread that called libsigrok.
struct SigrokLog {
    unsigned errors = 0;  ///< errors since the thread began
    std::string last;     ///< the newest error, without libsigrok's prefix
};
[[nodiscard]] SigrokLog& sigrokLog() noexcept;

class SigrokLibrary {
public:
    /// Errors: Io if libsigrok does not start.
    [[nodiscard]] static Result<std::shared_ptr<SigrokLibrary>> get();

    [[nodiscard]] const std::shared_ptr<sigrok::Context>& context() const noexcept { return context_; }
    /// The right to call libsigrok. Only one caller holds it at a time; destruction gives it back.
    class Turn {
    public:
        explicit Turn(SigrokLibrary& library) noexcept : library_(&library) {}
        ~Turn();
        Turn(Turn&& other) noexcept : library_(std::exchange(other.library_, nullptr)) {}
        Turn& operator=(Turn&&) = delete;

    private:
        SigrokLibrary* library_;
    };
    /// Errors: Timeout if another caller's turn has not ended after 5 s.
    [[nodiscard]] Result<Turn> calls();

private:
    explicit SigrokLibrary(std::shared_ptr<sigrok::Context> context) : context_(std::move(context)) {}

    // Not a timed mutex, because the thread sanitizer does not know how the standard library locks one.
    std::mutex mutex_;
    std::condition_variable freed_;
    bool taken_ = false;  // guarded by mutex_
    const std::shared_ptr<sigrok::Context> context_;
};

/// Describes the exception that is being handled: `what` (if not empty), the exception's text, and the errors that
/// libsigrok logged since `before`.
[[nodiscard]] Error currentError(std::string_view what, unsigned before) noexcept;

/// Runs `call` and turns any exception into an Error of code Device that begins with `what`.
template <class Call>
[[nodiscard]] auto guarded(std::string_view what, Call&& call) noexcept -> Result<std::invoke_result_t<Call>> {
    const unsigned before = sigrokLog().errors;
    try {
        if constexpr (std::is_void_v<std::invoke_result_t<Call>>) {
            call();
            return {};
        } else {
            return call();
        }
    } catch (...) {
        return tl::unexpected<Error>(currentError(what, before));
    }
}

}  // namespace tacto::sigrok_driver
