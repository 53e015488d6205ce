// Tour.h - the first run's tour, on the simulated bench: five steps that are done, not read.
//
// A panel over the window's lower right corner; never modal, so STOP and all else stay within reach.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QPushButton>
#include <functional>
#include <vector>

namespace tacto::gui {

struct TourStep {
    QString title;
    QString text;
    QString button;             ///< what "doing it" is called; empty: only Next
    std::function<void()> act;  ///< may be empty
};

class Tour final : public QFrame {
    Q_OBJECT
public:
    Tour(std::vector<TourStep> steps, QWidget* window);
    void begin();

signals:
    void ended();

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void showStep();
    void place();
    std::vector<TourStep> steps_;
    std::size_t step_ = 0;
    QLabel* title_;
    QLabel* text_;
    QLabel* place_;
    QPushButton* act_;
    QPushButton* next_;
};

}  // namespace tacto::gui
