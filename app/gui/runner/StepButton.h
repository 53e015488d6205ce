// StepButton.h - one step of a procedure: a shape for its state, its name, and a short note. In a row the step has a
// number, and its name if there is room.
#pragma once

#include <QAbstractButton>

#include "app/gui/runner/StepList.h"

namespace tacto::gui {

class StepButton final : public QAbstractButton {
    Q_OBJECT
public:
    enum class Place { First, Between, Last };
    /// `number`: counted from 1.
    StepButton(const QString& name, int number, Place place, QWidget* parent);
    void setName(const QString& name);
    void setNumber(int number);
    [[nodiscard]] int number() const { return number_; }
    void setState(StepList::State state);
    [[nodiscard]] StepList::State state() const { return state_; }
    void setNote(const QString& note);
    void setOutOfReach(const QString& why);
    /// Leaves out the note if the window is low.
    void setLow(bool low);
    /// Sets whether steps are side by side instead of stacked; `named`: the button shows its name.
    void setAcross(bool across, bool named);
    /// Returns the width in a row, with the name or with the shape alone.
    [[nodiscard]] int widthAcross(bool named) const;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void say();
    void paintGround(QPainter& painter) const;
    void paintDown(QPainter& painter) const;
    void paintAcross(QPainter& painter) const;
    void paintShape(QPainter& painter, const QPoint& centre) const;
    StepList::State state_ = StepList::State::ToDo;
    QString note_;
    QString outOfReach_;
    int number_;
    const Place place_;
    bool low_ = false;
    bool across_ = false;
    bool named_ = true;
};

}  // namespace tacto::gui
