// Runs the suite that every massager must pass on the HID massager: with its own thread on the steady clock, and served
// by the test on a virtual clock.
#include <thread>

#include "drivers/hid_massager/HidMassager.h"
#include "tests/drivers/conformance/MassagerConformance.h"
#include "tests/drivers/hid_massager/FakeHid.h"

namespace tacto::test {
namespace {

std::optional<bool> vibrates(const FakeHidDevice& device) {
    const auto last = device.last();
    return last.size() == 8 && last[4] > 0;
}

DeviceIdentity padIdentity() { return {"hid:1234:5678", Role::Massager, "Pad", "S", {}, false}; }

class ThreadedRig final : public MassagerRig {
public:
    ThreadedRig()
        : massager_(hid::HidMassager::open([this] { return device_.open(); }, padIdentity(),
                                           padReports(Seconds(0.05), Seconds(0.004)), clock_)
                        .value()) {}
    Massager& device() override { return *massager_; }
    const Clock& clock() const override { return clock_; }
    void wait(Seconds duration) override { std::this_thread::sleep_for(duration); }
    std::optional<bool> vibrating() override { return vibrates(device_); }
    bool unplug() override {
        device_.unplug();
        return true;
    }

private:
    const SteadyClock clock_;
    FakeHidDevice device_{clock_, {}, {}};
    std::unique_ptr<hid::HidMassager> massager_;
};

class ServedRig final : public MassagerRig {
public:
    ServedRig()
        : massager_(
              hid::HidMassager::open([this] { return device_.open(); }, padIdentity(), padReports(), clock_).value()) {}
    Massager& device() override { return *massager_; }
    const Clock& clock() const override { return clock_; }
    void wait(Seconds duration) override {
        const Instant end = clock_.now() + toInstant(duration);
        for (Instant next = massager_->serve(clock_.now()); next <= end; next = massager_->serve(clock_.now())) {
            clock_.advanceTo(next);
        }
        clock_.advanceTo(end);
    }
    std::optional<bool> vibrating() override { return vibrates(device_); }
    bool unplug() override {
        device_.unplug();
        return true;
    }

private:
    VirtualClock clock_;
    FakeHidDevice device_{clock_, {}, {}};
    std::unique_ptr<hid::HidMassager> massager_;
};

INSTANTIATE_TEST_SUITE_P(Hid, MassagerConformance,
                         testing::Values(MassagerKind{"Threaded", [] { return std::make_unique<ThreadedRig>(); }},
                                         MassagerKind{"Served", [] { return std::make_unique<ServedRig>(); }}),
                         [](const testing::TestParamInfo<MassagerKind>& kind) { return kind.param.name; });

}  // namespace
}  // namespace tacto::test
