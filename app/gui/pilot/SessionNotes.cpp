#include "app/gui/pilot/SessionNotes.h"

#include <QTime>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"

namespace tacto::gui {

namespace {

constexpr int kMaxShown = 20;
constexpr int kLongestNote = 500;  // characters

}  // namespace

SessionNotes::SessionNotes(QWidget* parent)
    : QWidget(parent), line_(new QLineEdit(this)), mark_(new QPushButton(tr("Mar&k"), this)), list_(new QVBoxLayout) {
    auto* column = columnIn(*this, 4);
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    row->addWidget(strongLabel(tr("Notes"), this));
    nameWidget(*line_, "noteLine", tr("Note"));
    line_->setMaxLength(kLongestNote);
    line_->setPlaceholderText(tr("A note; never a name. Space types here, Esc and Pause stop."));
    line_->setToolTip(tr(
        "Enter keeps the note with its time. Space types here and stops elsewhere; Esc and Pause stop from here too."));
    connect(line_, &QLineEdit::returnPressed, this, [this] {
        if (!line_->text().trimmed().isEmpty()) keep();
    });
    row->addWidget(line_, 1);
    mark_->setIcon(icon("mark"));
    mark_->setAutoDefault(false);
    mark_->setToolTip(tr("Marks this moment, with the words of the line if there are any."));
    connect(mark_, &QPushButton::clicked, this, &SessionNotes::keep);
    row->addWidget(mark_);
    column->addLayout(row);
    list_->setSpacing(0);
    column->addLayout(list_);
}

void SessionNotes::keep() {
    emit noted(line_->text().trimmed());
    line_->clear();
    emit typingEnded();
}

void SessionNotes::clear() {
    while (auto* item = list_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    count_ = 0;
}

void SessionNotes::add(const QString& note) {
    auto* row = new QWidget(this);
    auto* line = rowIn(*row, 16, {0, 4, 0, 4});
    auto* at =
        makeLabel(QTime::currentTime().toString("HH:mm:ss"), {.tone = Tone::Quiet, .size = TextSize::Small}, row);
    auto* words = makeLabel<ElidedLabel>(note.isEmpty() ? tr("mark") : note, {.plain = true}, row);
    words->setToolTip(note);
    line->addWidget(at);
    line->addWidget(words, 1);
    list_->insertWidget(0, row);
    ++count_;
    if (list_->count() <= kMaxShown) return;
    auto* oldest = list_->takeAt(list_->count() - 1);
    delete oldest->widget();
    delete oldest;
}

}  // namespace tacto::gui

#include "moc_SessionNotes.cpp"
