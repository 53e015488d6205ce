#include "app/gui/pilot/ParticipantField.h"

#include <QGridLayout>
#include <QMouseEvent>
#include <QPainter>
#include <QScreen>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kInch_mm = 25.4, kUsualDpi = 96;
constexpr int kLowRow = 54, kFullRow = 100;  // kLowRow: the row of "nothing" and "not sure"
constexpr int kTallestTarget_mm = 60;

}  // namespace

int pixelsOf(double mm, const QWidget& on) {
    const auto* screen = on.screen();
    const double said = screen == nullptr ? kUsualDpi : screen->physicalDotsPerInch();
    const bool plausible = said >= 50 && said <= 400;
    return int(std::ceil(mm / kInch_mm * (plausible ? said : kUsualDpi)));
}

QStringList iconsOf(const std::string& key) {
    if (key == "none") return {"state-disarmed"};
    if (key == "not-sure") return {"help"};
    const auto has = [&](const char* word) { return key.find(word) != std::string::npos; };
    QStringList icons;
    if (has("smooth") || has("rough")) icons << (has("smooth") ? "smooth" : "rough");
    if (has("low") || has("high")) icons << (has("high") ? "firm" : "light");
    return icons.size() == 2 ? icons : QStringList();
}

int fieldColumns(int count) { return count <= 3 ? std::max(1, count) : count <= 8 ? 2 : count <= 12 ? 3 : 4; }

ParticipantField::ParticipantField(QWidget* parent) : QWidget(parent) {}

void ParticipantField::drop() {
    for (auto* target : targets_) {
        target->hide();
        target->deleteLater();  // perhaps called from a press on this target
    }
    targets_.clear();
    setAccessibleName({});
}

void ParticipantField::clear() {
    drop();
    content_ = Content::Nothing;
    update();
}

void ParticipantField::showDot() {
    drop();
    content_ = Content::Dot;
    update();
}

void ParticipantField::showWord(const QString& word, const QStringList& icons) {
    drop();
    content_ = Content::Word;
    word_ = word;
    setAccessibleName(word);  // what is painted is told to a screen reader too
    wordIcons_ = icons;
    update();
}

void ParticipantField::showIntervals(int passing) {
    drop();
    content_ = Content::Intervals;
    passing_ = passing;
    if (passing > 0) setAccessibleName(QString::number(passing));
    update();
}

void ParticipantField::showTargets(const PilotPrompt& prompt, const AnswerKeys& keys, const QStringList& buttons) {
    drop();
    content_ = Content::Targets;
    kind_ = prompt.kind;
    const bool condition = kind_ == PromptKind::Condition;
    const int count = targetCount(prompt);
    for (int i = 0; i < count; ++i) {
        const bool scale = kind_ == PromptKind::Scale;
        const auto* told = std::size_t(i) < prompt.targets.size() ? &prompt.targets[std::size_t(i)] : nullptr;
        auto words = scale ? QString::number(prompt.least + i) : told != nullptr ? qtext(told->text) : QString();
        if (condition && !words.isEmpty()) words[0] = words[0].toLower();
        const auto icons = condition && told != nullptr ? iconsOf(told->key) : QStringList();
        auto* target = new AnswerTarget(this);
        target->setObjectName(told != nullptr ? qtext(told->key) : words);
        const bool row = (condition && i >= 4) || count > 4;
        target->setContent(words, icons, keys.text(i), buttons.value(i),
                           scale || (row && !condition && icons.isEmpty() && count <= 6) ? AnswerTarget::Shape::Stacked
                           : condition && i < 4                                          ? AnswerTarget::Shape::Stacked
                           : row                                                         ? AnswerTarget::Shape::Row
                                 : AnswerTarget::Shape::Stacked);
        target->setType(words_px_, key_px_);
        target->setCheckable(kind_ == PromptKind::Several);
        connect(target, &AnswerTarget::wentDown, this, [this, i](SteadyTime at) { emit chosenAt(i, at); });
        targets_.push_back(target);
    }
    arrange();
    for (auto* target : targets_) target->show();
    update();
}

void ParticipantField::setType(int words_px, int key_px, int gap_px) {
    words_px_ = words_px;
    key_px_ = key_px;
    gap_px_ = gap_px;
    for (auto* target : targets_) target->setType(words_px, key_px);
    arrange();
}

void ParticipantField::setChosen(int target, bool chosen) { targets_.at(std::size_t(target))->setChecked(chosen); }

bool ParticipantField::chosen(int target) const { return targets_.at(std::size_t(target))->isChecked(); }

/// Targets are at least 20 mm. Targets for conditions fill the field; "nothing" and "not sure" are lower.
void ParticipantField::arrange() {
    if (content_ != Content::Targets || targets_.empty()) return;
    const int count = int(targets_.size());
    const int columns = kind_ == PromptKind::Scale ? std::min(6, count) : fieldColumns(count);
    const int rows = (count + columns - 1) / columns, least = pixelsOf(kTarget_mm, *this);
    const bool whole = kind_ == PromptKind::Condition;
    delete layout();
    auto* grid = layoutIn<QGridLayout>(*this, gap_px_, {});
    for (int i = 0; i < count; ++i) {
        auto* target = targets_[std::size_t(i)];
        target->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
        target->setMinimumSize(least, least);
        target->setMaximumHeight(whole ? QWIDGETSIZE_MAX : std::max(least, pixelsOf(kTallestTarget_mm, *this)));
        grid->addWidget(target, i / columns, i % columns);
    }
    for (int column = 0; column < columns; ++column) grid->setColumnStretch(column, 1);
    for (int row = 0; row < rows; ++row) grid->setRowStretch(row, whole && rows == 3 && row == 2 ? kLowRow : kFullRow);
    if (!whole) grid->setRowStretch(rows, 1);
    alignWords();
}

/// Uses one letter size for all targets: one with smaller letters would be chosen less often.
void ParticipantField::alignWords() {
    if (content_ != Content::Targets || layout() == nullptr) return;
    layout()->activate();
    int px = words_px_;
    for (const auto* target : targets_) px = std::min(px, target->fittingPx());
    for (auto* target : targets_) target->limitWords(px);
}

void ParticipantField::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    alignWords();
}

void ParticipantField::mousePressEvent(QMouseEvent* /*event*/) { emit missed(); }

void ParticipantField::paintIntervals(QPainter& painter) const {
    constexpr double kRounding = 8, kOutline = 2;
    const auto& c = colours();
    const double wide = (width() - gap_px_) / 2.0;
    const double high = std::min(height(), pixelsOf(kTallestTarget_mm, *this));
    auto font = textFont(TextSize::Display, QFont::Bold);
    font.setPixelSize(std::max(1, int(std::min(words_px_ * 2.5, high * 0.6))));
    painter.setFont(font);
    for (const int interval : {1, 2}) {
        const bool passes = interval == passing_;
        const QRectF box((interval - 1) * (wide + gap_px_), 0, wide, high);
        painter.setPen(QPen(passes ? c.text : c.edge, kOutline));
        painter.setBrush(passes ? c.text : c.base);
        painter.drawRoundedRect(box.adjusted(1, 1, -1, -1), kRounding, kRounding);
        painter.setPen(passes ? c.base : c.quiet);
        painter.drawText(box, Qt::AlignCenter, QString::number(interval));
    }
}

void ParticipantField::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto& c = colours();
    const QPointF middle(width() / 2.0, height() / 2.0);
    if (content_ == Content::Dot) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(c.text);
        painter.drawEllipse(middle, gap_px_ / 1.5, gap_px_ / 1.5);
    }
    if (content_ == Content::Intervals) paintIntervals(painter);
    if (content_ != Content::Word) return;
    auto font = textFont(TextSize::Display, QFont::Bold);
    font.setPixelSize(int(words_px_ * 1.5));
    const QFontMetrics metrics(font);
    const int icon = words_px_ * 3, gap = words_px_;
    const int high = metrics.height() + (wordIcons_.isEmpty() ? 0 : icon + gap);
    int y = (height() - high) / 2;
    int x = (width() - int(wordIcons_.size()) * (icon + gap) + gap) / 2;
    for (const auto& name : wordIcons_) {
        painter.drawPixmap(x, y, iconPixmap(name, c.text, icon, devicePixelRatioF()));
        x += icon + gap;
    }
    if (!wordIcons_.isEmpty()) y += icon + gap;
    painter.setFont(font);
    painter.setPen(c.text);
    painter.drawText(QRect(0, y, width(), metrics.height()), Qt::AlignCenter, word_);
}

}  // namespace tacto::gui

#include "moc_ParticipantField.cpp"
