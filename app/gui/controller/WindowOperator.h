// WindowOperator.h - shows a protocol's questions to the operator in the window.
//
// Thread-safety: ask() on the script's thread; cancel() any thread; answer(), refuse() and the signals on the GUI
// thread.
#pragma once

#include <QObject>
#include <condition_variable>
#include <mutex>

#include "app/scripting/engine/Operator.h"

namespace tacto::gui {

class WindowOperator final : public QObject, public Operator {
    Q_OBJECT
public:
    [[nodiscard]] Seconds unwatchedFor() const override { return Seconds(2); }
    /// Sets answers given in advance, by name; they are used before the operator is asked.
    void prepare(std::map<std::string, std::string> answers);
    [[nodiscard]] Result<nlohmann::json> ask(const OperatorQuestion& question) override;
    void cancel() noexcept override;

    /// Answers question `id` after checking the text; does nothing if that question is no longer open. Errors:
    /// InvalidArgument: the question stays open.
    [[nodiscard]] Result<void> answer(std::uint64_t id, const std::string& text);
    void refuse();

signals:
    void asked(const tacto::OperatorQuestion& question);
    void closed();  ///< answered, refused or cancelled

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, std::string> prepared_;  // guarded
    std::optional<OperatorQuestion> open_;         // guarded
    std::optional<nlohmann::json> answer_;         // guarded
    std::uint64_t lastId_ = 0;                     // guarded
    bool refused_ = false;                         // guarded
    bool cancelled_ = false;                       // guarded
};

}  // namespace tacto::gui

Q_DECLARE_METATYPE(tacto::OperatorQuestion)
