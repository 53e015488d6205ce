#include "app/gui/look/ConfirmButton.h"

#include <QMouseEvent>

namespace tacto::gui {

ConfirmButton::ConfirmButton(const QString& text, QWidget* parent) : QPushButton(parent) {
    setText(QString(text).replace('&', "&&"));
    setAutoDefault(false);
    setDefault(false);
}

bool ConfirmButton::listens() const { return isVisible() && shown_.isValid() && shown_.elapsed() >= kDeaf_ms; }

bool ConfirmButton::event(QEvent* event) { return event->type() == QEvent::Shortcut || QPushButton::event(event); }

void ConfirmButton::showEvent(QShowEvent* event) {
    shown_.start();
    QPushButton::showEvent(event);
}

void ConfirmButton::mousePressEvent(QMouseEvent* event) {
    if (listens()) return QPushButton::mousePressEvent(event);
    event->accept();
}

void ConfirmButton::mouseDoubleClickEvent(QMouseEvent* event) { event->accept(); }

}  // namespace tacto::gui
