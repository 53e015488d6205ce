#include "app/gui/pilot/ParticipantFace.h"

#include <algorithm>
#include <cmath>

#include "app/gui/pilot/ParticipantField.h"
#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/pilot/ShareBars.h"
#include "app/gui/theme/LookChange.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/analysis/identification/IdentificationText.h"

namespace tacto::gui {

namespace {

// The picture's lengths, at 1440 x 900.
constexpr double kWide = 1440, kHigh = 900;
constexpr double kMargin = 64, kTop = 48, kStopLeft = 968, kStopTop = 120, kStopBottom = 112, kColumn = 776;
constexpr double kHead_px = 20, kTitle_px = 37, kWords_px = 28, kStop_px = 92, kSmall_px = 14, kGap = 24;
constexpr double kLargeText = 1.4;  // times the usual

QFont withPixels(int px, QFont::Weight weight = QFont::Normal) {
    auto font = textFont(TextSize::Body, weight);
    font.setPixelSize(std::max(8, px));
    return font;
}

QString phaseTitle(const std::string& phase) {
    if (phase == "ascending" || phase == "detection" || phase == "range") return QObject::tr("Finding your range");
    if (phase == "comparison") return QObject::tr("Comparing strengths");
    if (phase == "familiarisation") return QObject::tr("Getting to know them");
    if (phase == "training") return QObject::tr("Training");
    if (phase == "drift") return QObject::tr("A short check");
    if (phase == "ratings") return QObject::tr("A few questions");
    return {};
}

/// A pad's button stands in a circle beside the key.
QString howToAnswer(const ParticipantView& view) {
    const bool one = targetCount(*view.asked) == 1;
    const bool buttons = !view.buttons.isEmpty();
    auto said = one       ? buttons ? QObject::tr("Touch it, or press its key, or the button in the circle.")
                                    : QObject::tr("Touch it, or press its key.")
                      : buttons ? QObject::tr("Touch one, or press its key, or the button in its circle.")
                          : QObject::tr("Touch one, or press its key.");
    if (!one && view.asked->within) said += ' ' + QObject::tr("There is time.");
    return said;
}

}  // namespace

QString screenWords(ScreenState state) {
    switch (state) {
        case ScreenState::Rest:
            return QObject::tr("Rest");
        case ScreenState::Dot:
        case ScreenState::Feel:
        case ScreenState::Interval:
            return QObject::tr("Presentation");
        case ScreenState::Named:
            return QObject::tr("A name");
        case ScreenState::Break:
            return QObject::tr("Break");
        case ScreenState::Ended:
            break;
    }
    return QObject::tr("Ended");
}

bool isStopTestPrompt(const PilotPrompt& prompt) { return prompt.name == "stop-test"; }

ParticipantFace::ParticipantFace(std::function<void()> stop, QWidget* parent)
    : QWidget(parent),
      block_(new QLabel(this)),
      blocks_(new ShareBars(this)),
      note_(new QLabel(this)),
      title_(new QLabel(this)),
      below_(new QLabel(this)),
      field_(new ParticipantField(this)),
      stopTarget_(new ParticipantStop(std::move(stop), this)),
      timeWord_(new QLabel(tr("time to answer"), this)),
      time_(new ShareBars(this)),
      hold_(new AnswerTarget(this)),
      line_(new QLineEdit(this)),
      leastWord_(new QLabel(this)),
      mostWord_(new QLabel(this)) {
    for (auto* label : {block_, note_, title_, below_, timeWord_, leastWord_, mostWord_}) {
        label->setTextFormat(Qt::PlainText);
        label->setAttribute(Qt::WA_TransparentForMouseEvents);
    }
    title_->setObjectName("participantTitle");
    title_->setWordWrap(true);
    title_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    below_->setWordWrap(true);
    for (auto* quiet : {note_, below_, timeWord_, leastWord_, mostWord_}) setTone(*quiet, Tone::Quiet);
    hold_->setObjectName("hold");
    hold_->hide();
    line_->hide();
    afterLookChange(*this, [this] { arrange(); });
}

void ParticipantFace::setNote(const QString& note) {
    note_->setText(note);
    arrange();
}

void ParticipantFace::setStopButtons(const QStringList& buttons) { stopTarget_->setButtons(buttons); }

QString ParticipantFace::title() const { return title_->text(); }

void ParticipantFace::setTimeLeft(double share) { time_->setShares({share}); }

void ParticipantFace::setStrip(QWidget* strip) {
    strip_ = strip;
    strip_->setParent(this);
    strip_->hide();
}

bool ParticipantFace::stripOpen() const { return strip_ != nullptr && !strip_->isHidden(); }

void ParticipantFace::openStrip(bool open) {
    if (strip_ == nullptr) return;
    strip_->setVisible(open);
    if (open) strip_->raise();
    arrange();  // also where it is open already: it may ask something that needs more room
}

void ParticipantFace::say(const QString& title, const QString& below) {
    asked_.reset();
    field_->clear();
    for (auto* widget : {static_cast<QWidget*>(timeWord_), static_cast<QWidget*>(time_), static_cast<QWidget*>(line_)})
        widget->hide();
    leastWord_->clear();
    mostWord_->clear();
    put(title, below);
}

void ParticipantFace::put(const QString& title, const QString& below) {
    title_->setText(title);
    below_->setText(below);
    arrange();
}

/// The words and the field of what goes on.
void ParticipantFace::show(const ParticipantView& view) {
    asked_ = view.asked;
    const auto& screen = view.screen;
    const bool limited = asked_ && asked_->within;
    timeWord_->setVisible(limited);
    time_->setVisible(limited);
    time_->setShares({1});
    const bool scale = asked_ && asked_->kind == PromptKind::Scale;
    leastWord_->setText(scale ? qtext(asked_->leastText) : QString());
    mostWord_->setText(scale ? qtext(asked_->mostText) : QString());
    line_->setVisible(asked_ && asked_->kind == PromptKind::Text);
    block_->setText(screen.blocks > 0 && screen.block > 0 ? tr("Block %1 of %2").arg(screen.block).arg(screen.blocks)
                                                          : phaseTitle(screen.phase));
    blocks_->setShares(screen.blocks > 0 && screen.block > 0
                           ? blockShares(screen.block, screen.blocks, screen.trial, screen.trials)
                           : std::vector<double>());
    if (view.stopped) {
        field_->clear();
        return put(tr("Stopped. The output is off."), tr("It goes on only when you say so."));
    }
    if (asked_) {
        if (asked_->kind == PromptKind::Hold) {
            hold_->setContent(tr("hold this"), {"hand"}, view.holdKey, view.holdButton, AnswerTarget::Shape::Row);
            hold_->show();
            field_->clear();
        } else if (isStopTestPrompt(*asked_)) {
            field_->clear();
        } else if (asked_->kind == PromptKind::Text) {
            line_->clear();
            line_->setFocus();
            field_->clear();
        } else {
            field_->showTargets(*asked_, view.keys, view.buttons);
        }
        const auto below = asked_->kind == PromptKind::Hold   ? tr("Letting go stops the output.")
                           : isStopTestPrompt(*asked_)        ? tr("Press STOP, or Esc.")
                           : asked_->kind == PromptKind::Text ? tr("Return gives the answer.")
                           : asked_->kind == PromptKind::Several
                               ? tr("Touch each that fits, then press Return or “done”.")
                               : howToAnswer(view);
        return put(qtext(asked_->text), below);
    }
    if (view.pause) {
        field_->clear();
        return put(tr("Break"), tr("It goes on when both of you are ready."));
    }
    switch (screen.state) {
        case ScreenState::Rest:
            field_->clear();
            return put(qtext(screen.text), {});
        case ScreenState::Dot:
        case ScreenState::Feel:
            field_->showDot();
            return put(tr("Feel what comes"), qtext(screen.text));
        case ScreenState::Interval:
            field_->showIntervals(screen.interval);
            return put(tr("Feel what comes"),
                       screen.text.empty() ? tr("It comes once: while 1 or while 2 is dark.") : qtext(screen.text));
        case ScreenState::Named: {
            const auto verdict = !screen.right ? tr("This is") : *screen.right ? tr("Right. This was") : tr("This was");
            field_->showWord(qtext(answerWords(screen.named)), iconsOf(screen.named));
            return put(verdict, qtext(screen.text));
        }
        case ScreenState::Break:
            field_->clear();
            return put(tr("Break"), screen.text.empty() ? tr("Take your time.") : qtext(screen.text));
        case ScreenState::Ended:
            field_->clear();
            return put(tr("That was all. Thank you."), qtext(screen.text));
    }
}

void ParticipantFace::arrange() {
    const double s = std::min(width() / kWide, height() / kHigh);
    const double text = s * scaledPx(1000) / 1000.0;
    const auto px = [&](double designed) { return int(std::lround(designed * s)); };
    const int margin = px(kMargin), right = width() - margin;
    const int stopLeft = int(std::lround(kStopLeft / kWide * width()));
    const int column = std::min(int(std::lround(kColumn / kWide * width())), stopLeft - margin - px(kGap));
    const int foot = stripOpen() ? strip_->sizeHint().height() : 0;
    if (stripOpen()) strip_->setGeometry(0, height() - foot, width(), foot);  // as high as what it asks needs
    const int bottom = height() - foot;

    const auto head = withPixels(int(kHead_px * text));
    const int headHigh = QFontMetrics(head).height();
    for (auto* label : {block_, note_, below_}) label->setFont(head);
    const int top = px(kTop);
    block_->setGeometry(margin, top, QFontMetrics(head).horizontalAdvance(block_->text()) + 2, headHigh);
    const int barsLeft = block_->geometry().right() + px(kGap);
    blocks_->setGeometry(barsLeft, top + headHigh / 2 - px(4), std::max(0, std::min(px(392), stopLeft - barsLeft)),
                         std::max(4, px(8)));
    const int noteWide = QFontMetrics(head).horizontalAdvance(note_->text()) + 2;
    note_->setGeometry(right - noteWide, top, noteWide, headHigh);

    const int stopTop = std::max(px(kStopTop), top + headHigh + px(12));
    stopTarget_->setGeometry(stopLeft, stopTop, right - stopLeft, bottom - px(kStopBottom) - stopTop);
    stopTarget_->setType(int(kStop_px * s), int(kHead_px * text));

    // From the foot: the time bar, what is held; from the head: the question. The targets have the rest.
    const auto small = withPixels(std::max(11, int(kSmall_px * text)));
    const int smallHigh = QFontMetrics(small).height();
    const int timeTop = bottom - px(kMargin);
    timeWord_->setFont(small);
    const int wordWide = QFontMetrics(small).horizontalAdvance(timeWord_->text()) + 2;
    timeWord_->setGeometry(margin, timeTop - smallHigh / 2, wordWide, smallHigh);
    time_->setGeometry(margin + wordWide + px(14), timeTop - px(4), column - wordWide - px(14), std::max(4, px(8)));
    const int least = pixelsOf(kTarget_mm, *this);
    int fieldBottom = bottom - px(kStopBottom) - px(12);
    if (!hold_->isHidden()) {
        hold_->setGeometry(margin, fieldBottom - least, column, least);
        hold_->setType(int(kWords_px * text), int(kHead_px * text));
        fieldBottom -= least + px(kGap);
    }

    const int gap = px(kGap);
    const bool asks =
        asked_ && asked_->kind != PromptKind::Hold && asked_->kind != PromptKind::Text && !isStopTestPrompt(*asked_);
    const int count = asks ? targetCount(*asked_) : 0;
    const int rows = count == 0                          ? 0
                     : asked_->kind == PromptKind::Scale ? (count + 5) / 6
                     : count <= 3                        ? 1
                                                         : (count + fieldColumns(count) - 1) / fieldColumns(count);
    const int wanted = rows * least + std::max(0, rows - 1) * gap;
    int title_px = int(kTitle_px * text);
    int fieldTop = 0;
    bool hasBelow = text < kLargeText * s;  // with large text the targets take the room first
    for (;;) {
        const auto font = withPixels(title_px, QFont::Bold);
        title_->setFont(font);
        const int titleHigh = title_->heightForWidth(column);
        title_->setGeometry(margin, stopTop, column, titleHigh);
        const int belowHigh = hasBelow && !below_->text().isEmpty() ? below_->heightForWidth(column) : 0;
        below_->setVisible(belowHigh > 0);
        below_->setGeometry(margin, stopTop + titleHigh + px(8), column, belowHigh);
        fieldTop = stopTop + titleHigh + (belowHigh > 0 ? belowHigh + px(8) : 0) + px(36);
        if (fieldBottom - fieldTop >= wanted) break;
        // The targets come first: the second line goes, then the question gets smaller.
        if (hasBelow)
            hasBelow = false;
        else if (title_px > int(kHead_px * s))
            title_px -= 2;
        else
            break;
    }
    field_->setGeometry(margin, fieldTop, column, std::max(1, fieldBottom - fieldTop));
    field_->setType(int(kWords_px * text), int(kHead_px * text), gap);
    line_->setFont(withPixels(int(kWords_px * text)));
    line_->setGeometry(margin, fieldTop, column, least);
    for (auto* end : {leastWord_, mostWord_}) end->setFont(head);
    const bool ends = !leastWord_->text().isEmpty() || !mostWord_->text().isEmpty();
    leastWord_->setVisible(ends);
    mostWord_->setVisible(ends);
    if (!ends) return;
    // Below the row of a scale's targets.
    const int endsTop = std::min(fieldTop + rows * pixelsOf(60, *this) + rows * gap, fieldBottom);
    leastWord_->setGeometry(margin, endsTop, column / 2, headHigh);
    mostWord_->setGeometry(margin + column / 2, endsTop, column - column / 2, headHigh);
    mostWord_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
}

void ParticipantFace::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

}  // namespace tacto::gui

#include "moc_ParticipantFace.cpp"
