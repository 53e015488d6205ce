// ParticipantStop.h - the participant's own STOP button: calls `stop` when a press by mouse or finger goes down.
#pragma once

#include <QAbstractButton>
#include <QPixmap>
#include <functional>
#include <tuple>

#include "core/pilot/ParticipantWords.h"

namespace tacto::gui {

class ParticipantStop final : public QAbstractButton {
    Q_OBJECT
public:
    ParticipantStop(std::function<void()> stop, QWidget* parent);
    void setWords(const ParticipantWords& words);
    /// Sets the sizes in pixels of the word STOP, which shrinks if space is short, and of all lines below it.
    void setType(int word_px, int lines_px);
    /// Sets the pad buttons or the pedal that stop as the keys do: see ButtonLabels::stops.
    void setButtons(const QStringList& buttons);
    /// Sets how many stops the participant has left before the session ends.
    void setLeft(int left);
    /// Makes this the operator's STOP on the participant's screen; the stop keys there stay the participant's.
    void setOperators();

protected:
    bool event(QEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

private:
    /// Everything the picture depends on: size, pixel ratio, background, and the words with their sizes.
    using Looks = std::tuple<QSize, double, QRgb, QStringList, int, int>;
    void press();
    void sayIt();
    [[nodiscard]] QPixmap draw(const QColor& ground) const;
    const std::function<void()> stop_;
    [[nodiscard]] QString word(std::string_view key) const;
    /// Returns the buttons that stop, "button 5 or 6"; empty without any.
    [[nodiscard]] QString buttonWords() const;
    [[nodiscard]] QString leftWords() const;
    ParticipantWords words_ = ParticipantWords::english();
    QStringList buttons_;
    int left_ = 3;
    bool operators_ = false;
    int word_px_ = 92;
    int lines_px_ = 20;
    QPixmap drawn_;  // kept so that each paint is the same: Qt does not always draw the edges of large letters alike
    Looks drawnFor_{};
};

}  // namespace tacto::gui
