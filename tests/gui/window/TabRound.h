// TabRound.h - presses Tab until the focus comes back: which controls it reaches, in which order, and which it misses.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QRadioButton>
#include <QTest>
#include <QTextBrowser>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "tests/gui/Looks.h"

namespace tacto::test {

/// Returns the controls that Tab should reach: buttons and fields. Radio buttons are reached as a group; the field of a
/// combo box gives its focus to the box.
inline std::vector<QWidget*> controlsOf(const QWidget& in) {
    std::vector<QWidget*> controls;
    for (auto* control : in.findChildren<QWidget*>()) {
        const bool works = qobject_cast<QAbstractButton*>(control) || qobject_cast<QComboBox*>(control) ||
                           qobject_cast<QLineEdit*>(control) || qobject_cast<QAbstractSpinBox*>(control);
        if (!works || !control->isVisible() || !control->isEnabled() || control->window() != in.window()) continue;
        if ((control->focusPolicy() & Qt::TabFocus) == 0) continue;
        if (qobject_cast<QRadioButton*>(control) || control->focusProxy() != nullptr ||
            qobject_cast<QAbstractSpinBox*>(control->parentWidget()) ||
            qobject_cast<QComboBox*>(control->parentWidget()))
            continue;
        controls.push_back(control);
    }
    return controls;
}

/// Presses Tab from `first` until the focus comes back, and calls `look` with each widget reached.
inline std::set<const QWidget*> tabFrom(
    QWidget& first, const std::function<void(QWidget&)>& look = [](QWidget&) {}) {
    first.setFocus(Qt::TabFocusReason);
    std::set<const QWidget*> reached;
    const QWidget* before = nullptr;
    constexpr int kMaxPresses = 300;
    for (int i = 0; i < kMaxPresses; ++i) {
        auto* at = QApplication::focusWidget();
        if (at == nullptr) {
            ADD_FAILURE() << "Tab leads nowhere from " << (before != nullptr ? widgetName(*before) : "the start");
            return reached;
        }
        const bool amongLinks = at == before && qobject_cast<QTextBrowser*>(at) != nullptr;
        if (!amongLinks && !reached.insert(at).second) {
            EXPECT_EQ(at, &first) << "Tab does not leave " << widgetName(*at);
            return reached;
        }
        EXPECT_TRUE(at->isVisible() && at->isEnabled()) << widgetName(*at);
        if (!amongLinks) look(*at);
        before = at;
        QTest::keyClick(at, Qt::Key_Tab);
    }
    ADD_FAILURE() << "Tab does not come round";
    return reached;
}

inline void expectAllReached(const QWidget& in, const std::set<const QWidget*>& reached) {
    for (const auto* control : controlsOf(in)) EXPECT_TRUE(reached.contains(control)) << widgetName(*control);
}

}  // namespace tacto::test
