// StepList.h - a procedure is a path: its steps, each to do, under way, or done.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QStringList>
#include <vector>

namespace tacto::gui {

class StepList final : public QFrame {
    Q_OBJECT
public:
    explicit StepList(const QStringList& steps, QWidget* parent = nullptr);
    /// Steps before `current` are done, those behind it to do; all are done at the end.
    void setCurrent(int current);
    [[nodiscard]] int current() const { return current_; }

private:
    QStringList steps_;
    std::vector<QLabel*> labels_;
    int current_ = 0;
};

}  // namespace tacto::gui
