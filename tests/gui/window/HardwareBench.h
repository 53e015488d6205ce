// HardwareBench.h - the whole window with an emulated stimulator and sensor board plugged in: what a person sees of
// hardware, and what happens when a plug is pulled.
//
// Thread-safety: the GUI thread. The drivers' threads see changes of the plugs.
#pragma once

#include <QLabel>
#include <QTreeWidget>
#include <gtest/gtest.h>

#include "app/gui/window/DeviceDock.h"
#include "drivers/sciencemode/ScienceModeDriver.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/drivers/sciencemode/EmulatedLine.h"
#include "tests/gui/window/WindowFixture.h"
#include "tests/support/Support.h"
#include "tests/support/emulated/sensor_board/EmulatedBoardLine.h"

namespace tacto::test {

/// Sockets for stimulators. Each registry has its own sockets, all on the same line.
class StimulatorSockets final : public TransportPorts {
public:
    struct Plugs {
        std::atomic<bool> in{true};
        std::atomic<bool> permitted{true};
    };
    StimulatorSockets(std::shared_ptr<EmulatedLine> line, std::shared_ptr<Plugs> plugs)
        : line_(std::move(line)), plugs_(std::move(plugs)) {}

    std::vector<TransportPort> list() const override {
        if (!plugs_->in) return {};
        const char* obstacle = plugs_->permitted
                                   ? ""
                                   : "USB device 0483:5740 at 1-2 is there, but this user may not open it: "
                                     "run \"./dev install-rules\" once, then plug the device in again.";
        return {{"P24-0017", "1-2", obstacle}};
    }
    Result<std::unique_ptr<Transport>> open(const TransportPort&) override { return line_->connect(); }

private:
    const std::shared_ptr<EmulatedLine> line_;
    const std::shared_ptr<Plugs> plugs_;
};

/// The devices plugged in at present.
struct Hardware {
    [[nodiscard]] Registry registry() const {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        drivers.push_back(makeScienceModeDriver(std::make_shared<StimulatorSockets>(stimulator, plugs)));
        drivers.push_back(makeSensorBoardDriver(board));
        return Registry(std::move(drivers));
    }
    void unplugStimulator() const {
        plugs->in = false;
        stimulator->unplug();
    }
    void plugStimulator() const {
        stimulator->plug();
        plugs->in = true;
    }

    const SteadyClock clock;
    const OwnSerial serial{"EMU"};  // recognised as a device, because it has its own record
    std::shared_ptr<EmulatedLine> stimulator = std::make_shared<EmulatedLine>(clock, nullptr);
    std::shared_ptr<StimulatorSockets::Plugs> plugs = std::make_shared<StimulatorSockets::Plugs>();
    std::shared_ptr<sensorboard::EmulatedBoardLine> board =
        std::make_shared<sensorboard::EmulatedBoardLine>(clock, nullptr);
};

class HardwareWindow : protected Hardware, public Window {
protected:
    HardwareWindow() : Window([this] { return registry(); }) {
        sciencemode::EmulatedSettings unit;
        unit.id = serial.text();
        stimulator->plugAnother(unit);
    }

    [[nodiscard]] QTreeWidget& tree() { return *window.findChild<gui::DeviceDock*>()->findChild<QTreeWidget*>(); }
    /// Returns the dock's line for a URI as soon as it exists. Fails after 10 s.
    [[nodiscard]] QTreeWidgetItem& row(const QString& uri) {
        QTreeWidgetItem* found = nullptr;
        const bool came = comesTrue([&] {
            found = nullptr;
            for (int i = 0; i < tree().topLevelItemCount(); ++i) {
                if (tree().topLevelItem(i)->data(0, Qt::UserRole).toString() == uri) found = tree().topLevelItem(i);
            }
            return found != nullptr;
        });
        [&] { ASSERT_IN_TIME(came) << "the dock shows no " << uri.toStdString(); }();
        return *found;
    }
    void choose(const QTreeWidgetItem& item) {
        const auto where = tree().visualItemRect(&item);
        QTest::mouseClick(tree().viewport(), Qt::LeftButton, Qt::NoModifier, where.center());
    }
    /// Selects the line and presses Return, as an operator without a mouse does.
    void tick(const QString& uri) {
        choose(row(uri));
        QTest::keyClick(&tree(), Qt::Key_Return);
        ASSERT_EQ(row(uri).checkState(0), Qt::Checked) << uri.toStdString();
    }
    void open(const QStringList& uris) {
        for (const auto& uri : uris) ASSERT_NO_FATAL_FAILURE(tick(uri));
        click(*window.findChild<QPushButton*>("openBench"));
        ASSERT_IN_TIME(comesTrue([this] { return window.controller().activity() == gui::Activity::Live; }))
            << banner().toStdString();
    }
    void deliver() {
        window.controller().drive(DriveSource::Manual, 0.5, 1);
        ASSERT_IN_TIME(comesTrue([this] { return window.controller().telemetry().trainsDelivered > 0; }));
    }
    void pressReset() {
        auto* button = window.findChild<QPushButton*>("armButton");
        ASSERT_IN_TIME(comesTrue([&] { return button->text().contains("Reset"); }));
        click(*button);
    }
    [[nodiscard]] QString facts() { return window.findChild<QLabel*>("deviceFacts")->text(); }
};

}  // namespace tacto::test
