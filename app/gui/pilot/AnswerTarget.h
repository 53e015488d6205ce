// AnswerTarget.h - one large answer on the participant's screen, with its key and, in a circle, its game-pad button. A
// press by mouse or finger answers when it goes down. A target that is chosen or held is filled and has a thicker edge:
// setDown() shows that it is held, whatever holds it.
#pragma once

#include <QAbstractButton>
#include <QFontMetrics>
#include <QStringList>
#include <algorithm>

#include "app/gui/theme/ConfirmButton.h"

class QPainter;

namespace tacto::gui {

class AnswerTarget final : public QAbstractButton {
    Q_OBJECT
public:
    /// Stacked: words below their icons. Row: words to the right of their icons.
    enum class Shape { Stacked, Row };
    explicit AnswerTarget(QWidget* parent);
    /// `key` and `button` may be empty. setType() sets the sizes.
    void setContent(const QString& words, const QStringList& icons, const QString& key, const QString& button,
                    Shape shape);
    [[nodiscard]] const QString& button() const { return button_; }
    /// Sets the size in pixels of the words and of the key; words shrink if the target is too narrow.
    void setType(int words_px, int key_px);
    /// Returns the largest word size in pixels that fits, at most the size given to setType().
    [[nodiscard]] int fittingPx() const;
    /// Limits the word size until the next setType(), so that neighbouring targets all use their smallest size.
    void limitWords(int px);
    [[nodiscard]] int wordsPx() const { return std::min(fittingPx(), most_px_); }
    /// Returns the size needed for the smallest words.
    [[nodiscard]] QSize minimumSizeHint() const override;
    [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }

signals:
    void wentDown(tacto::gui::SteadyTime at);
    void cameUp();

protected:
    bool event(QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override { event->ignore(); }
    void keyReleaseEvent(QKeyEvent* event) override { event->ignore(); }
    void paintEvent(QPaintEvent* event) override;

private:
    [[nodiscard]] QFont wordFont(int px) const;
    [[nodiscard]] int keyPx() const;
    [[nodiscard]] int capWide(const QString& of) const;
    [[nodiscard]] int capsWide() const;
    void paintCaps(QPainter& painter) const;
    [[nodiscard]] int leastPx() const;
    /// Returns the size of the words when wrapped to lines of width `room`.
    [[nodiscard]] QSize wrapped(const QFontMetrics& metrics, int room) const;
    QStringList icons_;
    QString key_, button_;
    Shape shape_ = Shape::Stacked;
    int words_px_ = 28;
    int most_px_ = 28;
    int key_px_ = 20;
};

}  // namespace tacto::gui
