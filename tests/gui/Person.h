// Person.h - lets a test act like a person at the window: waits, finds widgets by their text, types and clicks.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QString>
#include <QWidget>
#include <functional>

#include "core/devices/Registry.h"

namespace tacto::test {

/// Lets the window run until `isSo` is true; returns false after `limit_ms`.
[[nodiscard]] bool comesTrue(const std::function<bool()>& isSo, int limit_ms = 10'000);

/// Lets the window run for `ms`, and for as many turns of its event loop as an idle machine makes in that time: on a
/// busy machine a wait by the clock alone could end before anything is laid out.
void letLive(int ms);

/// Finds the visible widget of class T with this text (without mnemonic), object name or accessible name.
template <class T>
[[nodiscard]] T* find(const QWidget& in, const QString& text);
[[nodiscard]] bool answersTo(const QWidget& widget, const QString& text);

/// Clicks the middle of the widget with the left button.
void click(QWidget& widget);

/// A registry of the simulated bench and recordings, as in the program.
[[nodiscard]] Registry simulatedRegistry();

/// Saves a picture of the widget as $TACTO_SHOTS/NAME.png; does nothing without that variable.
void shot(QWidget& widget, const QString& name);

template <class T>
T* find(const QWidget& in, const QString& text) {
    for (auto* widget : in.findChildren<T*>()) {
        if (widget->isVisible() && answersTo(*widget, text)) return widget;
    }
    return nullptr;
}

}  // namespace tacto::test
