#include "app/gui/controller/WindowOperator.h"

namespace tacto::gui {

void WindowOperator::prepare(std::map<std::string, std::string> answers) {
    const std::scoped_lock lock(mutex_);
    prepared_ = std::move(answers);
    cancelled_ = false;
}

Result<nlohmann::json> WindowOperator::ask(const OperatorQuestion& question) {
    std::unique_lock lock(mutex_);
    if (prepared_.contains(question.name)) return PresetOperator(prepared_).ask(question);
    open_ = question;
    open_->id = ++lastId_;
    answer_.reset();
    refused_ = false;
    emit asked(*open_);  // queued: the window runs on another thread
    const auto ended = [this] { return answer_ || refused_ || cancelled_; };
    constexpr std::chrono::milliseconds kPollInterval{100};
    while (!changed_.wait_for(lock, kPollInterval, ended)) {
        if (present) present();
    }
    open_.reset();
    emit closed();
    if (answer_) return *answer_;
    return fail(ErrorCode::Stopped, "\"{}\" was {}", question.text, refused_ ? "refused" : "not answered");
}

void WindowOperator::cancel() noexcept {
    {
        const std::scoped_lock lock(mutex_);
        cancelled_ = true;
    }
    changed_.notify_all();
}

Result<void> WindowOperator::answer(std::uint64_t id, const std::string& text) {
    const std::scoped_lock lock(mutex_);
    if (!open_ || open_->id != id || answer_) return {};
    auto checked = PresetOperator(std::map<std::string, std::string>{{open_->name, text}}).ask(*open_);
    if (!checked) return failure(checked);
    answer_ = std::move(*checked);
    changed_.notify_all();
    return {};
}

void WindowOperator::refuse() {
    const std::scoped_lock lock(mutex_);
    refused_ = true;
    changed_.notify_all();
}

}  // namespace tacto::gui

#include "moc_WindowOperator.cpp"
