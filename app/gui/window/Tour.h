// Tour.h - the tour at the first start, on the simulated bench: the user does each step instead of reading about it.
//
// A panel in the window, which covers neither the safety bar nor the control it explains, and a frame around that
// control. A step is done when the user has done its task with the window's own controls; Next skips a step, Back
// returns. Never modal: STOP, its keys and everything else stay usable. The tour can be resumed later.
#pragma once

#include <QElapsedTimer>
#include <QFrame>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <vector>

namespace tacto::gui {

/// A part of a widget, or the whole widget if `part` is null.
struct TourTarget {
    QWidget* widget = nullptr;
    QRect part{};
};

/// A frame around the control that the tour explains. It lies in the control's window and takes neither clicks nor
/// keys.
class TourFrame final : public QWidget {
    Q_OBJECT
public:
    explicit TourFrame(QWidget* window);
    /// Surrounds the visible part of the target; hides if nothing is visible.
    void follow(const TourTarget& target);

protected:
    void paintEvent(QPaintEvent* event) override;
};

struct TourStep {
    QString title;
    std::function<QString()> text;       ///< for the present state
    std::function<void()> enter;         ///< brings the control into view and notes the present state; may be empty
    std::function<TourTarget()> target;  ///< for the present state; may be empty
    std::function<bool()> done;          ///< true if the task was done since enter()
    int linger_ms = 1200;                ///< milliseconds for which a finished step stays visible
};

class Tour final : public QFrame {
    Q_OBJECT
public:
    Tour(std::vector<TourStep> steps, QWidget* window);
    /// Begins at this step, counted from 0, or at step 0 if the number is too large.
    void begin(int step);
    [[nodiscard]] int step() const { return int(step_); }
    /// A text that never changes.
    [[nodiscard]] static std::function<QString()> always(const QString& text) {
        return [text] { return text; };
    }

signals:
    /// Another step is shown.
    void stepped(int step);
    /// `finished`: the last step was done; otherwise the user left at step().
    void ended(bool finished);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void go(std::size_t step, bool back);
    void goOn();
    void look();
    void end(bool finished);
    void showPlace(bool done);
    void bringIntoView(QWidget* control);
    void place();

    std::vector<TourStep> steps_;
    std::size_t step_ = 0;
    bool waits_ = false;  ///< the step was already done when Back led here: it must be done again to lead on
    QElapsedTimer done_;  ///< time since the step was seen to be done; invalid before
    QTimer look_;
    QPointer<TourFrame> frame_;
    QPointer<QWidget> shown_;  ///< the control that the frame surrounds
    QLabel* title_;
    QLabel* text_;
    QLabel* place_;
    QPushButton* leave_ = nullptr;
    QPushButton* back_ = nullptr;
    QPushButton* next_ = nullptr;
};

}  // namespace tacto::gui
