// StepList.h - the steps of a procedure in a column; a shape shows whether each is to do, under way, done or ended
// early, and a note says more. A click opens a step that has been reached. If space is short the steps form a numbered
// row: in a narrow row only the current step shows its name, in the narrowest none does.
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
    /// Sets a short note such as "sim:", "3 of 8", "PASS"; empty for none.
    void setNote(int step, const QString& note);
    /// `why`: a sentence that says why the step cannot be opened; empty if it can. A step out of reach does not look
    /// like a button.
    void setOutOfReach(int step, const QString& why);
    void setName(int step, const QString& name);
    /// Shows or hides a step, as some procedures lack one; the others are numbered without it.
    void setStepVisible(int step, bool visible);
    /// Marks the step of the visible page.
    void setShown(int step);
    [[nodiscard]] int shown() const { return shown_; }
    void focusShown();
    /// Fits the steps to the window's height: in a low window they have no notes.
    void fit();
    void setAcross(bool across);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    void chosen(int step);

private:
    enum class Names { None, OfShown, All };
    /// Returns the width of all steps in a row.
    [[nodiscard]] int widthAcross(Names names) const;
    [[nodiscard]] bool named(std::size_t step, Names names) const;
    void placeAcross();
    QBoxLayout* layout_;
    bool across_ = false;
    std::vector<StepButton*> buttons_;
    int shown_ = 0;
};

}  // namespace tacto::gui
