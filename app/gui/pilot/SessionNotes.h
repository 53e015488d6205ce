// SessionNotes.h - the operator's notes during a pilot session, each with its time, newest first; Enter saves a note.
#pragma once

#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>
#include <QWidget>

namespace tacto::gui {

class SessionNotes final : public QWidget {
    Q_OBJECT
public:
    explicit SessionNotes(QWidget* parent = nullptr);
    void clear();
    /// Shows a note that was saved.
    void add(const QString& note);
    [[nodiscard]] int count() const { return count_; }

signals:
    /// Asks to save the note; empty for a mark without text.
    void noted(const QString& note);
    void typingEnded();  ///< the keyboard focus may go back to the participant

private:
    void keep();
    QLineEdit* line_;
    QPushButton* mark_;
    QVBoxLayout* list_;
    int count_ = 0;
};

}  // namespace tacto::gui
