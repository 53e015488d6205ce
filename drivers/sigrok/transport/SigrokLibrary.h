// SigrokLibrary.h - libsigrok, started: the one context of the process, and what it complains about.
//
// There is one per process: libsigrok's drivers are process-wide variables, and ending a second context would clean up
// the devices of the first. It lives as long as it is held.
//
// libsigrok's calls throw, sigrok::Error for a code and Glib::Error besides; what escapes from one of its C callbacks
// would end the program. guarded() turns all of it into a Result.
//
// Thread-safety: get() any thread. The context's scans, opens and closes touch shared lists of drivers: hold calls()
// meanwhile. Sessions of different devices run at the same time, each on a thread of its own.
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

/// The errors that libsigrok logged on the calling thread; it logs on the thread that called it.
struct SigrokLog {
    unsigned errors = 0;  ///< errors since the thread began
    std::string last;     ///< the newest, without the prefix
};
[[nodiscard]] SigrokLog& sigrokLog() noexcept;

class SigrokLibrary {
public:
    /// Errors: Io where libsigrok does not start.
    [[nodiscard]] static Result<std::shared_ptr<SigrokLibrary>> get();

    [[nodiscard]] const std::shared_ptr<sigrok::Context>& context() const noexcept { return context_; }
    /// Held by one at a time; ends with it.
    class Turn {
    public:
        explicit Turn(SigrokLibrary& library) noexcept : library_(&library) {}
        ~Turn();
        Turn(Turn&& other) noexcept : library_(std::exchange(other.library_, nullptr)) {}
        Turn& operator=(Turn&&) = delete;

    private:
        SigrokLibrary* library_;
    };
    /// Errors: Timeout when another's turn has not ended for 5 s.
    [[nodiscard]] Result<Turn> calls();

private:
    explicit SigrokLibrary(std::shared_ptr<sigrok::Context> context) : context_(std::move(context)) {}

    // This is no timed mutex: the thread sanitizer does not know how the standard library locks one.
    std::mutex mutex_;
    std::condition_variable freed_;
    bool taken_ = false;  // guarded by mutex_
    const std::shared_ptr<sigrok::Context> context_;
};

/// The sentence for the exception that is being handled: `what` (or nothing), its text, and what libsigrok logged since
/// `before`.
[[nodiscard]] Error currentError(std::string_view what, unsigned before) noexcept;

/// Runs `call` and turns whatever it throws into an Error Device that begins with `what`.
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
