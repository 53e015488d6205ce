// FindBar.h - finds words in a script: all matches are marked, one is current, and the search wraps around at the ends.
//
// Case is ignored. Ctrl+F opens the bar with the selected text; F3 and Return go on, with Shift backwards.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QWidget>

#include "app/gui/runner/CodeEdit.h"

namespace tacto::gui {

class FindBar final : public QWidget {
    Q_OBJECT
public:
    /// Hidden until open(). `code` must outlive this.
    FindBar(CodeEdit& code, QWidget* parent);
    void begin();
    void close();
    /// Goes to the next match after the cursor, or to the previous one.
    void go(bool forward);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void search();
    void count();
    [[nodiscard]] QPushButton* addButton(const QString& text, const QString& name, const QString& tip);

    CodeEdit& code_;
    QLineEdit* words_;
    QLabel* says_;
    QPushButton* back_ = nullptr;
    QPushButton* next_ = nullptr;
};

}  // namespace tacto::gui
