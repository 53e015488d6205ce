// StopButton.h - STOP: calls `stop` the moment a press goes down on it, also while a menu or list is open.
//
// Qt gives every press to the open popup, which only closes. So the button looks at each press of the program before
// any widget does, and takes those that lie on it as its own.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QPushButton>
#include <functional>

namespace tacto::gui {

class StopButton final : public QPushButton {
    Q_OBJECT
public:
    StopButton(std::function<void()> stop, QWidget* parent);
    /// Room for the word and the keys: never cut.
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    const std::function<void()> stop_;
};

}  // namespace tacto::gui
