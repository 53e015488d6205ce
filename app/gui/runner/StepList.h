// StepList.h - a procedure is a path: its steps below each other, each to do, under way, done or ended early by its
// shape, with a word on how it stands. A click goes to a step that was reached. Where there is little room they stand
// in a row, numbered; in a narrow one only the step that is shown has its name, in the
// narrowest none.
#pragma once

#include <QBoxLayout>
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
    /// `why`: the sentence that says why a click does not go there; empty: it does. Such a step does not look like a
    /// button.
    void setOutOfReach(int step, const QString& why);
    void setName(int step, const QString& name);
    /// A procedure may lack a step.
    void setStepVisible(int step, bool visible);
    /// Sets the step whose page is shown.
    void setShown(int step);
    [[nodiscard]] int shown() const { return shown_; }
    void focusShown();
    /// Fits the steps again when the window's height changes: in a low window they have no notes.
    void fit();
    void setAcross(bool across);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    void chosen(int step);

private:
    enum class Names { None, OfShown, All };
    /// The width of all steps in a row.
    [[nodiscard]] int widthAcross(Names names) const;
    [[nodiscard]] bool named(std::size_t step, Names names) const;
    void placeAcross();
    QBoxLayout* layout_;
    bool across_ = false;
    std::vector<StepButton*> buttons_;
    int shown_ = 0;
};

}  // namespace tacto::gui
