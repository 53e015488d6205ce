// ScopeBench.h - the oscilloscope on a simulated bench, as at the first start without stored settings.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QSettings>
#include <algorithm>
#include <gtest/gtest.h>

#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/measurements/MeasurementTable.h"
#include "app/gui/scope/screen/ScopeScreen.h"
#include "tests/gui/Person.h"
#include "tests/gui/scope/Captures.h"
#include "tests/support/InTime.h"

namespace tacto::test {

class Scope : public testing::Test {
protected:
    Scope() {
        scope.resize(1280, 760);
        scope.QWidget::show();
        QObject::connect(&controller, &gui::BenchController::failed,
                         [this](const QString& what) { complaints << what; });
    }
    void openBench(const char* oscilloscope = nullptr, double speed = 1) {
        gui::LiveOrder order;
        if (oscilloscope != nullptr) order.uris.push_back(*DeviceUri::parse(oscilloscope));
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = controller.profile();
        order.speed = speed;
        controller.openLive(order);
        ASSERT_IN_TIME(comesTrue([this] { return controller.activity() == gui::Activity::Live; }));
    }
    void deliver() {
        ArmRequest request;
        request.load = "1 kohm";
        request.operatorConfirmed = true;
        controller.arm(request);
        ASSERT_IN_TIME(comesTrue([this] { return controller.telemetry().state == InterlockState::Armed; }));
        controller.drive(DriveSource::Manual, 0.5, 0.8);
    }
    /// Opens a bench that delivers, and waits until its first train is on the screen.
    void showATrain() {
        openBench();
        deliver();
        ASSERT_IN_TIME(comes([this] { return triggered(); }));
    }
    void showTwoPulses() {
        scope.show(std::make_shared<const Capture>(twoPulses()));
        ASSERT_IN_TIME(comes([this] { return scope.model().shown() != nullptr; }));
    }
    /// Waits while refreshing at 30 Hz, as the window does.
    bool comes(const std::function<bool()>& isSo) {
        return comesTrue([&] {
            scope.refresh(controller.telemetry());
            return isSo();
        });
    }
    bool triggered() {
        const auto& shown = scope.model().shown();
        return shown && !shown->capture->untriggered;
    }
    std::string status() { return scope.findChild<QLabel*>("scopeStatus")->text().toStdString(); }
    /// True if any label has this text.
    bool says(const QString& words) {
        const auto labels = scope.findChildren<QLabel*>();
        return std::any_of(labels.begin(), labels.end(),
                           [&](const QLabel* label) { return label->isVisible() && label->text().contains(words); });
    }
    void draw() { scope.screen().replot(QCustomPlot::rpImmediateRefresh); }

    /// At the first start the screen has all the room; this switches everything else on.
    struct EverythingShown {
        EverythingShown() {
            QSettings().clear();
            QSettings().setValue("scope/controls", true);
            QSettings().setValue("scope/table", true);
        }
    } everything;
    gui::BenchController controller{simulatedRegistry};
    gui::ScopeWorkspace scope{controller};
    QStringList complaints;
};

}  // namespace tacto::test
