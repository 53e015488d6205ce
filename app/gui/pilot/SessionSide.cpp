#include "app/gui/pilot/SessionSide.h"

#include <QPainter>

#include "app/gui/pilot/ParticipantWindow.h"
#include "app/gui/pilot/SessionConduct.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Pages.h"

namespace tacto::gui {

namespace {
constexpr int kPilotSide = 224;
}

SessionSide::SessionSide(QWidget* parent) : QScrollArea(parent) {
    setObjectName("pilotSide");
    scrollDownOnly(*this);
    setFocusPolicy(Qt::NoFocus);
    fixWidth(*this, kPilotSide);
    auto* inside = new QWidget(this);
    auto* column = columnIn(*inside, 0);
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

namespace {
constexpr int kCardPad = 12, kCardIcon = 16;
}

FactsCard::FactsCard(const QString& title, const QString& iconName, QWidget* parent)
    : QFrame(parent),
      icon_(iconName),
      picture_(new QLabel(this)),
      column_(new QVBoxLayout(this)),
      grid_(new QGridLayout) {
    setAccessibleName(title);
    column_->setContentsMargins(kCardPad, kCardPad / 2, kCardPad, kCardPad);
    column_->setSpacing(kCardPad / 2);
    auto* head = new QHBoxLayout;
    head->setSpacing(8);
    auto* words = strongLabel(title, this);
    head->addWidget(picture_);
    head->addWidget(words, 1);
    column_->addLayout(head);
    grid_->setVerticalSpacing(8);
    grid_->setColumnStretch(1, 1);
    column_->addLayout(grid_);
    dress();
    onLookChange(*this, [this] { dress(); });
}

void FactsCard::setFacts(const std::vector<Fact>& facts) {
    if (facts == facts_) return;
    facts_ = facts;
    while (auto* item = grid_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    int row = 0;
    for (const auto& fact : facts_) {
        auto* name = new QLabel(fact.name, this);
        auto* value = new ElidedLabel(fact.value, this);
        for (auto* label : {name, static_cast<QLabel*>(value)}) label->setTextFormat(Qt::PlainText);
        setTextSize(*name, TextSize::Small);
        setTextSize(*value, TextSize::Small, fact.strong);
        if (!fact.strong) setTone(*value, Tone::Quiet);
        value->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        value->setToolTip(fact.value);
        grid_->addWidget(name, row, 0);
        grid_->addWidget(value, row, 1);
        ++row;
    }
}

void FactsCard::setPicture(QWidget* picture) { column_->insertWidget(1, picture); }

void FactsCard::setWords(const QString& words) {
    if (words_ == nullptr) {
        words_ = makeLabel({}, {.tone = Tone::Quiet, .size = TextSize::Small, .wraps = true}, this);
        column_->addWidget(words_);
    }
    words_->setText(words);
}

void FactsCard::dress() {
    picture_->setPixmap(iconPixmap(icon_, colours().text, scaledPx(kCardIcon), devicePixelRatioF()));
}

namespace {
constexpr int kThumbWide = 200, kThumbHigh = 125;
}

TheirScreen::TheirScreen(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("The participant’s screen"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void TheirScreen::setShows(Shows shows) {
    if (std::exchange(shows_, shows) != shows) update();
}

QSize TheirScreen::sizeHint() const { return {scaledPx(kThumbWide), scaledPx(kThumbHigh)}; }

void TheirScreen::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto& c = colours();
    painter.setPen(QPen(c.edge, 1));
    painter.setBrush(c.window);
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    const QRectF inside = QRectF(rect()).adjusted(9, 9, -9, -9);
    const double wide = inside.width(), high = inside.height();
    if (shows_ == Shows::Targets) {
        painter.setBrush(c.base);
        const double rows[] = {0.36, 0.36, 0.18};
        double y = inside.top();
        for (const double share : rows) {
            for (int i = 0; i < 2; ++i)
                painter.drawRoundedRect(QRectF(inside.left() + i * wide * 0.33, y, wide * 0.31, high * share), 2, 2);
            y += high * (share + 0.05);
        }
    } else if (shows_ == Shows::Dot) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(c.text);
        painter.drawEllipse(QPointF(inside.left() + wide * 0.32, inside.center().y()), 4, 4);
    }
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.stop);
    painter.drawRoundedRect(QRectF(inside.left() + wide * 0.68, inside.top(), wide * 0.32, high), 2, 2);
}

}  // namespace tacto::gui

#include "moc_SessionSide.cpp"
