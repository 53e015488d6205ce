#include "tests/gui/Person.h"

#include <QAbstractButton>
#include <QDir>
#include <QLabel>
#include <QPixmap>
#include <QTest>
#include <algorithm>

#include "app/gui/theme/ConfirmButton.h"
#include "drivers/replay/ReplayDrivers.h"
#include "drivers/simulated/SimulatedDriver.h"

namespace tacto::test {

bool comesTrue(const std::function<bool()>& isSo, int limit_ms) { return QTest::qWaitFor(isSo, limit_ms); }

void letLive(int ms) {
    constexpr int kTurn_ms = 10;
    for (int left_ms = ms; left_ms > 0; left_ms -= kTurn_ms) QTest::qWait(std::min(left_ms, kTurn_ms));
}

bool answersTo(const QWidget& widget, const QString& text) {
    const auto plain = [](QString written) { return written.remove('&'); };
    if (widget.objectName() == text || widget.accessibleName() == text) return true;
    if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) return plain(button->text()) == text;
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) return plain(label->text()) == text;
    return false;
}

void click(QWidget& widget) {
    // A person reads this button before pressing it.
    if (const auto* confirm = qobject_cast<const gui::ConfirmButton*>(&widget))
        static_cast<void>(comesTrue([&] { return confirm->listens(); }));
    QTest::mouseClick(&widget, Qt::LeftButton);
}

Registry simulatedRegistry() {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSimulatedDriver());
    drivers.push_back(makeRecordingDriver());
    drivers.push_back(makeCaptureDriver());
    return Registry(std::move(drivers));
}

void shot(QWidget& widget, const QString& name) {
    const auto folder = qEnvironmentVariable("TACTO_SHOTS");
    if (folder.isEmpty()) return;
    QDir().mkpath(folder);
    letLive(150);  // time to lay out the widget
    widget.grab().save(folder + "/" + name + ".png");
}

}  // namespace tacto::test
