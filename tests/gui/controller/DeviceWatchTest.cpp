// Tests how the window notices devices being plugged in and out.
#include <QSignalSpy>
#include <atomic>
#include <gtest/gtest.h>

#include "app/gui/controller/DeviceWatch.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using namespace std::chrono_literals;

/// A simulated socket into which the operator plugs devices.
class Socket final : public Driver {
public:
    explicit Socket(std::shared_ptr<std::atomic<int>> plugged) : plugged_(std::move(plugged)) {}
    std::string_view scheme() const noexcept override { return "socket"; }
    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> present;
        for (int i = 0; i < *plugged_; ++i) {
            present.push_back({"socket:" + std::to_string(i), Role::Stimulator, "stimulator", "", "", false,
                               i == 1 ? "it may not be opened" : ""});
        }
        return present;
    }
    bool runsOnVirtualClock() const noexcept override { return false; }
    Result<void> open(const DeviceUri&, const std::set<Role>&, const OpenContext&, DeviceSet&) override {
        return fail(ErrorCode::NotFound, "a socket opens nothing");
    }

private:
    const std::shared_ptr<std::atomic<int>> plugged_;
};

TEST(DeviceWatch, TellsOfPluggingBothWays) {
    const auto plugged = std::make_shared<std::atomic<int>>(0);
    gui::DeviceWatch watch(
        [plugged] {
            std::vector<std::unique_ptr<Driver>> drivers;
            drivers.push_back(std::make_unique<Socket>(plugged));
            return Registry(std::move(drivers));
        },
        10ms);
    QSignalSpy told(&watch, &gui::DeviceWatch::changed);
    ASSERT_IN_TIME(comesTrue([&] { return told.count() == 1; }));
    EXPECT_TRUE(watch.devices().empty());
    *plugged = 2;
    ASSERT_IN_TIME(comesTrue([&] { return watch.devices().size() == 2; }));
    EXPECT_EQ(watch.devices()[0].obstacle, "");
    EXPECT_EQ(watch.devices()[1].obstacle, "it may not be opened");
    *plugged = 0;
    EXPECT_IN_TIME(comesTrue([&] { return watch.devices().empty(); }));
    EXPECT_EQ(told.count(), 3) << "only when something changed";
}

TEST(DeviceWatch, EndsAtOnceThoughItsPeriodIsLong) {
    const auto plugged = std::make_shared<std::atomic<int>>(1);
    gui::DeviceWatch watch(
        [plugged] {
            std::vector<std::unique_ptr<Driver>> drivers;
            drivers.push_back(std::make_unique<Socket>(plugged));
            return Registry(std::move(drivers));
        },
        1h);
    ASSERT_IN_TIME(comesTrue([&] { return watch.devices().size() == 1; }));
    *plugged = 3;
    watch.look();
    EXPECT_IN_TIME(comesTrue([&] { return watch.devices().size() == 3; }));
}

}  // namespace
}  // namespace tacto::test
