// FindBar.h - finds words in a script: every match is marked, one is current, and the search goes round at the ends.
//
// Case does not matter. Ctrl+F opens it with the selected text; F3 and Return search on, with Shift backwards.
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
    /// Hidden until open(). `code` outlives it.
    FindBar(CodeEdit& code, QWidget* parent);
    void begin();
    void close();
    /// Goes to the next match from the cursor, or to the one before.
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
