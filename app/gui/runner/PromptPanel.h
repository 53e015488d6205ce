// PromptPanel.h - a protocol's question to the operator, in the workspace and not above it: everything else, STOP
// first, stays within reach.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QVBoxLayout>

#include "app/gui/desk/OperatorDesk.h"

namespace tacto::gui {

class PromptPanel final : public QFrame {
    Q_OBJECT
public:
    explicit PromptPanel(OperatorDesk& desk, QWidget* parent = nullptr);

private:
    void ask(const OperatorQuestion& question);
    void answer(const QString& text);
    OperatorDesk& desk_;
    QVBoxLayout* layout_;
    QWidget* body_ = nullptr;
    QLabel* trouble_ = nullptr;
};

}  // namespace tacto::gui
