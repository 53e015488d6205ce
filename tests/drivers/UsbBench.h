// UsbBench.h - a bench with its session over the real libusb on the emulated bus, in real time.
//
// Thread-safety: the test's own thread; the bench states its own rules.
#pragma once

#include <gtest/gtest.h>
#include <thread>

#include "core/bench/Bench.h"
#include "core/devices/Registry.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"
#include "core/session/SessionWriter.h"
#include "drivers/usb/UsbProvider.h"
#include "tests/support/Comes.h"
#include "tests/support/InTime.h"
#include "tests/support/Limits.h"
#include "tests/support/usb_emulation/UsbTestbed.h"

namespace tacto::test {

class UsbBench : public testing::Test {
protected:
    [[nodiscard]] virtual Registry registry() = 0;
    /// Runs before the plugged-in devices are destroyed.
    void TearDown() override {
        bench_.reset();
        usb_ = {};
    }

    /// Opens the plugged-in devices.
    void open(const std::vector<DeviceUri>& uris, const std::set<Role>& needed) {
        auto drivers = registry();
        auto devices = drivers.open(uris, needed, OpenContext{*clock_, 1, "1 kohm"});
        ASSERT_IN_TIME(devices);
        session_ = SessionWriter::create(file(), SessionAbout{}, *clock_).value();
        BenchConfig config;
        config.devices = std::move(*devices);
        config.clock = clock_;
        config.limits = limitSets();
        config.session = session_.get();
        auto bench = Bench::create(std::move(config));
        ASSERT_IN_TIME(bench);
        bench_ = std::move(*bench);
    }
    [[nodiscard]] Result<void> arm() { return bench_->arm(ArmRequest{"1 kohm", true, true}); }
    [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "run.tacto"; }

    UsbTestbed bed_;
    std::shared_ptr<SteadyClock> clock_ = std::make_shared<SteadyClock>();
    UsbProvider usb_ = makeUsbProvider();
    const ScratchDir folder_;
    std::unique_ptr<SessionWriter> session_;
    std::unique_ptr<Bench> bench_;
};

}  // namespace tacto::test
