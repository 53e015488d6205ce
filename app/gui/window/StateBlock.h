// StateBlock.h - the left end of the safety bar: the interlock's state in word, shape and colour, large enough for 2 m.
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
    /// Takes the largest text whose longest word fits into `width` pixels; never narrower than smallestWidth().
    void fit(int width);
    /// Width in pixels of the longest word at 28 pt; a wider block gives way to its neighbours.
    [[nodiscard]] int legibleWidth() const;
    /// Width in pixels of the longest word at 1.5 times the text size.
    [[nodiscard]] int smallestWidth() const;

private:
    [[nodiscard]] QFont wordFont(double scale) const;
    [[nodiscard]] int widthAt(double scale) const;
    void colour();
    void showShape(bool pulse);

    QLabel* shape_;
    QLabel* word_;
    ElidedLabel* reason_;
    QString shown_;  // the shape with its colour and size
    InterlockState state_ = InterlockState::Disconnected;
};

}  // namespace tacto::gui
