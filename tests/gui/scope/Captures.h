// Captures.h - captures with known values for the oscilloscope's tests, and positions for the mouse on its screen.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTest>

#include "app/gui/scope/screen/ScopeGestures.h"
#include "tests/measure/SyntheticPulses.h"

namespace tacto::test {

/// Returns two biphasic pulses 4 ms apart (40 V and 40 mA, 200 µs per phase, 100 µs gap) in a record of 10 ms,
/// triggered at 1 ms, at 100 s on the session's clock.
inline Capture twoPulses(double start_s = 99.999, double level = 40) {
    std::vector<SyntheticPhase> phases;
    append(phases, biphasic(start_s + 1e-3, level));
    append(phases, biphasic(start_s + 5e-3, level));
    SyntheticRecord record;
    record.start_s = start_s;
    record.noise = 0.02;
    auto capture = recordOf(phases, record);
    capture.trigger_s = start_s + 1e-3;
    capture.simulated = true;
    auto& volts = capture.channels.front();
    volts.low = -50;
    volts.high = 50;
    auto amps = volts;
    amps.name = "current";
    amps.unit = "A";
    amps.low = -0.2;
    amps.high = 0.2;
    for (auto& x : amps.samples) x *= 1e-3F;
    capture.channels.push_back(std::move(amps));
    return capture;
}

inline gui::ShownPtr prepared(Capture capture, const gui::MathOptions& math = {}) {
    return gui::prepareCapture(std::make_shared<const Capture>(std::move(capture)), math);
}

/// The pixel of a place on the screen, in divisions from the left and above the middle.
inline QPoint at(const gui::ScopeScreen& screen, double across, double up) {
    const auto area = screen.area();
    return {static_cast<int>(std::lround(area.left() + across / 10 * area.width())),
            static_cast<int>(std::lround(area.top() + (0.5 - up / 8) * area.height()))};
}

/// The pixel of a time on the axis and a height.
inline QPoint atTime(const gui::ScopeScreen& screen, double time_s, double up) {
    return at(screen,
              (time_s - screen.timeAt(screen.area().left())) / (screen.area().width() * screen.secondsPerPixel()) * 10,
              up);
}

inline void drag(QWidget& widget, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mouseMove(&widget, from);
    QTest::mousePress(&widget, Qt::LeftButton, modifiers, from);
    for (int i = 1; i <= 5; ++i) {
        const QPoint there = from + (to - from) * i / 5;
        QMouseEvent move(QEvent::MouseMove, there, widget.mapToGlobal(there), Qt::NoButton, Qt::LeftButton, modifiers);
        QCoreApplication::sendEvent(&widget, &move);
    }
    QTest::mouseRelease(&widget, Qt::LeftButton, modifiers, to);
}

inline void turnWheel(QWidget& widget, QPoint where, int clicks, Qt::KeyboardModifiers modifiers = {}) {
    QWheelEvent event(where, widget.mapToGlobal(where), {}, {0, 120 * clicks}, Qt::NoButton, modifiers,
                      Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&widget, &event);
}

inline void hoverAt(QWidget& widget, QPoint where) {
    QMouseEvent move(QEvent::MouseMove, where, widget.mapToGlobal(where), Qt::NoButton, Qt::NoButton, {});
    QCoreApplication::sendEvent(&widget, &move);
}

}  // namespace tacto::test
