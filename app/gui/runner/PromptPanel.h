// PromptPanel.h - a protocol's question to the operator, in the workspace and not above it: everything else, STOP
// first, stays within reach.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QVBoxLayout>

#include "app/gui/controller/WindowOperator.h"
#include "app/gui/theme/Labels.h"

namespace tacto::gui {

class PromptPanel final : public QFrame {
    Q_OBJECT
public:
    explicit PromptPanel(WindowOperator& controller, QWidget* parent = nullptr);
    /// Shows the question until close(); an answer that does not fit is refused below it.
    void ask(const OperatorQuestion& question);
    void close();
    [[nodiscard]] bool open() const { return body_ != nullptr; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    [[nodiscard]] QWidget* buildDrawing(const OperatorQuestion& question);
    [[nodiscard]] QWidget* buildChoices(const OperatorQuestion& question);
    [[nodiscard]] QWidget* buildEntry(const OperatorQuestion& question);
    void answer(const QString& text);
    WindowOperator& controller_;
    std::uint64_t asked_ = 0;  // the question that is shown
    QVBoxLayout* layout_;
    QWidget* body_ = nullptr;
    QWidget* first_ = nullptr;  // takes the focus
    TroubleLine* trouble_ = nullptr;
};

}  // namespace tacto::gui
