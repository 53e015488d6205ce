// SigrokLibrary.h - libsigrok, started: the one context of the process, and what it complains about.
//
// One per process, whoever asks: libsigrok's drivers are process-wide variables, and ending a second context would
// clean up the devices of the first. It lives as long as somebody holds it.
//
// libsigrok's calls throw, sigrok::Error for a code and Glib::Error besides; what escapes from one of its C callbacks
// would end the program. guarded() turns all of it into a Result.
//
// Thread-safety: get() any thread. The context's scans, opens and closes touch shared lists of drivers: hold calls()
// meanwhile. Sessions of different devices run at the same time, each on a thread of its own.
#pragma once

#include <exception>
#include <libsigrokcxx/libsigrokcxx.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>

#include "core/base/Result.h"

namespace tacto::sigrok_driver {

/// What libsigrok logged as errors on the calling thread; it logs on the thread that called it.
struct SigrokLog {
    unsigned errors = 0;  ///< since the thread began
    std::string last;     ///< the newest, without the prefix
};
[[nodiscard]] SigrokLog& sigrokLog() noexcept;

class SigrokLibrary {
public:
    /// Errors: Io where libsigrok does not start.
    [[nodiscard]] static Result<std::shared_ptr<SigrokLibrary>> get();

    [[nodiscard]] const std::shared_ptr<sigrok::Context>& context() const noexcept { return context_; }
    /// Errors: Timeout when another call has not come back for 5 s.
    [[nodiscard]] Result<std::unique_lock<std::timed_mutex>> calls();

private:
    explicit SigrokLibrary(std::shared_ptr<sigrok::Context> context) : context_(std::move(context)) {}

    std::timed_mutex calls_;
    const std::shared_ptr<sigrok::Context> context_;
};

/// The sentence for the exception that is being handled: `what`, its text, and what libsigrok logged since `before`.
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
