#include "app/gui/runner/FindBar.h"

#include <QKeyEvent>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

FindBar::FindBar(CodeEdit& code, QWidget* parent) : QWidget(parent), code_(code) {
    setObjectName("findBar");
    auto* row = rowIn(*this);
    words_ = new QLineEdit(this);
    nameWidget(*words_, "findWords", tr("Find"));
    words_->setPlaceholderText(tr("Find in the script"));
    words_->setToolTip(tr("Case does not count. Return or F3: next; with Shift: previous."));
    words_->installEventFilter(this);
    row->addWidget(words_, 1);
    says_ = makeLabel({}, {.name = "findCount", .tone = Tone::Quiet}, this);
    says_->setMinimumWidth(says_->fontMetrics().horizontalAdvance(tr("%1 of %2, from the top").arg(999).arg(999)));
    row->addWidget(says_);
    back_ = addButton(tr("Previous"), "findPrevious", tr("The match before (Shift+F3)."));
    next_ = addButton(tr("Next"), "findNext", tr("The next match (F3)."));
    auto* done = addButton({}, "findClose", tr("Closes the search (Esc)."));
    done->setIcon(icon("close"));
    done->setAccessibleName(tr("Close the search"));
    makeQuiet(*done);
    connect(words_, &QLineEdit::textChanged, this, &FindBar::search);
    connect(back_, &QPushButton::clicked, this, [this] { go(false); });
    connect(next_, &QPushButton::clicked, this, [this] { go(true); });
    connect(done, &QPushButton::clicked, this, &FindBar::close);
    connect(&code_, &CodeEdit::textChanged, this, [this] {
        if (isVisible()) count();
    });
    hide();
}

QPushButton* FindBar::addButton(const QString& text, const QString& name, const QString& tip) {
    auto* made = pageButton(text, name, tip, this);
    layout()->addWidget(made);
    return made;
}

void FindBar::begin() {
    const auto selected = code_.selectedText();
    if (!selected.isEmpty() && !selected.contains('\n')) words_->setText(selected);
    show();
    words_->setFocus(Qt::ShortcutFocusReason);
    words_->selectAll();
    count();
}

void FindBar::close() {
    hide();
    code_.markWords({});
    code_.setFocus();
}

/// Searches while the user types: finds the first match from the start of the present one.
void FindBar::search() {
    int line = 0, index = 0, end = 0;
    code_.getSelection(&line, &index, &end, &end);
    if (line >= 0) code_.setCursorPosition(line, index);
    if (words_->text().isEmpty()) return count();
    go(true);
}

void FindBar::go(bool forward) {
    if (words_->text().isEmpty()) return;
    code_.markWords(words_->text());
    const bool wrapped = code_.selectFound(forward);
    count();
    if (wrapped)
        says_->setText(forward ? tr("%1, from the top").arg(says_->text()) : tr("%1, from the end").arg(says_->text()));
}

void FindBar::count() {
    const int all = code_.markWords(words_->text());
    const int at = code_.selectedFound();
    says_->setText(words_->text().isEmpty() ? QString()
                   : all == 0               ? tr("no match")
                   : at == 0 && all == 1    ? tr("1 match")
                   : at == 0                ? tr("%1 matches").arg(all)
                                            : tr("%1 of %2").arg(at).arg(all));
    setTone(*says_, all == 0 && !words_->text().isEmpty() ? Tone::Warning : Tone::Quiet);
    for (auto* button : {back_, next_}) button->setEnabled(all > 0);
}

bool FindBar::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
    const auto& key = *static_cast<QKeyEvent*>(event);
    if (key.key() != Qt::Key_Return && key.key() != Qt::Key_Enter) return false;
    go((key.modifiers() & Qt::ShiftModifier) == 0);
    return true;
}

}  // namespace tacto::gui

#include "moc_FindBar.cpp"
