// Tour.h - the first run's tour, on the simulated bench: steps that are done, not read.
//
// A panel in the window, where it covers neither the safety bar nor the control that it talks about; and a frame around
// that control. A step is over when what it asks for was done at the window's own controls; Next passes it over, Back
// returns. Never modal: STOP, its keys and all else stay within reach. What is left can be resumed.
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

/// A part of a widget, or all of it where `part` is null.
struct TourTarget {
    QWidget* widget = nullptr;
    QRect part{};
};

/// A frame around a control that the tour talks about. It lies in the control's own window and takes neither clicks nor
/// keys.
class TourFrame final : public QWidget {
    Q_OBJECT
public:
    explicit TourFrame(QWidget* window);
    /// Goes around what can be seen of it; hides where nothing can.
    void follow(const TourTarget& target);

protected:
    void paintEvent(QPaintEvent* event) override;
};

struct TourStep {
    QString title;
    std::function<QString()> text;       ///< as things stand now
    std::function<void()> enter;         ///< brings the control into view and notes how things stand; may be empty
    std::function<TourTarget()> target;  ///< as things stand now; may be empty
    std::function<bool()> done;          ///< since enter()
    int linger_ms = 1200;                ///< how long it stays when it is done, to be seen
};

class Tour final : public QFrame {
    Q_OBJECT
public:
    Tour(std::vector<TourStep> steps, QWidget* window);
    /// Begins at this step, from 0; at the first, where the number is too large.
    void begin(int step);
    [[nodiscard]] int step() const { return int(step_); }
    /// A text that stays as it is.
    [[nodiscard]] static std::function<QString()> always(const QString& text) {
        return [text] { return text; };
    }

signals:
    /// Another step is shown.
    void stepped(int step);
    /// `finished`: to the last step; otherwise it was left at step().
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
    bool waits_ = false;  ///< the step was done when Back led here: it leads on only when it is done again
    QElapsedTimer done_;  ///< how long ago it was seen to be done; invalid before
    QTimer look_;
    QPointer<TourFrame> frame_;
    QPointer<QWidget> shown_;  ///< the control in the frame
    QLabel* title_;
    QLabel* text_;
    QLabel* place_;
    QPushButton* leave_ = nullptr;
    QPushButton* back_ = nullptr;
    QPushButton* next_ = nullptr;
};

}  // namespace tacto::gui
