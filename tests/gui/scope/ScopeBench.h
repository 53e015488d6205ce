// ScopeBench.h - the oscilloscope on a simulated bench, at the first start of a program that remembers nothing.
#pragma once

#include <QLabel>
#include <QSettings>
#include <gtest/gtest.h>

#include "app/gui/scope/MeasurementTable.h"
#include "app/gui/scope/ScopeView.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "tests/gui/Person.h"

namespace tacto::test {

/// A first start: nothing is remembered.
struct FreshSettings {
    FreshSettings() { QSettings().clear(); }
};

class Scope : public testing::Test {
protected:
    Scope() {
        scope.resize(1280, 760);
        scope.QWidget::show();
        QObject::connect(&desk, &gui::BenchDesk::failed, [this](const QString& what) { complaints << what; });
    }
    void openBench(const char* oscilloscope = nullptr, double speed = 1) {
        gui::LiveOrder order;
        if (oscilloscope != nullptr) order.uris.push_back(*DeviceUri::parse(oscilloscope));
        order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = desk.profile();
        order.speed = speed;
        desk.openLive(order);
        ASSERT_TRUE(comesTrue([this] { return desk.activity() == gui::Activity::Live; }));
    }
    void deliver() {
        ArmRequest request;
        request.load = "1 kohm";
        request.operatorConfirmed = true;
        desk.arm(request);
        ASSERT_TRUE(comesTrue([this] { return desk.telemetry().state == InterlockState::Armed; }));
        desk.drive(DriveSource::Manual, 0.5, 0.8);
    }
    /// As the window does at 30 Hz.
    bool comes(const std::function<bool()>& isSo) {
        return comesTrue([&] {
            scope.refresh(desk.telemetry());
            return isSo();
        });
    }
    bool triggered() {
        const auto& shown = scope.view().shown();
        return shown && !shown->capture->untriggered;
    }
    std::string status() { return scope.findChild<QLabel*>("scopeStatus")->text().toStdString(); }
    void draw() { scope.view().replot(QCustomPlot::rpImmediateRefresh); }

    FreshSettings fresh;
    gui::BenchDesk desk{simulatedRegistry};
    gui::ScopeWorkspace scope{desk};
    QStringList complaints;
};

}  // namespace tacto::test
