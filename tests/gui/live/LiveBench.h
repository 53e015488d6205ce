// LiveBench.h - a live workspace and the drive's dock, on a controller with simulated devices; refreshed 30 times a
// second, as in the window.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QTimer>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/live/DrivePanel.h"
#include "app/gui/live/LiveWorkspace.h"
#include "tests/gui/Person.h"

namespace tacto::test {

class LiveBench : public testing::Test {
protected:
    LiveBench() {
        QObject::connect(&controller, &gui::BenchController::failed,
                         [this](const QString& what) { complaints << what; });
        QObject::connect(&controller, &gui::BenchController::changed, &drive, &gui::DrivePanel::begin);
        QObject::connect(&frame, &QTimer::timeout, [this] {
            live.refresh(controller.telemetry(), true);
            drive.refresh(controller.telemetry());
        });
        live.resize(1180, 800);
        drive.show();
        live.show();  // the active window
        frame.start(33);
    }
    [[nodiscard]] bool opens() {
        return comesTrue([this] { return controller.activity() == gui::Activity::Live && live.history().now_s() > 0; });
    }
    [[nodiscard]] bool openSimulated(const char* uri = "sim:", double speed = 1) {
        gui::LiveOrder order;
        order.uris.push_back(*DeviceUri::parse(uri));
        if (std::string_view(uri) != "sim:") order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = controller.profile();
        order.speed = speed;
        controller.openLive(order);
        return opens();
    }
    [[nodiscard]] bool armed() {
        ArmRequest request;
        request.operatorConfirmed = true;
        controller.arm(request);
        // If a drive is already on, the first train follows at once.
        return comesTrue([this] {
            const auto state = controller.telemetry().state;
            return state == InterlockState::Armed || state == InterlockState::Delivering;
        });
    }
    /// Waits until `seconds` have passed on the bench.
    [[nodiscard]] bool passes(double seconds) {
        const double until = toSeconds(controller.telemetry().at) + seconds;
        return comesTrue([this, until] { return live.history().now_s() >= until; });
    }

    gui::BenchController controller{simulatedRegistry};
    gui::LiveWorkspace live{controller};
    gui::DrivePanel drive{controller};
    QTimer frame;
    QStringList complaints;
};

}  // namespace tacto::test
