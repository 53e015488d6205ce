// LiveBench.h - a live workspace on a desk with simulated devices, refreshed thirty times a second as the window does.
#pragma once

#include <QTimer>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/gui/live/LiveWorkspace.h"
#include "tests/gui/Person.h"

namespace tacto::test {

class LiveBench : public testing::Test {
protected:
    LiveBench() {
        QObject::connect(&desk, &gui::BenchDesk::failed, [this](const QString& what) { complaints << what; });
        QObject::connect(&frame, &QTimer::timeout, [this] { live.refresh(desk.telemetry(), true); });
        live.resize(1180, 760);
        live.show();
        frame.start(33);
    }
    [[nodiscard]] bool opens() {
        return comesTrue([this] { return desk.activity() == gui::Activity::Live && live.history().now_s() > 0; });
    }
    [[nodiscard]] bool openSimulated(const char* uri = "sim:", double speed = 1) {
        gui::LiveOrder order;
        order.uris.push_back(*DeviceUri::parse(uri));
        if (std::string_view(uri) != "sim:") order.uris.push_back(*DeviceUri::parse("sim:"));
        order.profile = desk.profile();
        order.speed = speed;
        desk.openLive(order);
        return opens();
    }
    [[nodiscard]] bool armed() {
        ArmRequest request;
        request.operatorConfirmed = true;
        desk.arm(request);
        // Where something drives already, the first train follows at once.
        return comesTrue([this] {
            const auto state = desk.telemetry().state;
            return state == InterlockState::Armed || state == InterlockState::Delivering;
        });
    }
    /// Lets `seconds` of the bench pass.
    [[nodiscard]] bool passes(double seconds) {
        const double until = toSeconds(desk.telemetry().at) + seconds;
        return comesTrue([this, until] { return live.history().now_s() >= until; });
    }

    gui::BenchDesk desk{simulatedRegistry};
    gui::LiveWorkspace live{desk};
    QTimer frame;
    QStringList complaints;
};

}  // namespace tacto::test
