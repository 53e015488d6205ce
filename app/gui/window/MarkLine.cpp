#include "app/gui/window/MarkLine.h"

#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QPushButton>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/window/RecordingLine.h"
#include "app/run/RunNotes.h"

namespace tacto::gui {

namespace {

constexpr int kMarkGap = 8;
constexpr int kMarkIcon = 16;
constexpr int kMarkChars = 80;

}  // namespace

MarkLine::MarkLine(BenchController& controller, RecordingLine& line, QWidget& over, QWidget& notice)
    : QFrame(&over),
      controller_(controller),
      line_(line),
      over_(over),
      notice_(notice),
      when_(new QLabel(this)),
      word_(new QLineEdit(this)) {
    setObjectName("markLine");
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    auto* row = rowIn(*this, kMarkGap, {kMarkGap, kMarkGap / 2, kMarkGap / 2, kMarkGap / 2});
    auto* shape = new QLabel(this);
    shape->setPixmap(icon("mark").pixmap(kMarkIcon));
    addAll(*row, {shape, when_});
    nameWidget(*word_, "markWord", tr("Word of the mark"));
    word_->setPlaceholderText(tr("a word for it, then Return"));
    word_->setToolTip(
        tr("Kept in the session at the moment when the key was pressed, not at that of Return. Esc stops "
           "the output here too, and closes the line."));
    word_->setMaxLength(int(kNoteLimit));
    connect(word_, &QLineEdit::returnPressed, this, &MarkLine::finish);
    row->addWidget(word_, 1);
    auto* close = new QPushButton(icon("close"), QString(), this);
    close->setAccessibleName(tr("No mark"));
    close->setToolTip(tr("Closes this and adds no mark."));
    close->setAutoDefault(false);
    makeQuiet(*close);
    connect(close, &QPushButton::clicked, this, &MarkLine::leave);
    row->addWidget(close);
    for (auto* each : {&over_, &notice_}) each->installEventFilter(this);
    hide();
}

void MarkLine::begin() {
    const auto at = controller_.telemetry().at;  // read first, so that nothing delays the moment
    if (isVisible()) finish();                   // marks the earlier moment
    const auto open = controller_.open();
    if (!open) {
        emit refused(tr("There is nothing to mark: no bench is open, and nothing is recorded"));
        return;
    }
    at_ = at;
    session_ = open->session;
    when_->setText(tr("Mark at %1").arg(minutesText(toSeconds(at_))));
    word_->clear();
    focusBefore_ = QApplication::focusWidget();
    lieDown();
    show();
    raise();
    window()->activateWindow();
    word_->setFocus(Qt::ShortcutFocusReason);
}

void MarkLine::finish() {
    const auto word = word_->text().simplified().isEmpty() ? tr("mark") : word_->text().simplified();
    leave();
    const auto open = controller_.open();
    const bool same = open && open->session == session_;
    if (!same || !controller_.markMoment(at_, word)) {
        emit refused(tr("“%1” was not marked: its recording has ended").arg(word));
        return;
    }
    line_.say(tr("Marked at %1: %2").arg(minutesText(toSeconds(at_)), word));
}

/// Gives the focus back to the previous widget, where Space stops again.
void MarkLine::leave() {
    hide();
    if (focusBefore_ && focusBefore_->isVisible())
        focusBefore_->setFocus(Qt::OtherFocusReason);
    else
        over_.setFocus(Qt::OtherFocusReason);
}

void MarkLine::lieDown() {
    const int wide = std::min(over_.width() - 2 * kMarkGap, fontMetrics().averageCharWidth() * kMarkChars);
    const int high = sizeHint().height();
    const int bottom = notice_.isVisible() ? notice_.y() : over_.height();
    setGeometry(kMarkGap, bottom - high - kMarkGap, wide, high);
}

bool MarkLine::eventFilter(QObject* watched, QEvent* event) {
    const auto moved = {QEvent::Resize, QEvent::Move, QEvent::Show, QEvent::Hide};
    if (isVisible() && std::ranges::find(moved, event->type()) != moved.end()) lieDown();
    return QFrame::eventFilter(watched, event);
}

void MarkLine::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) return leave();  // StopKeys has already stopped the output
    QFrame::keyPressEvent(event);
}

}  // namespace tacto::gui

#include "moc_MarkLine.cpp"
