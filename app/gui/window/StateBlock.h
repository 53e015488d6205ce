// StateBlock.h - the interlock in word, shape and colour, to be read from two metres: the left end of the safety bar.
#pragma once

#include <QFrame>
#include <QLabel>

#include "app/gui/theme/Labels.h"
#include "core/safety/Interlock.h"

namespace tacto::gui {

class StateBlock final : public QFrame {
    Q_OBJECT

public:
    explicit StateBlock(QWidget* parent);
    /// `reason` may be empty. `pulse`: a train has just been delivered.
    void show(InterlockState state, const QString& reason, bool pulse);
    /// Takes the largest text at which the longest word needs at most `width` pixels; never below smallestWidth().
    void fit(int width);
    /// The width for the longest word at 28 pt, in pixels: above it the state makes room for what stands beside it.
    [[nodiscard]] int legibleWidth() const;
    /// The width for the longest word at 1.5 times the text's size, in pixels.
    [[nodiscard]] int smallestWidth() const;

private:
    [[nodiscard]] QFont wordFont(double scale) const;
    [[nodiscard]] int widthAt(double scale) const;
    void colour();
    void showShape(bool pulse);

    QLabel* shape_;
    QLabel* word_;
    ElidedLabel* reason_;
    QString shown_;  // the shape, its colour and size
    InterlockState state_ = InterlockState::Disconnected;
};

}  // namespace tacto::gui
