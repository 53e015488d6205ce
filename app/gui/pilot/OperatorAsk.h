// OperatorAsk.h - what a pilot session asks the operator: a checklist item, a skin score, an electrode's lot.
//
// Amber at the left, like every question that a run waits for. Each button needs a press of its own: the second half of
// a double click answers nothing.
#pragma once

#include <QFrame>
#include <QVBoxLayout>

#include "core/pilot/Prompt.h"

namespace tacto::gui {

class OperatorAsk final : public QFrame {
    Q_OBJECT
public:
    explicit OperatorAsk(QWidget* parent = nullptr);
    void ask(const PilotPrompt& prompt, quint64 id);
    void close();
    [[nodiscard]] bool open() const { return body_ != nullptr; }
    /// Handles a button of the operator's pad: presses choice number `choice`, from 1, as a click would.
    void press(int choice);

signals:
    void answered(quint64 id, const tacto::PilotAnswer& answer);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void give(const PilotAnswer& answer);
    void addChoices(const PilotPrompt& prompt);
    void addSeveral(const PilotPrompt& prompt);
    void addLine(const PilotPrompt& prompt);
    QVBoxLayout* layout_;
    QWidget* body_ = nullptr;
    QVBoxLayout* column_ = nullptr;
    quint64 id_ = 0;
};

}  // namespace tacto::gui
