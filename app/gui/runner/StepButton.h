// StepButton.h - one step of a procedure: the shape of its state, its name, and a word on how it stands.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QAbstractButton>

#include "app/gui/runner/StepList.h"

namespace tacto::gui {

class StepButton final : public QAbstractButton {
    Q_OBJECT
public:
    enum class Place { First, Between, Last };
    StepButton(const QString& name, Place place, QWidget* parent);
    void setState(StepList::State state);
    [[nodiscard]] StepList::State state() const { return state_; }
    void setNote(const QString& note);
    void setOutOfReach(const QString& why);
    /// Without the note, where the window is low.
    void setLow(bool low);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void say();
    void paintShape(QPainter& painter, const QPoint& centre) const;
    StepList::State state_ = StepList::State::ToDo;
    QString note_;
    QString outOfReach_;
    const Place place_;
    bool low_ = false;
};

}  // namespace tacto::gui
