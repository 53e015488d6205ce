// MomentsBrowser.h - a text that scrolls and draws none of its lines in part, neither at its top nor at its end.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTextBrowser>

namespace tacto::gui {

class MomentsBrowser final : public QTextBrowser {
    Q_OBJECT
public:
    explicit MomentsBrowser(QWidget* parent);
    /// No more than it must have: the plot above it takes the room.
    [[nodiscard]] QSize sizeHint() const override { return {QTextBrowser::sizeHint().width(), minimumHeight()}; }
    /// What is drawn, in the viewport: it begins at the top of a line and ends at the bottom of one.
    [[nodiscard]] QRect whole() const;

protected:
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace tacto::gui
