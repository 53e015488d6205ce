#include "app/gui/window/StateBlock.h"

#include <QApplication>
#include <QGridLayout>
#include <algorithm>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr double kSmallest = 1.5;
constexpr double kStep = 0.1;
constexpr double kLegible_pt = 28;  // large enough to be read from two metres
constexpr int kBeforeWord = 56;     // room for the shape in front of the word
constexpr int kBehindWord = 24;
constexpr int kStateShape = 28;

QString longestWord(const QFontMetrics& metrics) {
    QString longest;
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        const auto word = stateStyle(InterlockState(state)).word;
        if (metrics.horizontalAdvance(word) > metrics.horizontalAdvance(longest)) longest = word;
    }
    return longest;
}

}  // namespace

StateBlock::StateBlock(QWidget* parent)
    : QFrame(parent), shape_(new QLabel(this)), word_(new QLabel(this)), reason_(new ElidedLabel(this)) {
    nameWidget(*this, "stateBlock", QObject::tr("State of the output"));
    word_->setObjectName("interlockState");
    shape_->setAlignment(Qt::AlignCenter);
    setTextSize(*reason_, TextSize::Small);
    reason_->setObjectName("interlockReason");
    auto* grid = layoutIn<QGridLayout>(*this, -1, {0, 0, scaledPx(8), 4});
    grid->setHorizontalSpacing(0);
    grid->setVerticalSpacing(0);
    grid->addWidget(shape_, 0, 0, 2, 1);
    grid->addWidget(word_, 0, 1);
    grid->addWidget(reason_, 1, 1);
    grid->setColumnStretch(1, 1);
    fit(widthAt(kDisplayText));
    show(state_, {}, false);
    colour();
    afterLookChange(*this, [this] { colour(); });
}

QFont StateBlock::wordFont(double scale) const {
    auto font = QApplication::font();
    font.setPointSizeF(font.pointSizeF() * scale);
    font.setBold(true);
    return font;
}

int StateBlock::widthAt(double scale) const {
    const QFontMetrics metrics(wordFont(scale));
    return metrics.horizontalAdvance(longestWord(metrics)) + scaledPx(kBeforeWord + kBehindWord);
}

int StateBlock::legibleWidth() const {
    return widthAt(std::clamp(kLegible_pt / QApplication::font().pointSizeF(), kSmallest, kDisplayText));
}

int StateBlock::smallestWidth() const { return widthAt(kSmallest); }

void StateBlock::fit(int width) {
    double scale = kDisplayText;
    while (scale > kSmallest && widthAt(scale) > width) scale -= kStep;
    scale = std::max(scale, kSmallest);
    const auto font = wordFont(scale);
    if (word_->font() == font && this->width() == widthAt(scale)) return;
    word_->setFont(font);
    shape_->setFixedWidth(scaledPx(kBeforeWord));
    setFixedWidth(widthAt(scale));
}

void StateBlock::show(InterlockState state, const QString& reason, bool pulse) {
    const auto style = stateStyle(state);
    word_->setText(style.word);
    reason_->setText(reason);
    reason_->setToolTip(reason);
    setAccessibleDescription(reason.isEmpty() ? style.word : style.word + ": " + reason);
    if (std::exchange(state_, state) != state) colour();
    showShape(pulse);
}

/// While output is being delivered, the dot grows with each train.
void StateBlock::showShape(bool pulse) {
    const auto style = stateStyle(state_);
    const int size = scaledPx(state_ == InterlockState::Delivering && !pulse ? kStateShape * 2 / 3 : kStateShape);
    const auto key = QString("%1 %2 %3").arg(style.icon, style.ink.name()).arg(size);
    if (std::exchange(shown_, key) == key) return;
    shape_->setPixmap(iconPixmap(style.icon, style.ink, size, devicePixelRatioF()));
}

/// Set by a style sheet, because under the program's style sheet a label's palette has no effect.
void StateBlock::colour() {
    const auto style = stateStyle(state_);
    const auto sheet = QString(
                           "QFrame#stateBlock { background: %1; border: none; border-right: 1px solid %3; }"
                           "QFrame#stateBlock QLabel { background: transparent; color: %2; }")
                           .arg(style.ground.name(), style.ink.name(),
                                (style.ground == colours().base ? colours().line : style.ground).name());
    if (styleSheet() != sheet) setStyleSheet(sheet);  // a new sheet also changes the palette
    showShape(false);
}

}  // namespace tacto::gui
