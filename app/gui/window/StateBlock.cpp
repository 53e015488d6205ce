#include "app/gui/window/StateBlock.h"

#include <QApplication>
#include <QEvent>
#include <QGridLayout>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

constexpr double kSmallest = 1.5;
constexpr double kStep = 0.1;
constexpr int kPadding = 16;

QString longestWord(const QFontMetrics& metrics) {
    QString longest;
    for (int state = 0; state <= int(InterlockState::Faulted); ++state) {
        const auto word = stateLook(InterlockState(state)).word;
        if (metrics.horizontalAdvance(word) > metrics.horizontalAdvance(longest)) longest = word;
    }
    return longest;
}

}  // namespace

StateBlock::StateBlock(QWidget* parent)
    : QFrame(parent), shape_(new QLabel(this)), word_(new QLabel(this)), reason_(new ElidedLabel(this)) {
    setObjectName("stateBlock");
    setAccessibleName(QObject::tr("State of the output"));
    word_->setObjectName("interlockState");
    shape_->setAlignment(Qt::AlignCenter);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(kPadding / 2, 4, kPadding / 2, 4);
    grid->setHorizontalSpacing(kPadding / 2);
    grid->setVerticalSpacing(0);
    grid->addWidget(shape_, 0, 0, 2, 1);
    grid->addWidget(word_, 0, 1);
    grid->addWidget(reason_, 1, 1);
    grid->setColumnStretch(1, 1);
    fit(widthAt(kDisplayText));
    show(state_, {}, false);
    colour();
}

QFont StateBlock::wordFont(double scale) const {
    auto font = QApplication::font();
    font.setPointSizeF(font.pointSizeF() * scale);
    font.setBold(true);
    return font;
}

int StateBlock::widthAt(double scale) const {
    const QFontMetrics metrics(wordFont(scale));
    return metrics.horizontalAdvance(longestWord(metrics)) + metrics.horizontalAdvance("●") + kPadding * 2;
}

int StateBlock::smallestWidth() const { return widthAt(kSmallest); }

void StateBlock::fit(int width) {
    double scale = kDisplayText;
    while (scale > kSmallest && widthAt(scale) > width) scale -= kStep;
    scale = std::max(scale, kSmallest);
    const auto font = wordFont(scale);
    if (word_->font() == font && this->width() == widthAt(scale)) return;
    word_->setFont(font);
    shape_->setFont(font);
    shape_->setFixedWidth(QFontMetrics(font).horizontalAdvance("●") + kPadding / 2);
    setFixedWidth(widthAt(scale));
}

void StateBlock::show(InterlockState state, const QString& reason, bool pulse) {
    const auto look = stateLook(state);
    shape_->setText(state == InterlockState::Delivering && !pulse ? "○" : look.shape);
    word_->setText(look.word);
    reason_->setText(reason);
    reason_->setToolTip(reason);
    setAccessibleDescription(reason.isEmpty() ? look.word : look.word + ": " + reason);
    if (std::exchange(state_, state) != state) colour();
}

/// As a sheet: under the program's own sheet a label's palette does not hold.
void StateBlock::colour() {
    const auto look = stateLook(state_);
    const auto sheet = QString(
                           "QFrame#stateBlock { background: %1; border: none; }"
                           "QFrame#stateBlock QLabel { background: transparent; color: %2; }")
                           .arg(look.ground.name(), look.ink.name());
    if (styleSheet() != sheet) setStyleSheet(sheet);  // which changes the palette, too
}

void StateBlock::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) {
        // Once the new theme is in place everywhere.
        QMetaObject::invokeMethod(
            this, [this] { colour(); }, Qt::QueuedConnection);
    }
    QFrame::changeEvent(event);
}

}  // namespace tacto::gui
