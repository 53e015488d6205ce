// Person.h - what a test does at the window: waits for what it sees, finds by what is written, types and clicks.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QString>
#include <QWidget>
#include <functional>

#include "core/devices/Registry.h"

namespace tacto::test {

/// Lets the window live until `isSo`; false after `limit_ms`.
[[nodiscard]] bool comesTrue(const std::function<bool()>& isSo, int limit_ms = 10'000);

/// Lets the window live for `ms`, and for as many turns of its event loop as an idle machine makes in that time: on a
/// busy one a wait by the clock alone can end before anything is laid out.
void letLive(int ms);

/// The visible widget of a kind with this text (buttons, labels, tabs: without mnemonic), name or accessible name.
template <class T>
[[nodiscard]] T* find(const QWidget& in, const QString& text);
[[nodiscard]] bool answersTo(const QWidget& widget, const QString& text);

/// Clicks in the middle with the left button.
void click(QWidget& widget);

/// Simulated bench and recordings, as the program has them.
[[nodiscard]] Registry simulatedRegistry();

/// A PNG of the widget in $TACTO_SHOTS/NAME.png; nothing without that variable.
void shot(QWidget& widget, const QString& name);

template <class T>
T* find(const QWidget& in, const QString& text) {
    for (auto* widget : in.findChildren<T*>()) {
        if (widget->isVisible() && answersTo(*widget, text)) return widget;
    }
    return nullptr;
}

}  // namespace tacto::test
