#include "app/gui/study/PassphraseEdit.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QInputMethodEvent>
#include <QKeyEvent>
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "core/base/Utf16.h"

namespace tacto::gui {

namespace {

bool continues(std::byte byte) { return (std::to_integer<unsigned>(byte) & 0xC0U) == 0x80U; }  // of UTF-8

}  // namespace

PassphraseEdit::PassphraseEdit(QWidget* parent) : QLineEdit(parent), held_(kMaxBytes) {
    setAccessibleName(tr("Passphrase"));
    setContextMenuPolicy(Qt::NoContextMenu);
    setAcceptDrops(false);
    setInputMethodHints(Qt::ImhHiddenText | Qt::ImhSensitiveData | Qt::ImhNoPredictiveText | Qt::ImhNoAutoUppercase);
}

Secret PassphraseEdit::typed() const { return Secret(held_.bytes().first(size_)); }

bool PassphraseEdit::equals(const PassphraseEdit& other) const noexcept {
    return size_ == other.size_ && std::ranges::equal(held_.bytes().first(size_), other.held_.bytes().first(size_));
}

void PassphraseEdit::wipe() {
    std::ranges::fill(held_.bytes(), std::byte{0});
    size_ = 0;
    showDots();
}

void PassphraseEdit::add(const QString& text) {
    for (const char32_t point : text.toUcs4()) {
        if (point < 0x20 || point == 0x7F) continue;
        std::array<char, 4> utf8{};
        const std::size_t bytes = encodeUtf8(point, utf8);
        if (size_ + bytes > held_.size()) break;
        std::memcpy(held_.bytes().data() + size_, utf8.data(), bytes);
        size_ += bytes;
    }
    showDots();
}

void PassphraseEdit::takeLast() {
    while (size_ > 0) {
        const auto byte = std::exchange(held_.bytes()[--size_], std::byte{0});
        if (!continues(byte)) break;
    }
    showDots();
}

void PassphraseEdit::showDots() {
    const auto all = held_.bytes().first(size_);
    setText(QString(qsizetype(std::ranges::count_if(all, [](std::byte byte) { return !continues(byte); })), u'●'));
    emit edited();
}

bool PassphraseEdit::event(QEvent* event) {
    // A letter is text here and no shortcut.
    if (event->type() == QEvent::ShortcutOverride && !static_cast<QKeyEvent*>(event)->text().isEmpty()) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (key->key() != Qt::Key_Escape && !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier)))
            event->accept();
    }
    return QLineEdit::event(event);
}

void PassphraseEdit::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Paste)) return add(QGuiApplication::clipboard()->text());
    switch (event->key()) {
        case Qt::Key_Backspace:
            return event->modifiers() & Qt::ControlModifier ? wipe() : takeLast();
        case Qt::Key_Return:
        case Qt::Key_Enter:
        case Qt::Key_Tab:
        case Qt::Key_Backtab:
        case Qt::Key_Escape:
            return QLineEdit::keyPressEvent(event);
        default:
            break;
    }
    const bool isText = !event->text().isEmpty() && event->text().front().isPrint() &&
                        (!(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier)) ||
                         event->modifiers() & Qt::GroupSwitchModifier || event->text().front().unicode() > 0x7F);
    if (isText)
        add(event->text());
    else
        event->ignore();
}

void PassphraseEdit::inputMethodEvent(QInputMethodEvent* event) {
    if (!event->commitString().isEmpty()) add(event->commitString());
    event->accept();
}

/// It gets the keys, and that is all: the end is the only place in it.
void PassphraseEdit::mousePressEvent(QMouseEvent* event) {
    setFocus(Qt::MouseFocusReason);
    event->accept();
}

void PassphraseEdit::mouseReleaseEvent(QMouseEvent* event) { event->accept(); }

}  // namespace tacto::gui

#include "moc_PassphraseEdit.cpp"
