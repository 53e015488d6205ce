// StepList.h - a procedure is a path: its steps, each to do, under way, done or ended early, with a word on how it
// stands. A click goes there.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QPushButton>
#include <QStringList>
#include <QWidget>
#include <vector>

namespace tacto::gui {

class StepList final : public QWidget {
    Q_OBJECT
public:
    explicit StepList(const QStringList& steps, QWidget* parent = nullptr);
    /// Steps before `current` are done, those behind it to do; all are done at the end.
    void setCurrent(int current);
    /// A step with something to mend before it can be done.
    void setTroubled(int step, bool troubled);
    /// "sim:", "3 of 8", "PASS"; empty for nothing.
    void setNote(int step, const QString& note);
    [[nodiscard]] int current() const { return current_; }

signals:
    void chosen(int step);

private:
    void write();
    struct Row {
        QString name;
        QString note;
        bool troubled = false;
        QPushButton* button = nullptr;
    };
    std::vector<Row> rows_;
    int current_ = 0;
};

}  // namespace tacto::gui
