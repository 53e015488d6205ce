// ElidedLabel.h - one line of text that ends in "…" where there is no room for all of it, is empty where there is room
// for a few letters alone, and asks for no room by itself. The whole text belongs into the tool tip, which the owner
// sets.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>

namespace tacto::gui {

class ElidedLabel final : public QLabel {
public:
    using QLabel::QLabel;
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }
    /// As it is drawn.
    [[nodiscard]] QString shownText() const;

protected:
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace tacto::gui
