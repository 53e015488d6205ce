// PromptPanel.h - shows a protocol's question to the operator inside the workspace, so that everything else, above all
// STOP, stays within reach.
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
    /// Shows the question until close(); an invalid answer is refused with a message below.
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
    std::uint64_t asked_ = 0;  // the number of the question shown
    QVBoxLayout* layout_;
    QWidget* body_ = nullptr;
    QWidget* first_ = nullptr;  // the widget that gets the focus
    TroubleLine* trouble_ = nullptr;
};

}  // namespace tacto::gui
