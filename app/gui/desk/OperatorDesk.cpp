#include "app/gui/desk/OperatorDesk.h"

namespace tacto::gui {

void OperatorDesk::prepare(std::map<std::string, std::string> answers) {
    const std::scoped_lock lock(mutex_);
    prepared_ = std::move(answers);
    cancelled_ = false;
}

Result<nlohmann::json> OperatorDesk::ask(const OperatorQuestion& question) {
    std::unique_lock lock(mutex_);
    if (prepared_.contains(question.name)) return PresetOperator(prepared_).ask(question);
    open_ = question;
    answer_.reset();
    refused_ = false;
    emit asked(question);  // queued: the window lives on another thread
    changed_.wait(lock, [this] { return answer_ || refused_ || cancelled_; });
    open_.reset();
    emit closed();
    if (answer_) return *answer_;
    return fail(ErrorCode::Stopped, "\"{}\" was {}", question.text, refused_ ? "refused" : "not answered");
}

void OperatorDesk::cancel() noexcept {
    {
        const std::scoped_lock lock(mutex_);
        cancelled_ = true;
    }
    changed_.notify_all();
}

Result<void> OperatorDesk::answer(const std::string& text) {
    const std::scoped_lock lock(mutex_);
    if (!open_) return {};
    auto checked = PresetOperator(std::map<std::string, std::string>{{open_->name, text}}).ask(*open_);
    if (!checked) return failure(checked);
    answer_ = std::move(*checked);
    changed_.notify_all();
    return {};
}

void OperatorDesk::refuse() {
    const std::scoped_lock lock(mutex_);
    refused_ = true;
    changed_.notify_all();
}

}  // namespace tacto::gui
