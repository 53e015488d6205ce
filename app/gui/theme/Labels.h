// Labels.h - labels that adapt to their room: a line that is shortened, a warning line, and text over a progress bar.
#pragma once

#include <QLabel>
#include <QProgressBar>

namespace tacto::gui {

/// One line of text that is shortened with "…" if the room is too small, and empty if only a few letters fit. Asks for
/// no width by itself. The owner should put the whole text into the tool tip.
class ElidedLabel final : public QLabel {
public:
    using QLabel::QLabel;
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }
    /// The text as it is drawn.
    [[nodiscard]] QString shownText() const;

protected:
    void paintEvent(QPaintEvent* event) override;
};

/// "⚠ " and the reason why something cannot be done, in amber, below the thing concerned; hidden while all is well.
class TroubleLine final : public QLabel {
public:
    /// `name`: the object name.
    TroubleLine(const QString& name, QWidget* parent);
    /// Shows the reason; an empty text hides the line.
    void say(const QString& why);
};

/// A progress bar with text that is readable over its filled and its empty part.
class ProgressBar final : public QProgressBar {
public:
    using QProgressBar::QProgressBar;

protected:
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace tacto::gui
