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
        shown_.start();
    }
    setText(text);
}

bool ConfirmButton::listens() const {
    return !confirms_ || (isVisible() && shown_.isValid() && shown_.elapsed() >= kDebounce_ms);
}

bool ConfirmButton::event(QEvent* event) {
    const bool hasMnemonic = !meaning_.isEmpty();
    return (event->type() == QEvent::Shortcut && !(hasMnemonic && listens())) || QPushButton::event(event);
}

void ConfirmButton::showEvent(QShowEvent* event) {
    shown_.start();
    QPushButton::showEvent(event);
}

void ConfirmButton::mousePressEvent(QMouseEvent* event) {
    if (listens()) return QPushButton::mousePressEvent(event);
    event->accept();
}

void ConfirmButton::mouseDoubleClickEvent(QMouseEvent* event) {
    if (!confirms_) return QPushButton::mouseDoubleClickEvent(event);
    event->accept();
}

}  // namespace tacto::gui

#include "moc_ConfirmButton.cpp"
