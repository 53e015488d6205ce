// Tests that Esc, Pause and Space stop wherever the focus is, and that Space types a space in text fields (H6).
#include <QCheckBox>
#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTest>
#include <QVBoxLayout>
#include <gtest/gtest.h>

#include "app/gui/window/StopKeys.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

class Keys : public testing::Test {
protected:
    Keys() {
        RecordProperty("hazard", "H2");
        auto* layout = new QVBoxLayout(&window);
        for (QWidget* widget : std::initializer_list<QWidget*>{&button, &check, &line, &spin})
            layout->addWidget(widget);
        QObject::connect(&button, &QPushButton::clicked, [this] { ++clicks; });
        window.show();
        EXPECT_IN_TIME(QTest::qWaitForWindowExposed(&window));
    }
    ~Keys() override {
        for (QWidget* widget : std::initializer_list<QWidget*>{&button, &check, &line, &spin})
            widget->setParent(nullptr);
    }
    /// Presses a key as a keyboard does: the window gets it and passes it to the focused widget.
    void press(Qt::Key key, QWidget& focus, const QString& text = {}) {
        focus.setFocus();
        QTest::sendKeyEvent(QTest::Click, focus.window()->windowHandle(), key, text, Qt::NoModifier);
        QCoreApplication::processEvents();
    }
    int stops = 0, clicks = 0;
    gui::StopKeys keys{[this](const char*) { ++stops; }, nullptr};
    QWidget window;
    QPushButton button{"Run"};
    QCheckBox check{"Check"};
    QLineEdit line;
    QSpinBox spin;
};

TEST_F(Keys, EscAndPauseStopFromEveryFocus) {
    for (QWidget* focus : std::initializer_list<QWidget*>{&button, &check, &line, &spin}) {
        for (const auto key : {Qt::Key_Escape, Qt::Key_Pause}) {
            const int before = stops;
            press(key, *focus);
            EXPECT_GT(stops, before) << focus->metaObject()->className() << " " << key;
        }
    }
}

/// Works with every modifier. X has another symbol for Ctrl+Pause, for which Qt has no key.
TEST_F(Keys, EscAndPauseStopWithEveryModifier) {
    const Qt::KeyboardModifier each[] = {Qt::ShiftModifier, Qt::ControlModifier, Qt::AltModifier, Qt::MetaModifier,
                                         Qt::KeypadModifier};
    for (unsigned held = 0; held < 32; ++held) {
        Qt::KeyboardModifiers modifiers;
        for (unsigned i = 0; i < 5; ++i)
            if ((held >> i & 1) != 0) modifiers |= each[i];
        for (QWidget* focus : std::initializer_list<QWidget*>{&button, &line, &spin}) {
            const bool breaks = modifiers.testFlag(Qt::ControlModifier);
            for (const auto& [key, symbol] :
                 {std::pair{int(Qt::Key_Escape), 0xFF1Bu},
                  breaks ? std::pair{0, 0xFF6Bu} : std::pair{int(Qt::Key_Pause), 0xFF13u}}) {
                focus->setFocus();
                QKeyEvent press(QEvent::KeyPress, key, modifiers, 0, symbol, 0);
                const int before = stops;
                QCoreApplication::sendEvent(focus, &press);
                EXPECT_GT(stops, before) << std::hex << symbol << " with " << int(modifiers);
            }
        }
    }
}

TEST_F(Keys, SpaceStopsAndPressesNothing) {
    press(Qt::Key_Space, button, " ");
    EXPECT_GE(stops, 1);
    EXPECT_EQ(clicks, 0);
    press(Qt::Key_Space, check, " ");
    EXPECT_FALSE(check.isChecked());
}

TEST_F(Keys, SpaceTypesInATextField) {
    line.setText("a");
    press(Qt::Key_Space, line, " ");
    EXPECT_EQ(line.text(), "a ");
    EXPECT_EQ(stops, 0);
}

TEST_F(Keys, SpaceStopsInATextFieldThatTakesNoText) {
    line.setReadOnly(true);
    press(Qt::Key_Space, line, " ");
    EXPECT_GE(stops, 1);
}

TEST_F(Keys, ReturnPressesTheFocusedButton) {
    press(Qt::Key_Return, button);
    EXPECT_EQ(clicks, 1);
    letLive(250);  // longer than the pause between repeats of a held key
    press(Qt::Key_Return, check);
    EXPECT_TRUE(check.isChecked());
    EXPECT_EQ(stops, 0);
}

TEST_F(Keys, AHeldReturnIsOnePress) {
    RecordProperty("hazard", "H12");
    for (int i = 0; i < 10; ++i) {
        press(Qt::Key_Return, button);  // not marked as a repeat, like most that X sends
        letLive(30);
    }
    EXPECT_EQ(clicks, 1);
}

/// The press closed the window that had the keys, so no window got the release.
TEST_F(Keys, ReturnWhoseReleaseIsLostPressesTheNextButton) {
    RecordProperty("hazard", "H12");
    button.setFocus();
    QTest::sendKeyEvent(QTest::Press, window.windowHandle(), Qt::Key_Return, QString(), Qt::NoModifier);
    EXPECT_EQ(clicks, 1);
    letLive(1200);
    press(Qt::Key_Return, button);
    EXPECT_EQ(clicks, 2);
}

TEST_F(Keys, ShiftF5StopsFromEveryFocus) {
    RecordProperty("hazard", "H2");
    for (QWidget* focus : std::initializer_list<QWidget*>{&button, &line}) {
        const int before = stops;
        focus->setFocus();
        QTest::sendKeyEvent(QTest::Click, window.windowHandle(), Qt::Key_F5, QString(), Qt::ShiftModifier);
        EXPECT_GT(stops, before);
    }
}

TEST_F(Keys, EscStopsFromAModalDialogAndClosesIt) {
    QDialog dialog(&window);
    QLineEdit text(&dialog);
    dialog.setModal(true);
    dialog.show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&dialog));
    press(Qt::Key_Escape, text);
    EXPECT_GE(stops, 1);
    EXPECT_FALSE(dialog.isVisible());
}

}  // namespace
}  // namespace tacto::test
