// ConfirmButton.h - the button of a second step: it takes a press of its own and nothing that was under way when it
// came (hazard H12).
//
// It is deaf for half a second after it is shown, so the second half of a double click does not press it, and it has no
// mnemonic, since a held Alt+letter repeats. Return presses it through StopKeys, which takes a held key for one press.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QElapsedTimer>
#include <QPushButton>

namespace tacto::gui {

class ConfirmButton final : public QPushButton {
    Q_OBJECT
public:
    static constexpr int kDeaf_ms = 500;
    explicit ConfirmButton(const QString& text, QWidget* parent = nullptr);
    /// Whether it has been shown for long enough to be meant.
    [[nodiscard]] bool listens() const;

protected:
    bool event(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;

private:
    QElapsedTimer shown_;
};

}  // namespace tacto::gui
