// ParticipantStop.h - the participant's own STOP: calls `stop` the moment a press goes down on it, by mouse or finger.
#pragma once

#include <QAbstractButton>
#include <QPixmap>
#include <functional>
#include <tuple>

namespace tacto::gui {

class ParticipantStop final : public QAbstractButton {
    Q_OBJECT
public:
    ParticipantStop(std::function<void()> stop, QWidget* parent);
    /// Pixels of the word, which shrinks where there is no room, of the lines below it, and of those at the foot.
    void setType(int word_px, int lines_px);
    /// Buttons of a pad, or a pedal, that stop as the keys do: see ButtonLabels::stops.
    void setButtons(const QStringList& buttons);
    /// How many stops the participant has left before the session ends.
    void setLeft(int left);
    /// Makes it the operator's on the participant's screen, whose keys are the participant's.
    void setOperators();

protected:
    bool event(QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    /// All that the picture depends on: size, ratio of pixels, ground, and the words with their sizes.
    using Looks = std::tuple<QSize, double, QRgb, QString, int, int>;
    void press();
    void sayIt();
    [[nodiscard]] QPixmap draw(const QColor& ground) const;
    const std::function<void()> stop_;
    QString buttons_;
    int left_ = 3;
    bool operators_ = false;
    int word_px_ = 92;
    int lines_px_ = 20;
    QPixmap drawn_;  // kept for the same pixels in each paint: Qt does not always draw the edges of large letters alike
    Looks drawnFor_{};
};

}  // namespace tacto::gui
