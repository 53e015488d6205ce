// StepList.h - a procedure is a path: its steps below each other, each to do, under way, done or ended early by its
// shape, with a word on how it stands. A click goes to a step that was reached.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>
#include <QWidget>
#include <vector>

namespace tacto::gui {

class StepButton;

class StepList final : public QWidget {
    Q_OBJECT
public:
    enum class State { ToDo, UnderWay, Done, Troubled };
    explicit StepList(const QStringList& steps, QWidget* parent = nullptr);
    void setState(int step, State state);
    [[nodiscard]] State state(int step) const;
    /// "sim:", "3 of 8", "PASS"; empty for nothing.
    void setNote(int step, const QString& note);
    /// `why`: the sentence that says why a click does not go there yet; empty: it does.
    void setOutOfReach(int step, const QString& why);
    /// A procedure may lack a step.
    void setStepVisible(int step, bool visible);
    /// The step whose page is shown.
    void setShown(int step);
    [[nodiscard]] int shown() const { return shown_; }
    void focusShown();
    /// Again when the window's height is another one: in a low one steps have no notes.
    void fit();

signals:
    void chosen(int step);

protected:
    void changeEvent(QEvent* event) override;

private:
    std::vector<StepButton*> buttons_;
    int shown_ = 0;
};

}  // namespace tacto::gui
