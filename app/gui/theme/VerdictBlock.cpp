#include "app/gui/theme/VerdictBlock.h"

#include <QPainter>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"
#include "app/report/ResultCells.h"

namespace tacto::gui {

namespace {

constexpr int kHeight = 72;
constexpr int kWidth = 216;
constexpr int kIcon = 32;
constexpr int kPadding = 16;

}  // namespace

VerdictStyle verdictStyle(const QString& key) {
    const auto& c = colours();
    const auto shape = verdictShape(key);
    const auto amber = [&](const QString& mark, const char* icon, const QString& word) {
        return VerdictStyle{mark, icon, word, c.amberCell, c.amberText, c.amberText};
    };
    if (key == "pass") return {shape, "verdict-pass", QObject::tr("PASS"), c.pass, Qt::white, c.passText};
    if (key == "fail") return {shape, "verdict-fail", QObject::tr("FAIL"), c.fail, c.failText, c.text};
    if (key == "stopped") return {shape, "verdict-stopped", QObject::tr("STOPPED"), c.sunken, c.text, c.quiet};
    if (key == "indeterminate") return amber(shape, "verdict-indeterminate", QObject::tr("INDETERMINATE"));
    if (key == "error") return amber("✖", "verdict-attention", QObject::tr("DID NOT RUN TO ITS END"));
    if (key == "attention") return amber(shape, "verdict-attention", QObject::tr("ATTENTION"));
    if (key == "refused as expected")
        return {shape, "verdict-refused", QObject::tr("REFUSED AS EXPECTED"), c.amberCell, c.amberText, c.text};
    if (key == "not evaluated")
        return {shape, "verdict-not-evaluated", QObject::tr("NOT EVALUATED"), c.sunken, c.text, c.text};
    if (key == "not applicable")
        return {shape, "verdict-none", QObject::tr("NOT APPLICABLE"), c.sunken, c.text, c.quiet};
    return {shape, "verdict-none", QObject::tr("NO VERDICT"), c.sunken, c.text, c.quiet};
}

QString verdictText(const QString& key) { return verdictCell(key).replace(QChar(0x00a0), ' '); }

VerdictBlock::VerdictBlock(QWidget* parent) : QLabel(parent) {
    setObjectName("verdict");
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    onFontChange(*this, [this] { updateGeometry(); });
}

void VerdictBlock::setVerdict(const QString& key) {
    key_ = key;
    setText(verdictStyle(key).word);
    updateGeometry();
    update();
}

QSize VerdictBlock::sizeHint() const {
    const QFontMetrics word(textFont(TextSize::Display, QFont::Bold));
    return {std::max(scaledPx(kWidth), word.horizontalAdvance(text()) + scaledPx(kIcon) + 3 * kPadding),
            std::max(scaledPx(kHeight), word.height())};
}

void VerdictBlock::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto style = verdictStyle(key_);
    painter.setPen(Qt::NoPen);
    painter.setBrush(style.fill);
    painter.drawRoundedRect(rect(), 4, 4);
    const int size = scaledPx(kIcon);
    painter.drawPixmap(kPadding, (height() - size) / 2, iconPixmap(style.icon, style.ink, size, devicePixelRatioF()));
    painter.setFont(textFont(TextSize::Display, QFont::Bold));
    painter.setPen(style.ink);
    painter.drawText(rect().adjusted(2 * kPadding + size, 0, -kPadding, 0), Qt::AlignLeft | Qt::AlignVCenter,
                     style.word);
}

}  // namespace tacto::gui

#include "moc_VerdictBlock.cpp"
