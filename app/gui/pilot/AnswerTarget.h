// AnswerTarget.h - one answer on the participant's screen: large, with its key and, in a circle, the button of a pad,
// taken the moment a press goes down on it, by mouse or finger.
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
    /// Words below their icons, or to the right of them.
    enum class Shape { Stacked, Row };
    explicit AnswerTarget(QWidget* parent);
    /// `key` and `button` may be empty. setType() sets the sizes.
    void setContent(const QString& words, const QStringList& icons, const QString& key, const QString& button,
                    Shape shape);
    [[nodiscard]] const QString& button() const { return button_; }
    /// Pixels of the words and of the key; words shrink where the target is too narrow for them.
    void setType(int words_px, int key_px);
    /// The largest pixels of the words for which it has room, setType()'s at most.
    [[nodiscard]] int fittingPx() const;
    /// Until the next setType() words are no larger than this: the smallest of the targets that stand beside each
    /// other.
    void limitWords(int px);
    [[nodiscard]] int wordsPx() const { return std::min(fittingPx(), most_px_); }
    /// The smallest size that the words may get.
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
    /// The words' size where lines are as long as `room`.
    [[nodiscard]] QSize wrapped(const QFontMetrics& metrics, int room) const;
    QStringList icons_;
    QString key_, button_;
    Shape shape_ = Shape::Stacked;
    int words_px_ = 28;
    int most_px_ = 28;
    int key_px_ = 20;
};

}  // namespace tacto::gui
