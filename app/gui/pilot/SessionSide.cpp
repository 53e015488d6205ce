#include "app/gui/pilot/SessionSide.h"

#include <QVBoxLayout>

#include "app/gui/pilot/FactsCard.h"
#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/pilot/SessionConduct.h"
#include "app/gui/pilot/TheirScreen.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {
constexpr int kPilotSide = 224;
}

SessionSide::SessionSide(QWidget* parent) : QScrollArea(parent) {
    setObjectName("pilotSide");
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::NoFocus);
    fixWidth(*this, kPilotSide);
    auto* inside = new QWidget(this);
    auto* column = new QVBoxLayout(inside);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    who_ = new FactsCard(tr("Participant"), "pilot", inside);
    screen_ = new FactsCard(tr("Their screen"), "plot-only", inside);
    theirs_ = new TheirScreen(screen_);
    screen_->setPicture(theirs_);
    stops_ = new FactsCard(tr("Stops"), "hand", inside);
    for (auto* card : {who_, screen_, stops_}) {
        column->addWidget(card);
        column->addWidget(lineAcross(inside));
    }
    column->addStretch();
    setWidget(inside);
    for (auto* ground : {inside, viewport()}) ground->setAutoFillBackground(false);
}

void SessionSide::show(const SessionConduct& session) {
    const auto& start = session.start();
    who_->setFacts({{tr("Participant"), start.who},
                    {tr("Order by seed"), start.rehearsal ? QString::number(start.seed) : tr("drawn")},
                    {tr("Consent"), start.rehearsal ? tr("rehearsal") : tr("noted")},
                    {start.rehearsal ? tr("Folder") : tr("Study"), start.title}});
    stops_->setFacts(
        {{tr("Participant"), tr("%1 of %2").arg(session.participantStops()).arg(kMaxParticipantStops), true},
         {tr("Faults"), QString::number(session.faults()), true}});
    using Shows = TheirScreen::Shows;
    const auto* window = session.window();
    if (window == nullptr) {
        theirs_->setShows(Shows::Nothing);
        return screen_->setWords(tr("A virtual participant has no screen."));
    }
    const auto state = session.screen().state;
    const bool feels = state == ScreenState::Dot || state == ScreenState::Feel || state == ScreenState::Interval;
    theirs_->setShows(window->asking() ? Shows::Targets : feels ? Shows::Dot : Shows::Nothing);
    screen_->setWords(tr("%1, on “%2”. Their keys: %3.")
                          .arg(window->says(), session.screenName(),
                               start.keys == KeySet::Figures    ? tr("the figures")
                               : start.keys == KeySet::LeftHand ? tr("the left hand’s")
                                                                : tr("the right hand’s")));
}

}  // namespace tacto::gui

#include "moc_SessionSide.cpp"
