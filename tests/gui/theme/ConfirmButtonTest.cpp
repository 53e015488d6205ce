// Tests that the button of a second step ignores presses made before it was visible (H12).
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <gtest/gtest.h>

#include "app/gui/theme/ConfirmButton.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

class ConfirmButton : public testing::Test {
protected:
    ConfirmButton() { RecordProperty("hazard", "H12"); }
    void show() {
        page.show();
        ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&page));
    }
    /// Sends a press that was made some time ago but arrives only now.
    void pressed(steady_clock::duration ago) {
        const QPointF middle = button.rect().center();
        const auto at = (steady_clock::now() - ago).time_since_epoch();
        for (const auto type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease}) {
            const bool isDown = type == QEvent::MouseButtonPress;
            QMouseEvent event(type, middle, button.mapToGlobal(middle), Qt::LeftButton,
                              isDown ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
            event.setTimestamp(quint64(std::chrono::duration_cast<std::chrono::milliseconds>(at).count()));
            QCoreApplication::sendEvent(&button, &event);
        }
    }

    QWidget page;
    gui::ConfirmButton& button = *new gui::ConfirmButton("Deliver", &page);
    QSignalSpy clicked{&button, &QPushButton::clicked};
};

TEST_F(ConfirmButton, TakesNoPressThatWasMadeBeforeItCouldBeRead) {
    show();
    letLive(700);
    pressed(600ms);
    EXPECT_EQ(clicked.size(), 0) << "within 0.1 s after it came into sight, though it arrives after 0.7 s";
    pressed(1500ms);
    EXPECT_EQ(clicked.size(), 0) << "before it was there";
    pressed(0ms);
    EXPECT_EQ(clicked.size(), 1);
}

TEST_F(ConfirmButton, IsDeafUntilItHasBeenPainted) {
    page.setUpdatesEnabled(false);
    show();
    letLive(700);
    pressed(0ms);
    EXPECT_EQ(clicked.size(), 0) << "it was shown, and the window has not painted it";
    page.setUpdatesEnabled(true);
    ASSERT_IN_TIME(comesTrue([this] { return button.listens(); }));
    pressed(0ms);
    EXPECT_EQ(clicked.size(), 1);
}

TEST_F(ConfirmButton, WithAnotherMeaningIsNewInSight) {
    button.setMeaning("Pause", false);
    show();
    letLive(700);
    button.setMeaning("Resume", true);
    letLive(700);
    pressed(600ms);
    EXPECT_EQ(clicked.size(), 0) << "meant for what stood there before, or made too soon after";
    pressed(0ms);
    EXPECT_EQ(clicked.size(), 1);
}

}  // namespace
}  // namespace tacto::test
