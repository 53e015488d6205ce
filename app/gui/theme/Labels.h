// Labels.h - words that suit their room: a line that elides, what is in the way, and words over a progress bar.
#pragma once

#include <QLabel>
#include <QProgressBar>

namespace tacto::gui {

/// One line of text that ends in "…" where there is no room for all of it, is empty where there is room for a few
/// letters alone, and asks for no room by itself. The whole text belongs into the tool tip, which the owner sets.
class ElidedLabel final : public QLabel {
public:
    using QLabel::QLabel;
    [[nodiscard]] QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }
    /// The text as it is drawn.
    [[nodiscard]] QString shownText() const;

protected:
    void paintEvent(QPaintEvent* event) override;
};

/// "⚠ " and why something cannot be done, in amber, below what it is about; not there while all is well.
class TroubleLine final : public QLabel {
public:
    /// `name` as object name.
    TroubleLine(const QString& name, QWidget* parent);
    /// An empty text: all is well.
    void say(const QString& why);
};

/// A progress bar whose words can be read over both its filled and its empty part.
class ProgressBar final : public QProgressBar {
public:
    using QProgressBar::QProgressBar;

protected:
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace tacto::gui
