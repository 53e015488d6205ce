#include "app/gui/pilot/UnfinishedOffer.h"

#include <QButtonGroup>
#include <QPainter>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/run/PilotRows.h"

namespace tacto::gui {

namespace {

constexpr int kOfferStripe = 5;  // width in pixels of the amber stripe at the left: an answer is needed

}  // namespace

Result<std::optional<Unfinished>> unfinishedOf(const Study& study, const Participant& participant) {
    const auto open = study.unfinished(participant.id);
    if (!open) return std::optional<Unfinished>();
    const auto rows = pilotRows(study, *open);
    if (!rows && !study.hasKey()) return failure(rows);
    const auto whole = study.session(open->id);
    if (!whole) return failure(whole);
    Unfinished found;
    found.number = open->number;
    found.protocol = open->protocol;
    found.answered = whole->answered;
    found.person = whole->basis != SessionBasis::Virtual;
    if (rows) found.language = qtext(rows->language);
    const auto brokenOff = rows && rows->answeredAt ? *rows->answeredAt : open->parts.back().begun;
    found.brokenOff = QDateTime::fromSecsSinceEpoch(brokenOff.time_since_epoch().count());
    if (!rows) {
        found.mayGoOn = false;
        found.trouble = sentence(rows.error());
        return std::optional(found);
    }
    found.mayGoOn = rows->mayGoOn(SystemTime::real().wall());
    found.complete = rows->ended == PilotEnd::Complete;
    return std::optional(found);
}

UnfinishedOffer::UnfinishedOffer(QWidget* parent)
    : QFrame(parent),
      says_(makeLabel(
          {}, {.name = "unfinishedSays", .size = TextSize::Body, .strong = true, .wraps = true, .plain = true}, this)),
      goOn_(new QRadioButton(this)),
      end_(new QRadioButton(this)) {
    nameWidget(*this, "unfinishedOffer", tr("A session was interrupted"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
    auto* column = columnIn(*this, -1, {kOfferStripe * 3, kOfferStripe * 2, kOfferStripe * 2, kOfferStripe * 2});
    column->addWidget(says_);
    goOn_->setObjectName("goOnWithIt");
    end_->setObjectName("endIt");
    auto* both = new QButtonGroup(this);
    for (auto* choice : {goOn_, end_}) {
        both->addButton(choice);
        column->addWidget(choice);
        connect(choice, &QRadioButton::toggled, this, &UnfinishedOffer::changed);
    }
    hide();
    onEvent(*says_, QEvent::Resize, [this] { fit(); });
}

void UnfinishedOffer::paintEvent(QPaintEvent* event) {
    QFrame::paintEvent(event);
    QPainter(this).fillRect(0, 0, kOfferStripe, height(), colours().amber);
}

void UnfinishedOffer::offer(const std::optional<Unfinished>& unfinished) {
    if (unfinished == offered_) return;
    offered_ = unfinished;
    setVisible(offered_.has_value());
    auto* both = goOn_->group();
    both->setExclusive(false);
    for (auto* choice : {goOn_, end_}) choice->setChecked(false);
    both->setExclusive(true);
    if (!offered_) return;
    const bool today = offered_->brokenOff.date() == QDate::currentDate();
    says_->setText(
        (offered_->complete
             ? tr("Session %1 is complete (%2, %3 answers), but the program was ended before the study knew.")
             : tr("Session %1 was interrupted %2, after %3 answers."))
            .arg(offered_->number)
            .arg(today ? tr("at %1").arg(offered_->brokenOff.toString("HH:mm"))
                       : tr("on %1").arg(offered_->brokenOff.toString("yyyy-MM-dd HH:mm")))
            .arg(offered_->answered) +
        (offered_->trouble.isEmpty() ? QString() : " " + offered_->trouble));
    goOn_->setEnabled(offered_->mayGoOn);
    end_->setText(offered_->complete ? tr("Leave it as it is, complete, and begin another")
                                     : tr("End it as stopped, and begin another"));
    end_->setToolTip(offered_->complete ? tr("The study notes that it is complete.")
                                        : tr("The answers so far are kept, and the session counts as stopped."));
    goOn_->setText(offered_->complete            ? tr("Go on: nothing is presented or asked any more")
                   : offered_->mayGoOn           ? tr("Go on: nothing is asked twice")
                   : offered_->trouble.isEmpty() ? tr("Go on: only within 2 h of the last answer")
                                                 : tr("Go on: record is unreadable"));
    fit();
    emit changed();
}

/// Makes room for all lines of the sentence, even on a page that scrolls.
void UnfinishedOffer::fit() {
    says_->setMinimumHeight(0);  // the height for a width is never below it
    says_->setMinimumHeight(std::max(0, says_->heightForWidth(says_->width())));
}

std::string UnfinishedOffer::chosen() const {
    return !offered_ ? "" : goOn_->isChecked() ? "resume" : end_->isChecked() ? "end" : "";
}

}  // namespace tacto::gui

#include "moc_UnfinishedOffer.cpp"
