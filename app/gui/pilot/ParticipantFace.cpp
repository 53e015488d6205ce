#include "app/gui/pilot/ParticipantFace.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "app/gui/pilot/ParticipantField.h"
#include "app/gui/pilot/ParticipantStop.h"
#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

// Lengths in the design's picture of 1440 x 900 pixels.
constexpr double kWide = 1440, kHigh = 900;
constexpr double kMargin = 64, kTop = 48, kStopLeft = 968, kStopTop = 120, kStopBottom = 112, kColumn = 776;
constexpr double kHead_px = 20, kTitle_px = 37, kWords_px = 28, kStop_px = 92, kSmall_px = 14, kGap = 24;
constexpr double kLargeText = 1.4;  // factor over the usual text size

QFont withPixels(int px, QFont::Weight weight = QFont::Normal) {
    auto font = textFont(TextSize::Body, weight);
    font.setPixelSize(std::max(8, px));
    return font;
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
      title_(makeLabel({}, {.name = "participantTitle", .wraps = true}, this)),
      below_(new QLabel(this)),
      field_(new ParticipantField(this)),
      stopTarget_(new ParticipantStop(std::move(stop), this)),
      timeWord_(new QLabel(word("how.time-bar"), this)),
      time_(new ShareBars(this)),
      hold_(new AnswerTarget(this)),
      line_(new QLineEdit(this)),
      leastWord_(new QLabel(this)),
      mostWord_(new QLabel(this)) {
    for (auto* label : {block_, note_, title_, below_, timeWord_, leastWord_, mostWord_}) {
        label->setTextFormat(Qt::PlainText);
        label->setAttribute(Qt::WA_TransparentForMouseEvents);
    }
    title_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    below_->setWordWrap(true);
    for (auto* quiet : {note_, below_, timeWord_, leastWord_, mostWord_}) setTone(*quiet, Tone::Quiet);
    hold_->setObjectName("hold");
    hold_->hide();
    line_->hide();
    line_->setContextMenuPolicy(Qt::NoContextMenu);  // Qt's menu would be in the program's language
    afterLookChange(*this, [this] { arrange(); });
    onEvent(*this, QEvent::Resize, [this] { arrange(); });
}

void ParticipantFace::setWords(const ParticipantWords& words) {
    words_ = words;
    timeWord_->setText(word("how.time-bar"));
    stopTarget_->setWords(words);
    arrange();
}

QString ParticipantFace::word(std::string_view key, ParticipantWords::Places places) const {
    return qtext(words_.text(key, places));
}

QString ParticipantFace::phaseTitle(const std::string& phase) const {
    const bool range = phase == "ascending" || phase == "detection";
    return qtext(words_.text("phase", range ? "range" : phase, {}));
}

/// Returns how to answer by touch and key and, if the pad has buttons (shown in a circle), by button.
QString ParticipantFace::howToAnswer(const ParticipantView& view) const {
    const bool one = targetCount(*view.asked) == 1;
    const bool buttons = !view.buttons.isEmpty();
    auto said = word(one ? buttons ? "how.one-button" : "how.one" : buttons ? "how.any-button" : "how.any");
    if (!one && view.asked->within) said += ' ' + word("how.time");
    return said;
}

void ParticipantFace::setNote(const QString& note) {
    note_->setText(note);
    arrange();
}

void ParticipantFace::setStopButtons(const QStringList& buttons) { stopTarget_->setButtons(buttons); }

void ParticipantFace::setStopsLeft(int left) { stopTarget_->setLeft(left); }

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
    arrange();  // needed even if the strip is already open: its new question may need more room
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

/// Shows the words and the field of the present question.
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
    const bool counted = screen.blocks > 0 && screen.block > 0;
    block_->setText(!counted ? phaseTitle(screen.phase)
                    : screen.phase == "ascending"  // series of rising levels, and no blocks of the test
                        ? QString("%1  %2 / %3").arg(phaseTitle(screen.phase)).arg(screen.block).arg(screen.blocks)
                        : word("phase.block",
                               {{"block", fmt::format("{}", screen.block)}, {"of", fmt::format("{}", screen.blocks)}}));
    blocks_->setShares(counted ? blockShares(screen.block, screen.blocks, screen.trial, screen.trials)
                               : std::vector<double>());
    if (view.stopped) {
        field_->clear();
        return put(word("stopped.title"), word("stopped.below"));
    }
    if (asked_) {
        if (asked_->kind == PromptKind::Hold) {
            hold_->setContent(word("hold.target"), {"hand"}, view.holdKey, view.holdButton, AnswerTarget::Shape::Row);
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
        const auto below = asked_->kind == PromptKind::Hold      ? word("hold.below")
                           : isStopTestPrompt(*asked_)           ? word("stop-test.how")
                           : asked_->kind == PromptKind::Text    ? word("how.text")
                           : asked_->kind == PromptKind::Several ? word("how.several")
                                                                 : howToAnswer(view);
        return put(qtext(asked_->text), below);
    }
    if (view.pause) {
        field_->clear();
        return put(word("break.title"), word("break.both"));
    }
    switch (screen.state) {
        case ScreenState::Rest:
            field_->clear();
            return put(qtext(screen.text), {});
        case ScreenState::Dot:
        case ScreenState::Feel:
            field_->showDot();
            return put(word("feel.title"), qtext(screen.text));
        case ScreenState::Interval:
            field_->showIntervals(screen.interval);
            return put(word("feel.title"), screen.text.empty() ? word("feel.interval") : qtext(screen.text));
        case ScreenState::Named: {
            const auto verdict = word(!screen.right ? "named.is" : *screen.right ? "named.right" : "named.was");
            field_->showWord(qtext(conditionWords(screen.named, words_)), iconsOf(screen.named));
            return put(verdict, qtext(screen.text));
        }
        case ScreenState::Break:
            field_->clear();
            return put(word("break.title"), screen.text.empty() ? word("break.time") : qtext(screen.text));
        case ScreenState::Ended:
            field_->clear();
            return put(word("ended.title"), qtext(screen.text));
    }
}

/// The design's lengths, scaled to the size of the window.
struct ParticipantFace::Picture {
    double scale;  ///< scale of lengths
    double text;   ///< scale of text
    int margin, column;
    int stopLeft, stopTop, right;
    int bottom;  ///< lower edge of the free area, above the strip
    int least;   ///< smallest side of a target

    [[nodiscard]] int px(double designed) const { return int(std::lround(designed * scale)); }
    [[nodiscard]] int type(double designed) const { return int(designed * text); }
};

ParticipantFace::Picture ParticipantFace::picture() const {
    Picture at{};
    at.scale = std::min(width() / kWide, height() / kHigh);
    at.text = at.scale * scaledPx(1000) / 1000.0;
    at.margin = at.px(kMargin);
    at.right = width() - at.margin;
    at.stopLeft = int(std::lround(kStopLeft / kWide * width()));
    at.column = std::min(int(std::lround(kColumn / kWide * width())), at.stopLeft - at.margin - at.px(kGap));
    const int headHigh = QFontMetrics(withPixels(at.type(kHead_px))).height();
    at.stopTop = std::max(at.px(kStopTop), at.px(kTop) + headHigh + at.px(12));
    at.bottom = height() - (stripOpen() ? strip_->sizeHint().height() : 0);
    at.least = pixelsOf(kTarget_mm, *this);
    return at;
}

/// The question is placed from the top, the time bar and the held target from the bottom; other targets get the rest.
void ParticipantFace::arrange() {
    const auto at = picture();
    if (stripOpen()) strip_->setGeometry(0, at.bottom, width(), height() - at.bottom);  // as high as its question needs
    placeHead(at);
    stopTarget_->setGeometry(at.stopLeft, at.stopTop, at.right - at.stopLeft,
                             at.bottom - at.px(kStopBottom) - at.stopTop);
    stopTarget_->setType(int(kStop_px * at.scale), at.type(kHead_px));
    placeTime(at);
    int fieldBottom = at.bottom - at.px(kStopBottom) - at.px(12);
    if (!hold_->isHidden()) {
        hold_->setGeometry(at.margin, fieldBottom - at.least, at.column, at.least);
        hold_->setType(at.type(kWords_px), at.type(kHead_px));
        fieldBottom -= at.least + at.px(kGap);
    }
    const int rows = rowsOfTargets();
    const int fieldTop = placeQuestion(at, fieldBottom, rows * at.least + std::max(0, rows - 1) * at.px(kGap));
    field_->setGeometry(at.margin, fieldTop, at.column, std::max(1, fieldBottom - fieldTop));
    field_->setType(at.type(kWords_px), at.type(kHead_px), at.px(kGap));
    line_->setFont(withPixels(at.type(kWords_px)));
    line_->setGeometry(at.margin, fieldTop, at.column, at.least);
    placeEnds(at, std::min(fieldTop + rows * pixelsOf(60, *this) + rows * at.px(kGap), fieldBottom));
}

/// Shows the progress of the session, and the note at the right.
void ParticipantFace::placeHead(const Picture& at) {
    const auto head = withPixels(at.type(kHead_px));
    const QFontMetrics metrics(head);
    const int high = metrics.height(), top = at.px(kTop);
    for (auto* label : {block_, note_, below_, leastWord_, mostWord_}) label->setFont(head);
    block_->setGeometry(at.margin, top, metrics.horizontalAdvance(block_->text()) + 2, high);
    const int barsLeft = block_->geometry().right() + at.px(kGap);
    blocks_->setGeometry(barsLeft, top + high / 2 - at.px(4), std::max(0, std::min(at.px(392), at.stopLeft - barsLeft)),
                         std::max(4, at.px(8)));
    const int noteWide = metrics.horizontalAdvance(note_->text()) + 2;
    note_->setGeometry(at.right - noteWide, top, noteWide, high);
}

void ParticipantFace::placeTime(const Picture& at) {
    const auto small = withPixels(std::max(11, at.type(kSmall_px)));
    const QFontMetrics metrics(small);
    const int high = metrics.height(), top = at.bottom - at.px(kMargin);
    timeWord_->setFont(small);
    const int wide = metrics.horizontalAdvance(timeWord_->text()) + 2;
    timeWord_->setGeometry(at.margin, top - high / 2, wide, high);
    time_->setGeometry(at.margin + wide + at.px(14), top - at.px(4), at.column - wide - at.px(14),
                       std::max(4, at.px(8)));
}

int ParticipantFace::rowsOfTargets() const {
    const bool asks =
        asked_ && asked_->kind != PromptKind::Hold && asked_->kind != PromptKind::Text && !isStopTestPrompt(*asked_);
    const int count = asks ? targetCount(*asked_) : 0;
    if (count == 0) return 0;
    const int columns = asked_->kind == PromptKind::Scale ? 6 : count <= 3 ? count : fieldColumns(count);
    return (count + columns - 1) / columns;
}

/// Returns the top of the targets, which need `wanted` pixels and have priority: if space is short, the second line is
/// left out first, then the question gets smaller.
int ParticipantFace::placeQuestion(const Picture& at, int fieldBottom, int wanted) {
    bool hasBelow = at.text < kLargeText * at.scale;  // with large text the targets have priority over the second line
    for (int title_px = at.type(kTitle_px);;) {
        title_->setFont(withPixels(title_px, QFont::Bold));
        const int titleHigh = title_->heightForWidth(at.column);
        title_->setGeometry(at.margin, at.stopTop, at.column, titleHigh);
        const int belowHigh = hasBelow && !below_->text().isEmpty() ? below_->heightForWidth(at.column) : 0;
        below_->setVisible(belowHigh > 0);
        below_->setGeometry(at.margin, at.stopTop + titleHigh + at.px(8), at.column, belowHigh);
        const int fieldTop = at.stopTop + titleHigh + (belowHigh > 0 ? belowHigh + at.px(8) : 0) + at.px(36);
        if (fieldBottom - fieldTop >= wanted) return fieldTop;
        if (hasBelow)
            hasBelow = false;
        else if (title_px > int(kHead_px * at.scale))
            title_px -= 2;
        else
            return fieldTop;
    }
}

/// Places the words at the ends of a scale, below its targets.
void ParticipantFace::placeEnds(const Picture& at, int top) {
    const bool ends = !leastWord_->text().isEmpty() || !mostWord_->text().isEmpty();
    leastWord_->setVisible(ends);
    mostWord_->setVisible(ends);
    if (!ends) return;
    const int high = QFontMetrics(leastWord_->font()).height();
    leastWord_->setGeometry(at.margin, top, at.column / 2, high);
    mostWord_->setGeometry(at.margin + at.column / 2, top, at.column - at.column / 2, high);
    mostWord_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
}

namespace {
constexpr int kShareGap = 8;
}

std::vector<double> blockShares(int block, int blocks, int trial, int trials) {
    std::vector<double> shares(std::size_t(std::max(0, blocks)), 0.0);
    for (int i = 0; i < blocks; ++i) {
        if (i + 1 < block) shares[std::size_t(i)] = 1;
        if (i + 1 != block || trials < blocks || trial < 1) continue;
        const double each = double(trials) / blocks;
        shares[std::size_t(i)] = std::clamp((trial - 1 - i * each) / each, 0.0, 1.0);
    }
    return shares;
}

ShareBars::ShareBars(QWidget* parent) : QWidget(parent) {}

void ShareBars::setShares(const std::vector<double>& shares) {
    if (shares == shares_) return;
    shares_ = shares;
    update();
}

void ShareBars::paintEvent(QPaintEvent* /*event*/) {
    if (shares_.empty()) return;
    QPainter painter(this);
    const auto& c = colours();
    const auto count = double(shares_.size());
    const double each = (width() - kShareGap * (count - 1)) / count;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        const QRectF bar(std::round(double(i) * (each + kShareGap)) + 0.5, 0.5, std::floor(each) - 1, height() - 1);
        painter.setPen(QPen(c.line, 1));
        painter.setBrush(c.sunken);
        painter.drawRect(bar);
        painter.setPen(Qt::NoPen);
        painter.setBrush(c.bar);
        const QRectF inside = bar.adjusted(-0.5, -0.5, 0.5, 0.5);
        painter.drawRect(QRectF(inside.topLeft(), QSizeF(inside.width() * shares_[i], inside.height())));
    }
}

}  // namespace tacto::gui

#include "moc_ParticipantFace.cpp"
