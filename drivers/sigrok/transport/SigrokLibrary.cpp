#include "drivers/sigrok/transport/SigrokLibrary.h"

#include <chrono>

namespace tacto::sigrok_driver {

SigrokLog& sigrokLog() noexcept {
    thread_local SigrokLog log;
    return log;
}

Result<std::shared_ptr<SigrokLibrary>> SigrokLibrary::get() {
    static std::mutex mutex;
    static std::weak_ptr<SigrokLibrary> running;
    const std::scoped_lock lock(mutex);
    if (auto library = running.lock()) return library;
    auto context = guarded("libsigrok does not start", [] {
        Glib::init();
        auto created = sigrok::Context::create();
        created->set_log_level(sigrok::LogLevel::WARN);
        created->set_log_callback([](const sigrok::LogLevel* level, std::string message) {
            if (level == nullptr || level->id() > SR_LOG_ERR) return;
            SigrokLog& log = sigrokLog();
            ++log.errors;
            log.last = std::move(message);
        });
        return created;
    });
    if (!context) return fail(ErrorCode::Io, "{}", context.error().message);
    std::shared_ptr<SigrokLibrary> library(new SigrokLibrary(std::move(*context)));
    running = library;
    return library;
}

Result<SigrokLibrary::Turn> SigrokLibrary::calls() {
    std::unique_lock lock(mutex_);
    if (!freed_.wait_for(lock, std::chrono::seconds(5), [&] { return !taken_; })) {
        return fail(ErrorCode::Timeout, "libsigrok has been busy with another instrument for 5 s; try again");
    }
    taken_ = true;
    return Turn(*this);
}

SigrokLibrary::Turn::~Turn() {
    if (library_ == nullptr) return;
    const std::scoped_lock lock(library_->mutex_);
    library_->taken_ = false;
    library_->freed_.notify_one();
}

Error currentError(std::string_view what, unsigned before) noexcept {
    std::string text;
    try {
        throw;
    } catch (const Glib::Exception& error) {  // in this version of glibmm not derived from std::exception
        text = error.what();
    } catch (const std::exception& error) {
        text = error.what();
    } catch (...) {
        text = "an unknown exception";
    }
    const SigrokLog& log = sigrokLog();
    if (log.errors != before) text += " (" + log.last + ")";
    return {ErrorCode::Device, what.empty() ? text : fmt::format("{}: {}", what, text)};
}

}  // namespace tacto::sigrok_driver
