#include "app/gui/theme/ConfirmButton.h"

#include <QMouseEvent>

namespace tacto::gui {

ConfirmButton::ConfirmButton(const QString& text, QWidget* parent) : QPushButton(parent) {
    setText(QString(text).replace('&', "&&"));
    setAutoDefault(false);
    setDefault(false);
}

void ConfirmButton::setMeaning(const QString& text, bool confirms) {
    if (text == meaning_) return;
    meaning_ = text;
    confirms_ = confirms;
    if (confirms) {
        setDown(false);
        seen_.reset();
    }
    setText(text);
}

bool ConfirmButton::listens(SteadyTime pressed) const {
    return !confirms_ || (isVisible() && seen_ && pressed - *seen_ >= std::chrono::milliseconds(kDebounce_ms));
}

bool ConfirmButton::event(QEvent* event) {
    const bool hasMnemonic = !meaning_.isEmpty();
    return (event->type() == QEvent::Shortcut && !(hasMnemonic && listens())) || QPushButton::event(event);
}

void ConfirmButton::showEvent(QShowEvent* event) {
    seen_.reset();
    QPushButton::showEvent(event);
}

void ConfirmButton::paintEvent(QPaintEvent* event) {
    QPushButton::paintEvent(event);
    if (!seen_) seen_ = std::chrono::steady_clock::now();
}

void ConfirmButton::mousePressEvent(QMouseEvent* event) {
    if (listens(timeOf(*event))) return QPushButton::mousePressEvent(event);
    event->accept();
}

void ConfirmButton::mouseDoubleClickEvent(QMouseEvent* event) {
    if (!confirms_) return QPushButton::mouseDoubleClickEvent(event);
    event->accept();
}

SteadyTime timeOf(quint64 stamp_ms, SteadyTime arrival) {
    using std::chrono::milliseconds;
    constexpr quint32 kSameClock_ms = 10'000;
    const auto now_ms = std::chrono::duration_cast<milliseconds>(arrival.time_since_epoch()).count();
    const auto age_ms = quint32(now_ms) - quint32(stamp_ms);  // correct even if one of them wrapped round
    return age_ms <= kSameClock_ms ? arrival - milliseconds(age_ms) : arrival;
}

SteadyTime timeOf(const QInputEvent& event) { return timeOf(event.timestamp(), std::chrono::steady_clock::now()); }

}  // namespace tacto::gui

#include "moc_ConfirmButton.cpp"
